#include <trochoid/identification/views.h>
#include <trochoid/signal/spindle_speed.h>

#include "../unit/identification/made_record.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <map>
#include <random>
#include <string>

/// How often 95 % intervals hold the truth, under noise as records have it.
namespace trochoid::identification {
namespace {

enum class Disturbance { white, coloured, repeating, ringing };

/// Neighbouring samples of coloured noise agree so much.
constexpr double correlation = 0.9;

double rms(const Record& run) {
  double sum = 0.0;
  for (const auto& F : run.force) sum += F[0] * F[0] + F[1] * F[1] + F[2] * F[2];
  return std::sqrt(sum / (3.0 * static_cast<double>(run.force.size())));
}

/// @brief What a dynamometer reads that rings: one resonance a channel, at 24 to 36 times
/// the spindle, damped by 3 %.
void ring(const std::array<double, 3>& resonance, Record& run) {
  constexpr std::size_t per_turn = 120;
  constexpr double zeta = 0.03;
  for (std::size_t q = 0; q < 3; ++q) {
    std::vector<double> turn(per_turn, 0.0);
    for (std::size_t k = 0; k < per_turn / 2; ++k) {
      std::complex<double> F = 0.0;
      for (std::size_t i = 0; i < per_turn; ++i) {
        F += run.force[i][q] * std::polar(1.0, -static_cast<double>(k) * run.angle[i]);
      }
      const double x = static_cast<double>(k) / resonance[q];
      F *= (k == 0 ? 1.0 : 2.0) / static_cast<double>(per_turn) /
           std::complex<double>(1 - x * x, 2 * zeta * x);
      for (std::size_t i = 0; i < per_turn; ++i) {
        turn[i] += (F * std::polar(1.0, static_cast<double>(k) * run.angle[i])).real();
      }
    }
    for (std::size_t i = 0; i < run.force.size(); ++i) {
      run.force[i][q] = turn[i % per_turn];
    }
  }
}

/// White; an AR(1) process with drift; or white on a vibration locked to the spindle.
void disturb(Disturbance how, double size, std::mt19937& random, Record& run) {
  std::normal_distribution<double> normal(0.0, 1.0);
  const double fresh = std::sqrt(1 - correlation * correlation);
  const auto n = static_cast<double>(run.force.size());
  for (std::size_t q = 0; q < 3; ++q) {
    double state = normal(random);
    const double drift = normal(random);
    const double begin = 2 * pi * std::uniform_real_distribution<double>()(random);
    const int cycles = std::uniform_int_distribution<int>(9, 40)(random);
    for (std::size_t i = 0; i < run.force.size(); ++i) {
      double noise = normal(random);
      if (how == Disturbance::coloured) {
        state = correlation * state + fresh * normal(random);
        noise = state + drift * (static_cast<double>(i) / n - 0.5);
      } else if (how == Disturbance::repeating) {
        noise = 0.5 * noise + 1.2 * std::sin(cycles * run.angle[i] + begin);
      }
      run.force[i][q] += size * noise;
    }
  }
}

struct Tool {
  std::string name;
  force::Setup setup;
};

Tool two_flutes() {
  Tool tool{"two flutes, slot", slot_setup(2, 30.0, 2.0 * unit::mm)};
  tool.setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  return tool;
}

Tool four_flutes() {
  Tool tool{"four flutes, quarter immersion", slot_setup(4, 30.0, 4.0 * unit::mm)};
  tool.setup.cut.engagement = geometry::UpMilling{2.0 * unit::mm};
  tool.setup.runout.radial_offsets = {0.0, -8.0 * unit::um, 4.0 * unit::um,
                                      -3.0 * unit::um};
  return tool;
}

/// How many intervals held the truth, of how many.
struct Held {
  int held = 0;
  int all = 0;
  double off = 0.0;   ///< sum of errors, in the truth
  double wide = 0.0;  ///< sum of halves of intervals, in the truth

