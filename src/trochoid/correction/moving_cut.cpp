#include <trochoid/correction/moving_cut.h>

#include <trochoid/base/units.h>
#include <trochoid/correction/shapes.h>
#include <trochoid/dynamics/steady_state.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace trochoid::correction {

namespace {

/// When the reading agrees, relative to the feed per tooth and in ln K and m.
constexpr double agreed = 1e-5;
constexpr int most_iterations = 25;

/// Samples of the last two turns, in place: rounding may
/// have left one out or kept one twice.
struct LastTurns {
  std::vector<std::array<double, 3>> force;
  std::vector<double> table;
};

LastTurns last_turns(const MovingCut& cut, const dynamics::Motion& motion) {
  const auto count = 2 * static_cast<std::size_t>(cut.samples_per_rev);
  const double spacing = unit::turn / cut.samples_per_rev;
  const auto first =
      static_cast<std::int64_t>(motion.turns_done - 2) * cut.samples_per_rev;
  LastTurns out{std::vector<std::array<double, 3>>(count), std::vector<double>(count)};
  std::vector<bool> known(count);
  for (std::size_t i = 0; i < motion.angle.size(); ++i) {
    const std::int64_t k = std::llround(motion.angle[i] / spacing) - first;
    if (k >= 0 && k < static_cast<std::int64_t>(count)) {
      const auto at = static_cast<std::size_t>(k);
      out.force[at] = motion.force[i];
      out.table[at] = motion.mode.back()[i];
      known[at] = true;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!known[i]) {
      const std::size_t near = i > 0 ? i - 1 : i + 1;
      out.force[i] = out.force[near];
      out.table[i] = out.table[near];
    }
  }
  return out;
}

/// Peaks of the whole force in the turn of each tooth; chips as simulated.
std::vector<Flute> flutes_of(const MovingCut& cut, const ForceRecord& record,
                             const dynamics::Motion& motion) {
  const RigidCut rigid(cut.setup, cut.law, 1);
  std::vector<Flute> flutes(motion.flutes.size());
  for (std::size_t i = 0; i < record.angle.size(); ++i) {
    const std::size_t j = rigid.turn_of(record.angle[i]);
    Flute& f = flutes[j];
    f.peak_x = std::max(f.peak_x, std::abs(record.force[i][0]));
    if (std::abs(record.force[i][1]) > f.peak_y) {
      f.peak_y = std::abs(record.force[i][1]);
      const double theta = record.angle[i] - rigid.psi()[j];
      f.peak_y_angle = theta - unit::turn * std::floor(theta / unit::turn);
    }
  }
  for (std::size_t j = 0; j < flutes.size(); ++j) {
    flutes[j].chip_area = motion.flutes[j].chip_area;
    flutes[j].peak_chip = motion.flutes[j].peak_chip;
    flutes[j].own_peak_y = motion.flutes[j].peak_y;
  }
  return flutes;
}

/// By how much a reading misses an estimate, at most, in units of what agreed means.
struct Step {
  std::vector<double> rho;
  std::array<double, 6> law{};  ///< of ln K_t1, m_t, ln K_r1, m_r, ln K_a1, m_a
  double largest = 0.0;
};

Step step_between(const StaticFit& wanted, const StaticFit& read, double f_z) {
  Step step;
  for (std::size_t j = 0; j < wanted.rho.size(); ++j) {
    step.rho.push_back(wanted.rho[j].value - read.rho[j].value);
    step.largest = std::max(step.largest, std::abs(step.rho.back()) / f_z);
  }
  const auto values = [](const force::Power& law) {
    const auto log = [](double K) { return K != 0 ? std::log(std::abs(K)) : 0.0; };
    return std::array<double, 6>{log(law.K_t1), law.m_t,       log(law.K_r1),
                                 law.m_r,       log(law.K_a1), law.m_a};
  };
  const auto a = values(wanted.law);
  const auto b = values(read.law);
  for (std::size_t k = 0; k < a.size(); ++k) {
    step.law[k] = a[k] - b[k];
    step.largest = std::max(step.largest, std::abs(step.law[k]));
  }
  return step;
}

void take(const Step& step, force::Power& law, std::vector<double>& rho) {
  for (std::size_t j = 0; j < rho.size(); ++j) {
    rho[j] += step.rho[j];
  }
  law.K_t1 *= std::exp(step.law[0]);
  law.m_t += step.law[1];
  law.K_r1 *= std::exp(step.law[2]);
  law.m_r += step.law[3];
  law.K_a1 *= std::exp(step.law[4]);
  law.m_a += step.law[5];
}

}  // namespace

int slices_for(const force::Setup& setup) noexcept {
  constexpr double most = 20.0;
  constexpr double each = 0.5 * unit::deg;
  const geometry::Cutter& cutter = setup.cutter;
  if (!(cutter.helix > 0)) {
    return 1;
  }
  const double lag = 2 * setup.cut.a_p * std::tan(cutter.helix) / cutter.lag_diameter;
  return static_cast<int>(std::clamp(std::ceil(lag / each), 1.0, most));
}

