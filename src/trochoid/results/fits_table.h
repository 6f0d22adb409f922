#pragma once

#include <trochoid/identification/identify.h>

#include <span>
#include <string>

namespace trochoid::results {

/// @brief The fits side by side, for a person; `+-` is half of a 95 % interval.
std::string fits_table(std::span<const identification::Fit> fits);

}  // namespace trochoid::results