  void count(bool holds) {
    held += holds ? 1 : 0;
    ++all;
  }
};

/// Of each quantity.
std::map<std::string, Held> held(const Tool& tool, Disturbance how, int seeds) {
  std::map<std::string, Held> out;
  const auto truth = force::coefficients(steel());
  const auto names = force::coefficient_quantities(steel());
  for (int seed = 1; seed <= seeds; ++seed) {
    std::mt19937 random(static_cast<unsigned>(1000 * seed + 7));
    std::uniform_real_distribution<double> some(24, 36);
    const std::array<double, 3> resonance{some(random), some(random), some(random)};
    std::vector<Record> runs;
    for (const double f_z : {30e-6, 60e-6}) {
      force::Setup setup = tool.setup;
      setup.cut.f_z = f_z;
      runs.push_back(made_record(setup, steel(), {.per_turn = 120, .turns = 12}));
      if (how == Disturbance::ringing) ring(resonance, runs.back());
      disturb(how, 0.05 * rms(runs.back()), random, runs.back());
    }
    Options options;
    options.phase = 0.0;
    const Fit fit = fit_as_seen(without_runout(tool.setup), steel(), runs, options).fit;
    for (std::size_t c = 0; c < names.size(); ++c) {
      const auto& K = fit.coefficients[c];
      out[std::string(names[c].key)].count(K && K->low <= truth[c] &&
                                           truth[c] <= K->high);
    }
    const auto& offsets = tool.setup.runout.radial_offsets;
    for (std::size_t k = 1; k < offsets.size(); ++k) {
      const auto& se = fit.radial_offsets_se[k];
      const double off = std::abs(fit.runout.radial_offsets[k] - offsets[k]);
      out["radial_offsets_mm"].count(se && off <= fit.interval_factor * *se);
    }
  }
  return out;
}

/// TROCHOID_SEEDS asks for more than the few of a quick test.
int seeds() {
  constexpr int few = 20;
  const char* asked = std::getenv("TROCHOID_SEEDS");
  return asked != nullptr ? std::atoi(asked) : few;
}

TEST(Coverage, IntervalsHoldTheTruth) {  // [I-8] [I-14] [I-15] [I-17]
  const int n = seeds();
  for (const Tool& tool : {two_flutes(), four_flutes()}) {
    for (const auto how : {Disturbance::white, Disturbance::coloured,
                           Disturbance::repeating, Disturbance::ringing}) {
      for (const auto& [name, found] : held(tool, how, n)) {
        const double part = static_cast<double>(found.held) / found.all;
        // 95 %, less three deviations of a count of so many seeds.
        const double least = 0.95 - 3 * std::sqrt(0.95 * 0.05 / n);
        EXPECT_GE(part, least)
            << tool.name << ", disturbance " << static_cast<int>(how) << ", " << name;
        if (n > 100) {
          std::printf("%-32s %d %-18s %5.1f %%\n", tool.name.c_str(),
                      static_cast<int>(how), name.c_str(), 100 * part);
        }
      }
    }
  }
}

/// Single records at rates that do not fit a turn, their speed and phase unknown.
namespace single {

constexpr double zeta = 0.03;
constexpr double turns = 40.0;
constexpr std::array rates{131.0, 200.0, 10000.0 / 2800.0 * 60.0, 300.0};

struct Cutter {
  std::string name;
  force::Setup setup;
  RunoutUnknowns runout = RunoutUnknowns::offsets;
};

force::Setup setup_of(int teeth, double diameter, double rpm) {
  force::Setup out = slot_setup(teeth, 30.0, 3.0 * unit::mm);
  out.cutter.profile = geometry::cylinder(diameter * unit::mm);
  out.cutter.lag_diameter = diameter * unit::mm;
  out.cut.f_z = 60.0 * unit::um;
  out.cut.Omega = rpm * unit::rpm;
  return out;
}

std::vector<Cutter> cutters() {
  std::vector<Cutter> out = {
      {"two flutes, slot", setup_of(2, 12.0, 2400.0)},
      {"three flutes, half immersion", setup_of(3, 12.0, 3000.0)},
      {"four flutes, quarter immersion, down", setup_of(4, 16.0, 2800.0),
       RunoutUnknowns::eccentricity}};
  out[0].setup.runout.radial_offsets = {0.0, -11.0 * unit::um};
  out[1].setup.cut.engagement = geometry::UpMilling{6.0 * unit::mm};
  out[1].setup.runout.radial_offsets = {0.0, 0.0, 0.0};
  out[2].setup.cut.engagement = geometry::DownMilling{4.0 * unit::mm};
  out[2].setup.runout.eccentricity = 14.0 * unit::um;
  out[2].setup.runout.angle = 50.0 * unit::deg;
  return out;
}

/// Oscillators of one axis, whose parts add up to one at rest.
struct Mode {
  double omega = 0.0;
  double part = 1.0;
};
using Axes = std::array<std::vector<Mode>, 3>;

std::complex<double> response(const std::vector<Mode>& modes, double omega) {
  if (modes.empty()) return 1.0;
  std::complex<double> sum = 0.0;
  for (const Mode& m : modes) sum += m.part * oscillation(omega, {m.omega, zeta});
  return sum;
}

/// One turn of readings, finely sampled, by its Fourier coefficients.
class Turn {
 public:
  Turn(const force::Setup& setup, const Axes& axes) {
    std::vector<double> phi;
    for (std::size_t i = 0; i < fine; ++i) {
      phi.push_back(2 * pi * static_cast<double>(i) / fine);
    }
    force_ = force::forces(setup, steel(), phi, 1e-9);
    for (std::size_t q = 0; q < 3; ++q) {
      if (axes[q].empty()) continue;
      std::vector<double> turn(fine, 0.0);
      for (std::size_t k = 0; k < lines; ++k) {
        std::complex<double> F = 0.0;
        for (std::size_t i = 0; i < fine; ++i) {
          F += force_[i][q] * std::conj(wave(i * k));
        }
        F *= (k == 0 ? 1.0 : 2.0) / fine *
             response(axes[q], static_cast<double>(k) * setup.cut.Omega);
        for (std::size_t i = 0; i < fine; ++i) turn[i] += (F * wave(i * k)).real();
      }
      for (std::size_t i = 0; i < fine; ++i) force_[i][q] = turn[i];
    }
  }

