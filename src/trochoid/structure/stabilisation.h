#pragma once

#include <trochoid/structure/frequency_response.h>

#include <vector>

namespace trochoid::structure {

/// How a pole stands beside those with one pair less.
enum class PoleStanding { fresh, same_frequency, stable };

struct TriedPole {
  int order = 0;       ///< pairs of poles that were looked for together
  double omega = 0.0;  ///< [rad/s]
  double zeta = 0.0;
  PoleStanding standing = PoleStanding::fresh;
};

/// @brief The poles of M-5 for one pair, two pairs and so on: the diagram of
/// stabilisation.
///
/// @eq  M-18  same frequency: |omega - omega'| < 0.01 omega;  stable: |zeta - zeta'| <
///            0.05 zeta as well, primes for the nearest of the order before
/// @src derived; the limits are those usual in laboratories
/// @param response  without the line at 0 Hz; many lines are thinned (M-35)
/// @param highest  number of pairs
/// @return those inside the band with zeta below 0.5, by order and frequency
std::vector<TriedPole> stabilisation(const FrequencyResponse& response, int highest);

/// @brief Where a response is all in quadrature: 1 there, 0 where it is in phase.
///
/// @eq  M-19  MIF = (Im H)^2/|H|^2 of the receptance
/// @src derived from M-3: the receptance of one mode is imaginary at its natural frequency
/// @return of each line, in [0, 1]; 0 where H is 0
std::vector<double> mode_indicator(const FrequencyResponse& lines);

}  // namespace trochoid::structure
