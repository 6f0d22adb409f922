#pragma once

#include <trochoid/base/table.h>
#include <trochoid/inputs/case.h>
#include <trochoid/surface/bodies.h>

#include <span>
#include <vector>

namespace trochoid::run {

/// @brief Cutter and wall at the moment of the largest force across the wall.
struct Bent {
  double phi = 0.0;             ///< spindle angle [rad]
  double F_normal = 0.0;        ///< positive: pushes cutter and wall apart [N]
  std::vector<double> heights;  ///< above the tip: from the foot of the wall up [m]
  std::vector<double> cutter;   ///< of its axis, positive: away from the wall [m]
  std::vector<double> wall;     ///< positive: away from the cutter [m]
};

/// Heights at which both are told: along the wall, and along the cutter.
std::vector<double> bent_heights(const inputs::Case& given);

/// @param moments  of the force at that angle, shape (basis points, then F_x, F_y)
Bent bent(const inputs::Case& given, const surface::Bodies& bodies,
          std::span<const double> moments, double sigma);

/// bent.csv: height_mm, cutter_mm, wall_mm; 0 where a body does not reach.
base::Table bent_table(const Bent& bent);

}  // namespace trochoid::run