dynamics::MotionProblem problem_of(const MovingCut& cut,
                                   const PeriodicMotion& command) {
  dynamics::MotionProblem p{.setup = cut.setup, .law = cut.law, .grid = cut.grid};
  p.system.modes = cut.tool;
  const structure::Mode& table = cut.plant.table;
  p.system.modes.push_back(
      {table.mass, table.damping, table.stiffness, -1.0, 0.0, true});
  p.drive = drive_of(cut.plant, cut.tool.size());
  const double omega = cut.setup.cut.Omega;
  p.command = [command, omega](double t) { return place_at(command, omega * t); };
  p.grid.steps_per_tooth =
      std::max(cut.grid.steps_per_tooth, dynamics::steps_needed(p));
  p.revolutions = cut.revolutions;
  p.kept = 2;
  p.samples_per_rev = cut.samples_per_rev;
  return p;
}

namespace {

MovingFlutes flutes_in(const MovingCut& cut, const dynamics::Motion& motion) {
  MovingFlutes out{.periodic = dynamics::repeats_every_turn(motion),
                   .last_change = motion.last_change};
  if (!motion.finite || !motion.solved) {
    out.flutes.resize(static_cast<std::size_t>(cut.setup.cutter.teeth()));
    return out;
  }
  const LastTurns turns = last_turns(cut, motion);
  const auto samples = static_cast<std::size_t>(cut.samples_per_rev);
  std::vector<double> table;
  for (std::size_t i = 0; i < samples; ++i) {
    out.record.angle.push_back(unit::turn * static_cast<double>(i) /
                               static_cast<double>(samples));
    out.record.force.push_back(turns.force[samples + i]);
    table.push_back(turns.table[samples + i]);
  }
  out.table = harmonics_of_samples(table, table_harmonics);
  out.flutes = flutes_of(cut, out.record, motion);
  return out;
}

/// Of a steady state, for which more turns are followed where it needs them.
/// @param near  where the fit starts, and which decides what chips are thin
StaticFit reading(const MovingCut& cut, std::span<const double> rho,
                  const StaticFitOptions& options, const StaticFit* near) {
  MovingCut moving = cut;
  moving.setup.runout = {.radial_offsets = {rho.begin(), rho.end()}};
  const MovingFlutes flutes =
      flutes_in(moving, dynamics::steady_state(problem_of(moving, Harmonics{})).motion);
  if (!flutes.periodic) {
    StaticFit fit;
    fit.reason = fmt::format(
        "the simulated cut does not repeat: its force "
        "changes by {:.3g} N from turn to turn",
        flutes.last_change);
    return fit;
  }
  if (near == nullptr) {
    return static_fit(moving.setup, flutes.record, options, power_near(moving.law));
  }
  moving.setup.runout.radial_offsets.clear();
  for (const Value& value : near->rho) {
    moving.setup.runout.radial_offsets.push_back(value.value);
  }
  return static_fit(moving.setup, flutes.record, options, near->law);
}

}  // namespace

MovingFlutes moving_flutes(const MovingCut& cut, const PeriodicMotion& command) {
  return flutes_in(cut, dynamics::motion(problem_of(cut, command)));
}

StaticFit static_reading(const MovingCut& cut, std::span<const double> rho,
                         const StaticFitOptions& options) {
  return reading(cut, rho, options, nullptr);
}

TrueRunout true_runout(const MovingCut& cut, const StaticFit& measured,
                       const StaticFitOptions& options) {
  TrueRunout out;
  if (!measured.ok) {
    out.reason = measured.reason;
    return out;
  }
  out.law = measured.law;
  for (const Value& rho : measured.rho) {
    out.rho.push_back(rho.value);
  }
  StaticFitOptions same = options;
  same.axial = measured.law.K_a1 != 0;
  MovingCut moving = cut;
  for (;;) {
    moving.law = out.law;
    const StaticFit read = reading(moving, out.rho, same, &measured);
    if (!read.ok) {
      out.reason = read.reason;
      break;
    }
    out.read.clear();
    for (const Value& h_ro : read.h_ro) {
      out.read.push_back(h_ro.value);
    }
    const Step step = step_between(measured, read, cut.setup.cut.f_z);
    if (step.largest < agreed) {
      out.ok = true;
      break;
    }
    if (out.iterations >= most_iterations) {
      out.reason = "no runout and law were found whose static reading is the estimate";
      break;
    }
    take(step, out.law, out.rho);
    ++out.iterations;
  }
  out.h_ro = chip_differences(out.rho);
  if (out.ok) {
    moving.setup.runout = {.radial_offsets = out.rho};
    out.peak_difference = peak_difference(moving_flutes(moving, Harmonics{}).flutes);
  }
  return out;
}

}  // namespace trochoid::correction
