#pragma once

#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief What a spherical probe tip reads of a profile: it stops at the first
/// material.
///
/// @eq E-13 reading(x) = max over x' of e(x') - (r - sqrt(r^2 - (x' - x)^2))
/// @src derived; the measuring machine takes the radius off again
/// @param profile  e at equal steps over a period that repeats [m]
/// @param step     between them [m]
/// @param radius   of the tip [m], positive
/// @return shape of profile
std::vector<double> probe_reading(std::span<const double> profile, double step,
                                  double radius);

/// @brief By how much a sphere reads more on a wall that leans over the height.
/// @eq E-14 r (sqrt(1 + s^2) - 1)
/// @src derived: a sphere that touches a plane of slope s
/// @param slope  de/dh, per unit
double reading_on_slope(double radius, double slope) noexcept;

}  // namespace trochoid::surface
