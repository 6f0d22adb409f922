#pragma once

#include <array>

namespace trochoid::force {

/// Force [N] in x, y, z, torque about the spindle axis and bending moments about x and y
/// [N m].
using SixLoads = std::array<double, 6>;

/// @brief An element of edge: which way it faces and where it is.
struct Element {
  double sine = 0.0;  ///< of theta, effective
  double cosine = 0.0;
  double sin_kappa = 0.0;
  double cos_kappa = 0.0;
  double R = 0.0;  ///< distance from the axis of rotation [m]
  double z = 0.0;  ///< height above the section that bends [m]
};

/// @brief Add what a force on an element does.
/// @eq F-3 [B] = [-cos(theta), -sin(theta) sin(kappa), -sin(theta) cos(kappa);
///                 sin(theta), -cos(theta) sin(kappa), -cos(theta) cos(kappa);
///                 0, cos(kappa), -sin(kappa)], from (t, r, a) to (x, y, z)
/// @eq F-6 T = sum of R dF_t; power = T Omega; positive where the spindle must drive
/// @eq F-7 M = sum of r x dF
/// @src [riviere2009] eq. 18 with the third row repaired; F-6, F-7 derived
/// @param tra  force in t, r and a [N]
inline void add_loads(const Element& at, const std::array<double, 3>& tra,
                      SixLoads& sum) noexcept {
  const auto [t, r, a] = tra;
  const double inward = r * at.sin_kappa + a * at.cos_kappa;
  const double F_x = -t * at.cosine - inward * at.sine;  // F-3
  const double F_y = t * at.sine - inward * at.cosine;
  const double F_z = r * at.cos_kappa - a * at.sin_kappa;
  sum[0] += F_x;
  sum[1] += F_y;
  sum[2] += F_z;
  sum[3] += at.R * t;                             // F-6
  sum[4] += at.R * at.cosine * F_z - at.z * F_y;  // F-7
  sum[5] += at.z * F_x - at.R * at.sine * F_z;
}

}  // namespace trochoid::force
