#pragma once

#include <array>
#include <span>
#include <vector>

namespace trochoid::signal {

/// The spindle angle of a record whose speed wanders.
struct Wander {
  std::vector<double> angle;  ///< corrected [rad], shape (n); empty: nothing to correct
  double slowest = 1.0;       ///< speed over the mean one, least of a smoothed turn
  double fastest = 1.0;       ///< and most
};

/// @brief Follow a speed that wanders by the phase of the lines of the spindle from turn to
/// turn, where angles follow from times at one speed.
///
/// @eq S-10 delta_b = sum_ck k Im(conj(C_ck) c_ckb)/sum_ck k^2 |C_ck|^2, one a turn b
/// @src derived
///
/// Turns are compared with those in the middle, outwards. The phases are smoothed over as
/// many turns as foretell one that is left out best; where that is not clearly better than a
/// straight line, the speed is constant.
/// @param angle  [rad], shape (n), at constant speed
Wander follow_speed(const std::array<std::vector<double>, 3>& channels,
                    std::span<const double> angle);

/// By how much the force grows over a record.
struct Growth {
  double growth = 0.0;  ///< from the first turn to the last, over the mean
  double se = 0.0;      ///< standard error
};

/// @brief Growth of the lines of the spindle from the first turn to the last, by a straight
/// line through the size of each turn.
/// @return 0 of a record of less than 16 turns
Growth growth_of_force(const std::array<std::vector<double>, 3>& channels,
                       std::span<const double> angle);

}  // namespace trochoid::signal
