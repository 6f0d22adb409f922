#pragma once

#include <trochoid/identification/identify.h>
#include <trochoid/inputs/case.h>

namespace trochoid::run {

/// @brief Options of one fit as [identify] asks for them.
identification::Options fit_options(const inputs::Case& given, chip::Model model);

}  // namespace trochoid::run
