#pragma once

#include <trochoid/correction/plan.h>
#include <trochoid/correction/residual_map.h>

#include <string>
#include <vector>

namespace trochoid::correction {

/// One curve of the map.
struct NamedStrategy {
  std::string name;  ///< for example `sine_lead`
  Strategy strategy;
};

/// @brief Differences of the peaks over the spindle speed, of a rigid cut.
struct SpeedMap {
  std::vector<NamedStrategy> strategies;
  std::vector<double> Omega;     ///< [rad/s]
  std::vector<MapPoint> points;  ///< shape (strategies, speeds)
  /// Highest speed of each strategy that keeps the difference allowed [rad/s]
  std::vector<double> highest;
};

/// @brief A plan at other speeds, beside four usual strategies.
/// @param options  of the plan; without spindle speeds the map is empty
SpeedMap speed_map(const Setting& setting, const Plan& plan,
                   const CorrectionOptions& options);

}  // namespace trochoid::correction
