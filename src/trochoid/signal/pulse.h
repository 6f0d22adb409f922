#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace trochoid::signal {

/// The spindle angle by a pulse once a turn.
struct PulseAngle {
  std::vector<double> angle;  ///< [rad], shape (n), rising; empty: there is none
  std::size_t found = 0;      ///< pulses
  std::size_t filled = 0;     ///< pulses that were missing among them
  double slowest = 0.0;       ///< spindle speed of the longest turn [rad/s]
  double fastest = 0.0;       ///< of the shortest one
  std::string why;            ///< without angles, the reason
};

/// @brief Spindle angle from a channel with one pulse in each turn.
///
/// @eq  S-7  phi(t) = 2 pi (j + (t - t_j)/(t_(j+1) - t_j)), t_j the j-th rising edge
///
/// An edge is where the channel rises through the middle of its range, after it was in the
/// lowest quarter. Where the time to the next pulse is 2 to 20 turns of the one before,
/// within a quarter of a turn, the pulses between are missing and filled in evenly. Turns differ by at
/// most 30 % from the one before. Before the first and after the last pulse the spindle
/// turns as next to it.
/// @param values  of the channel, shape (n), in any unit
/// @param time    [s], shape (n), increasing
/// @throws std::invalid_argument when they differ in length
PulseAngle angle_of_pulses(std::span<const double> values,
                           std::span<const double> time);

}  // namespace trochoid::signal
