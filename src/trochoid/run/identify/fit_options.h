#pragma once

#include <trochoid/identification/find_axes.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/shared/progress.h>

namespace trochoid::run {

/// @brief Options of one fit as [identify] asks for them.
identification::Options fit_options(const inputs::Case& given, chip::Model model);

/// @brief What is fitted to find out what the channels read.
identification::AxesProblem axes_problem(const inputs::Case& given);

/// @brief What to say while that is done.
/// @param part  of it that is done, from 0 to 1
Step axes_progress(double part);

}  // namespace trochoid::run
