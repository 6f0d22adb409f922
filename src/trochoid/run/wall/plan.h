#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/plan_wall.h>
#include <trochoid/run/shared/progress.h>

namespace trochoid::run {

/// @brief How to measure a wall so that it tells the coefficients and the runout as well
/// as is wanted (E-60), and which cut and which wall keep an allowed error.
///
/// About the coefficients and the runout of the case; with measurements about what
/// these tell.
/// @throws base::InputError when a measurement cannot be used
results::PlanWallResult plan_wall(const inputs::Case& given, const Progress& progress);

}  // namespace trochoid::run
