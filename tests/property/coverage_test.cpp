#include <trochoid/identification/views.h>

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
  constexpr int few = 40;
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

}  // namespace
}  // namespace trochoid::identification
