#pragma once

#include <trochoid/identification/find_axes.h>
#include <trochoid/inputs/case.h>

namespace trochoid::run {

/// @brief Options of one fit as [identify] asks for them.
identification::Options fit_options(const inputs::Case& given, chip::Model model);

/// @brief What is fitted to find out what the channels read.
identification::AxesProblem axes_problem(const inputs::Case& given);

}  // namespace trochoid::run
