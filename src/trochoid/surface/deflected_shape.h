#pragma once

#include <trochoid/surface/bodies.h>

#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief The deflected shapes of cutter and wall at one spindle angle.
struct DeflectedShape {
  double phi = 0.0;             ///< spindle angle [rad]
  double F_normal = 0.0;        ///< positive: pushes cutter and wall apart [N]
  std::vector<double> heights;  ///< above the tip: from the foot of the wall up [m]
  std::vector<double> cutter;   ///< of its axis, positive: away from the wall [m]
  std::vector<double> wall;     ///< positive: away from the cutter [m]
};

/// @brief Heights at which both are told: over the axial depth, along the wall and
/// along the cutter, ascending [m].
std::vector<double> shape_heights(const Bodies& bodies, double a_p);

/// @brief Both shapes under the force of one moment; 0 where a body does not reach.
///
/// E-5 and E-6 of each body alone: at a height where both are, they add up to the
/// deflection that makes the error there.
/// @param moments  of the force, shape (basis points, then F_x, F_y)
/// @param sigma    of the side (E-1)
DeflectedShape deflected_shape(const Compliance& compliance,
                               std::span<const double> moments, double sigma);

}  // namespace trochoid::surface
