#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/plan_wall.h>
#include <trochoid/surface/plan_wall.h>

#include <optional>

namespace trochoid::run {

/// Both bodies with the cutter at x, the wall solved once for each x.
surface::BodiesAt solved_once(surface::BodiesAt bodies);

/// @brief The wall of a case made another.
/// @param thickness, position  nothing: as in the case [m]
surface::BodiesAt bodies_of(const inputs::Case& given, double a_p,
                            std::optional<double> thickness = {});

/// @brief The error over feeds and radial depths, and what keeps the allowed one.
/// @param expected  with the coefficients and the runout that are expected
results::PlannedCutting plan_cutting(const inputs::Case& given,
                                     const surface::Setting& expected);

}  // namespace trochoid::run
