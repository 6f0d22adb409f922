#pragma once

#include <trochoid/results/stability.h>

#include <optional>

namespace trochoid::results {

/// A spindle does not keep a speed better than this, nor is the peak of a lobe known.
inline constexpr double speed_slack = 0.02;

/// A speed near that of the case which allows more.
struct BetterSpeed {
  double Omega = 0.0;  ///< [rad/s]
  double depth = 0.0;  ///< that is stable there and a little beside it [m]
};

/// Speeds of the spindle [rad/s].
struct SpeedRange {
  double from = 0.0;
  double to = 0.0;
};

/// @brief The deepest limit of the diagram near the speed of the case.
///
/// Near: within 30 %. A limit counts as the least within 2 % of its speed, all of which the
/// diagram must hold, and only where it is 1.2 times that of the case, taken so too. Speeds
/// at which all depths of the diagram are stable allow its greatest.
/// @return nothing where there is none, and where the case has no limit
std::optional<BetterSpeed> better_speed(const StabilityResult& result);

/// @brief The limit of the case while its spindle is off by up to 2 % [m].
/// @return nothing where the diagram does not hold the speed of the case, or is not done
std::optional<double> limit_of_a_spindle(const StabilityResult& result);

/// @brief Among which speeds better_speed looks: near, and of the diagram.
/// @return nothing where there are none
std::optional<SpeedRange> speeds_looked_at(const StabilityResult& result);

}  // namespace trochoid::results
