#pragma once

#include <trochoid/geometry/cutter.h>

#include <array>

namespace trochoid::geometry {

/// A point of the meridian profile.
struct MeridianPoint {
  double r = 0.0;          ///< distance from the cutter axis [m]
  double z = 0.0;          ///< height above the tip [m]
  double sin_kappa = 1.0;  ///< of the axial immersion angle kappa
  double cos_kappa = 0.0;
};

/// @brief The profile as a curve over its arc length s, from the axis outwards.
///
/// @eq G-2 z = r tan(alpha), kappa = alpha                         (bottom cone, O-M)
/// @eq G-3 (r-Rr)^2 + (z-Rz)^2 = R^2, sin(kappa) = (r-Rr)/R        (corner, M to N)
/// @eq G-4 r = u + z tan(beta), kappa = pi/2 - beta                (flank, from N)
/// @eq G-5 M and N: where the arc meets the cone and the flank
/// @src [riviere2009] section 3.1, after the general
/// cutter of [engin2001]; N and M derived
/// @note A flat bottom (alpha = 0) carries no edge: then s = 0 at M.
struct Meridian {
  Profile profile;
  MeridianPoint M;     ///< end of the cone
  MeridianPoint N;     ///< start of the flank
  double s_M = 0.0;    ///< [m]
  double s_N = 0.0;    ///< [m]
  double chi_M = 0.0;  ///< kappa of the arc at M [rad]
};

/// @throws std::invalid_argument when the parameters make no profile
Meridian meridian(const Profile& profile);

/// @param s  arc length from the start of the edge [m], at least 0
MeridianPoint point_at(const Meridian& m, double s) noexcept;

/// @brief Arc length at which the profile reaches a height.
/// @param z  height above the tip [m], at least that of the start of the edge
double arc_length_at(const Meridian& m, double z) noexcept;

}  // namespace trochoid::geometry
