#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/plan.h>
#include <trochoid/run/shared/progress.h>

namespace trochoid::run {

/// @brief Which cut to measure next: the one after which the quantities of [plan] are
/// known best (I-20, I-21), told from the measurements of a case, or from its
/// coefficients as if nothing had been measured.
/// @throws base::InputError when a measurement cannot be used
results::PlanResult plan(const inputs::Case& given, const Progress& progress);

}  // namespace trochoid::run
