#pragma once

#include <trochoid/chip/intervals.h>
#include <trochoid/dynamics/steady_state.h>
#include <trochoid/dynamics/surface_location.h>
#include <trochoid/results/answer.h>

#include <optional>
#include <vector>

namespace trochoid::results {

/// @brief What `dynamics` answers: motion, forces and finished walls of a cut that
/// moves.
struct MotionResult {
  Heading heading;
  dynamics::System system;  ///< what vibrates
  force::ProcessDamping damping;
  int steps_per_tooth = 0;  ///< how finely the motion was followed
  /// Where the tip of a nominal tooth enters and leaves the stock.
  chip::Arc engagement;
  std::vector<double> entry;  ///< spindle angle at which each tip enters [rad]
  std::optional<dynamics::SteadyState> steady;  ///< none: there is no motion to tell of
  /// By what a small vibration grows in a turn, from the linearised cut; none: it would
  /// take too long.
  std::optional<double> linear_growth;
  std::vector<dynamics::WallLocation> walls;  ///< none where it chatters
};

Answer answer_of(const MotionResult& result);

}  // namespace trochoid::results
