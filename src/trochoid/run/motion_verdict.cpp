#include <trochoid/run/motion_verdict.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/growth.h>
#include <trochoid/dynamics/multiplier.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trochoid::run {

namespace {

/// A vibration that grew by more than this in each turn is none that dies out.
constexpr double grows = 1.02;
/// A change that is still this part of what it was a quarter of the turns before.
constexpr double persists = 0.7;
/// How often the number of turns is doubled until the motion repeats.
constexpr int doublings = 3;
/// Flutes that are alike and differ by more than this do not cut alike.
constexpr double differs = 0.02;

/// Of the directional matrices, as in `stability`.
constexpr double matrix_tolerance = 1e-10;
/// In a period of the cut: with more, the linearised cut takes too long.
constexpr double most_vibrations = 400;
/// Changes from turn to turn up to this part of the feed per tooth are small.
constexpr double small = 0.2;

/// Equal pitch, no runout and no command: what one flute does, all do.
bool flutes_alike(const dynamics::MotionProblem& problem) {
  const auto& pitch = problem.setup.cutter.pitch;
  return !problem.command && geometry::runs_true(problem.setup.runout) &&
         std::all_of(pitch.begin(), pitch.end(),
                     [&](double p) { return std::abs(p - pitch.front()) < 1e-9; });
}

Verdict verdict_of(const dynamics::MotionProblem& problem, const Moved& moved) {
  const dynamics::Motion& m = moved.motion;
  if (!m.finite) {
    return Verdict::chatter;
  }
  if (m.periodic) {
    const bool doubled = flutes_alike(problem) && peak_difference(m) > differs;
    return doubled ? Verdict::chatter : Verdict::periodic;
  }
  const bool grew = moved.growth.value_or(0.0) > grows;
  const bool stays = dynamics::late_change(m.once).value_or(0.0) > persists;
  return grew || stays ? Verdict::chatter : Verdict::not_periodic;
}

Moved moved(const dynamics::MotionProblem& problem) {
  Moved all{.motion = dynamics::motion(problem)};
  all.growth =
      dynamics::growth_per_turn(all.motion.once, small * problem.setup.cut.f_z);
  all.verdict = verdict_of(problem, all);
  return all;
}

}  // namespace

double peak_difference(const dynamics::Motion& m) {
  const auto [low, high] = std::minmax_element(
      m.flutes.begin(), m.flutes.end(),
      [](const auto& a, const auto& b) { return a.peak_y < b.peak_y; });
  return high->peak_y > 0 ? (high->peak_y - low->peak_y) / high->peak_y : 0.0;
}

Moved settled(dynamics::MotionProblem& problem, const Progress& progress) {
  Moved all;
  for (int doubled = 0; doubled <= doublings; ++doubled) {
    if (progress) {
      progress(fmt::format("Cutting, {} turns", problem.revolutions));
    }
    all = moved(problem);
    if (all.verdict == Verdict::periodic || !all.motion.finite ||
        all.growth.value_or(0.0) > grows) {
      break;
    }
    if (doubled < doublings) {
      problem.revolutions *= 2;
    }
  }
  return all;
}

std::optional<double> linear_growth(const inputs::Case& given,
                                    const dynamics::System& system) {
  const double Omega = given.setup.cut.Omega;
  const double fastest =
      std::accumulate(system.modes.begin(), system.modes.end(), 0.0,
                      [](double most, const dynamics::ChipMode& mode) {
                        return std::max(most, std::sqrt(mode.stiffness / mode.mass));
                      });
  const inputs::Stability options =
      given.machine.stability.value_or(inputs::Stability{});
  const dynamics::DirectionalModel model(given.setup, given.law, options.chip_floor,
                                         matrix_tolerance);
  const auto directional = model.at_depth(given.setup.cut.a_p);
  if (fastest * directional.period / (unit::turn * Omega) > most_vibrations) {
    return std::nullopt;
  }
  const auto mu = dynamics::multiplier(directional, system, Omega, options.tolerance);
  return std::pow(std::abs(mu.value), unit::turn / directional.period);
}

std::string chatter_message(const Moved& moved, std::optional<double> linear_growth) {
  const dynamics::Motion& m = moved.motion;
  std::string text = "chatter: ";
  if (!linear_growth) {
    text += "the vibration does not die out";
  } else if (*linear_growth > 1) {
    text += fmt::format("a small vibration grows to {:.4g} of itself in each turn",
                        *linear_growth);
  } else {
    text += fmt::format(
        "the linearised cut is stable (a small vibration fades to {:.4g} of itself in "
        "each turn), the motion is not",
        *linear_growth);
  }
  if (!m.finite) {
    return text +
           fmt::format("; after {} turns it had grown beyond all bounds", m.turns_done);
  }
  if (m.periodic) {
    return text +
           "; the teeth are alike, yet they do not cut alike: the motion repeats only "
           "after several teeth";
  }
  return text +
         fmt::format("; the motion does not come to repeat itself within {} turns",
                     m.turns_done);
}

}  // namespace trochoid::run
