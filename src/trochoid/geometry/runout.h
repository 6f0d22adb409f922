#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

namespace trochoid::geometry {

/// How an eccentricity changes radius and angle of an edge point.
enum class EccentricityOrder {
  exact,  ///< R = |r + rho|, and the angle turns by epsilon
  first,  ///< R = r + rho cos(c), the angle stays
};

/// The names that files use.
constexpr std::string_view name_of(EccentricityOrder order) noexcept {
  switch (order) {
    case EccentricityOrder::exact:
      return "exact";
    case EccentricityOrder::first:
      return "first";
  }
  return {};
}

/// @brief Runout: offsets of each tooth, eccentricity and tilt of the cutter; they add up.
struct Runout {
  std::vector<double> radial_offsets;  ///< [m], shape (teeth), or empty: all zero
  double eccentricity = 0.0;           ///< rho [m]: rotation centre to geometric centre
  double angle = 0.0;  ///< lambda [rad], from the tip of tooth 1 towards tooth 2
  EccentricityOrder order = EccentricityOrder::exact;
  std::vector<double> axial_offsets = {};  ///< [m], positive: deeper; shape (teeth), or
                                           ///< empty: all zero
  double tilt = 0.0;  ///< of the tool axis against the rotation axis [rad]
  double tilt_angle =
      0.0;  ///< mu [rad]: where the top leans to, from the tip of tooth 1
            ///< towards tooth 2
};

/// @brief Whether all teeth reach as deep, and stand upright.
inline bool level(const Runout& runout) noexcept {
  return runout.tilt == 0 &&
         std::all_of(runout.axial_offsets.begin(), runout.axial_offsets.end(),
                     [](double offset) { return offset == 0; });
}

/// @brief Whether no tooth is longer than another.
inline bool equal_offsets(const Runout& runout) noexcept {
  const auto& offsets = runout.radial_offsets;
  return std::all_of(offsets.begin(), offsets.end(),
                     [&](double offset) { return offset == offsets.front(); });
}

/// @brief Whether the runout leaves all teeth alike.
inline bool runs_true(const Runout& runout) noexcept {
  return runout.eccentricity == 0 && equal_offsets(runout) && level(runout);
}

/// @brief Where the runout puts an edge point, seen from the axis of rotation.
/// @eq G-1 x = R sin(theta + epsilon), y = R cos(theta + epsilon),
///         theta_j = phi - psi_j - lag
struct EdgePosition {
  double R = 0.0;        ///< radius [m]; not positive: this point does not cut
  double epsilon = 0.0;  ///< angle by which it comes later than its nominal theta [rad]
};

}  // namespace trochoid::geometry
