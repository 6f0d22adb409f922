#pragma once

#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief What a spherical probe tip reads of a
/// profile: it stops at the first material.
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

/// @brief What a sphere reads more at each of some heights.
/// @eq E-14 with the slope of the parabola through a height and its two nearest; of
///          one height alone the slope is not known and counts as none
/// @param heights  above the tip, all different [m]
/// @param mean     error of the wall at each, along the feed [m]
/// @return shape of heights [m]
std::vector<double> readings_on_slopes(double radius, std::span<const double> heights,
                                       std::span<const double> mean);

}  // namespace trochoid::surface
