#pragma once

#include <trochoid/results/stability.h>

#include <optional>

namespace trochoid::results {

/// A speed near that of the case which allows more.
struct BetterSpeed {
  double Omega = 0.0;  ///< [rad/s]
  double depth = 0.0;  ///< that is stable there and a little beside it [m]
};

/// @brief The deepest limit of the diagram near the speed of the case.
///
/// Near: within 30 %. A limit counts as the least within 2 % of its speed, and only where
/// it is 1.2 times that of the case. Speeds at which all depths of the diagram are stable
/// allow its greatest.
/// @return nothing where there is none, and where the case has no limit
std::optional<BetterSpeed> better_speed(const StabilityResult& result);

}  // namespace trochoid::results