  [[nodiscard]] std::array<double, 3> at(double phi) const {
    const double place = (phi / (2 * pi) - std::floor(phi / (2 * pi))) * fine;
    const auto i = static_cast<std::size_t>(place) % fine;
    const double part = place - std::floor(place);
    std::array<double, 3> out{};
    for (std::size_t q = 0; q < 3; ++q) {
      out[q] = (1 - part) * force_[i][q] + part * force_[(i + 1) % fine][q];
    }
    return out;
  }

 private:
  static constexpr std::size_t fine = 4096;
  static constexpr std::size_t lines = 160;

  static std::complex<double> wave(std::size_t i) {
    static const std::vector<std::complex<double>> table = [] {
      std::vector<std::complex<double>> out;
      for (std::size_t k = 0; k < fine; ++k) {
        out.push_back(std::polar(1.0, 2 * pi * static_cast<double>(k) / fine));
      }
      return out;
    }();
    return table[i % fine];
  }

  std::vector<std::array<double, 3>> force_;
};

enum class Kind { white, ringing, two_modes };

Axes axes_of(Kind kind, std::mt19937& random) {
  Axes out;
  if (kind == Kind::white) return out;
  std::uniform_real_distribution<double> some(900.0, 2100.0);
  for (auto& modes : out) {
    modes.push_back({2 * pi * some(random), kind == Kind::ringing ? 1.0 : 0.85});
    if (kind == Kind::two_modes) modes.push_back({2 * pi * some(random), 0.15});
  }
  return out;
}

struct Made {
  Record run;
  double phase = 0.0;  ///< at the first sample
};

/// A record over time, whose speed is found in itself.
Made made(const Cutter& tool, double rate, Kind kind, unsigned seed) {
  std::mt19937 random(seed);
  const Turn turn(tool.setup, axes_of(kind, random));
  const double pitch = 2 * pi / tool.setup.cutter.teeth();
  Made out;
  out.phase = std::uniform_real_distribution<double>(-0.4 * pitch, 0.4 * pitch)(random);
  signal::Record record;
  std::vector<std::array<double, 3>> force;
  const double step = 2 * pi / rate;
  for (int i = 0; i < static_cast<int>(turns * rate); ++i) {
    record.time.push_back(i * step / tool.setup.cut.Omega);
    force.push_back(turn.at(i * step + out.phase));
  }
  out.run.force = std::move(force);
  std::normal_distribution<double> normal(0.0, 0.02 * rms(out.run));
  for (auto& F : out.run.force) {
    for (std::size_t q = 0; q < 3; ++q) {
      F[q] += normal(random);
      record.channel[q].push_back(F[q]);
    }
  }
  const auto found = signal::spindle_speed(
      record,
      {.Omega = 1.002 * tool.setup.cut.Omega, .teeth = tool.setup.cutter.teeth()});
  out.run.cut = tool.setup.cut;
  out.run.cut.Omega = found.Omega;
  out.run.Omega_se = found.se;
  out.run.angle = signal::angle_from_time(record.time, found.Omega);
  return out;
}

void count(const Cutter& tool, const Made& record, const Fit& fit,
           std::map<std::string, Held>& out) {
  const auto truth = force::coefficients(steel());
  const auto names = force::coefficient_quantities(steel());
  for (std::size_t c = 0; c < names.size(); ++c) {
    const auto& K = fit.coefficients[c];
    Held& held = out[std::string(names[c].key)];
    held.count(K && K->low <= truth[c] && truth[c] <= K->high);
    if (!K) continue;
    held.off += K->value / truth[c] - 1;
    held.wide += 0.5 * (K->high - K->low) / truth[c];
  }
  const geometry::Runout& runout = tool.setup.runout;
  if (tool.runout == RunoutUnknowns::eccentricity) {
    out["eccentricity_mm"].count(
        fit.eccentricity_se &&
        std::abs(fit.runout.eccentricity - runout.eccentricity) <=
            fit.interval_factor * *fit.eccentricity_se);
  }
  for (std::size_t k = 1; k < runout.radial_offsets.size(); ++k) {
    const auto& se = fit.radial_offsets_se[k];
    const double off = fit.runout.radial_offsets[k] - runout.radial_offsets[k];
    out["radial_offsets_mm"].count(se && std::abs(off) <= fit.interval_factor * *se);
  }
  int rings = 0;
  for (const auto& one : fit.resonances) rings += one ? 1 : 0;
  out["axes that ring"].held += rings;
  out["axes that ring"].all += 3;
  const auto& se = fit.phase_se[0];
  out["phase_deg"].count(se && std::abs(fit.phase[0] - record.phase) <=
                                   fit.interval_factor * *se);
}

void print(const std::string& where, const std::map<std::string, Held>& found) {
  std::printf("%-46s", where.c_str());
  for (const auto& [name, held] : found) {
    std::printf(" %s %d/%d %+.2f +- %.2f %%", name.c_str(), held.held, held.all,
                100 * held.off / held.all, 100 * held.wide / held.all);
  }
  std::printf("\n");
}

/// Over all tools and rates, each also by itself where it is to be looked at.
std::map<std::string, Held> held(Kind kind, int seeds, bool told) {
  std::map<std::string, Held> out;
  for (const Cutter& tool : cutters()) {
    for (const double rate : rates) {
      std::map<std::string, Held> here;
      for (int seed = 1; seed <= seeds; ++seed) {
        const Made record = made(tool, rate, kind, static_cast<unsigned>(seed));
        Options options;
        options.runout = tool.runout;
        const std::vector<Record> runs{record.run};
        const Fit fit =
            fit_as_seen(without_runout(tool.setup), steel(), runs, options).fit;
        count(tool, record, fit, here);
      }
      if (told) print(tool.name + ", " + std::to_string(rate), here);
      for (const auto& [name, one] : here) {
        out[name].held += one.held;
        out[name].all += one.all;
        out[name].off += one.off;
        out[name].wide += one.wide;
      }
    }
  }
  return out;
}

class Single : public testing::TestWithParam<Kind> {};

TEST_P(Single, RecordsAtRatesThatDoNotFitATurn) {  // [I-14] [I-17] [I-23]
  constexpr int few = 4;
  const bool more = std::getenv("TROCHOID_SEEDS") != nullptr;
  const auto found = held(GetParam(), more ? seeds() : few, more);
  for (const auto& [name, one] : found) {
    if (name == "axes that ring") continue;
    const double part = static_cast<double>(one.held) / one.all;
    EXPECT_GE(part, 0.95 - 3 * std::sqrt(0.95 * 0.05 / one.all)) << name;
  }
  if (more) print("all", found);
}

INSTANTIATE_TEST_SUITE_P(Coverage, Single,
                         testing::Values(Kind::white, Kind::ringing, Kind::two_modes));

}  // namespace single

}  // namespace
}  // namespace trochoid::identification
