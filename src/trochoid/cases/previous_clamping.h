#pragma once

#include <optional>

namespace trochoid::cases {

/// The eccentricity of the same tool, found before it was turned in its holder.
struct PreviousClamping {
  double eccentricity = 0.0;              ///< [m]
  double angle = 0.0;                     ///< [rad]
  double turned = 0.0;                    ///< from then to now [rad]
  std::optional<double> eccentricity_se;  ///< [m]; absent: known like the present one
  std::optional<double> angle_se;         ///< [rad]
};

}  // namespace trochoid::cases
