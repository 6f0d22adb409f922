#pragma once

#include <trochoid/identification/identify.h>

#include <span>
#include <string>

namespace trochoid::results {

/// @brief The groups of a fit side by side, each with its coefficients.
std::string groups_table(const identification::Fit& fit);

/// @brief The fits side by side, for a person; `+-` is half of a 95 % interval. Of fits
/// with several groups without the coefficients, of which each group has its own.
std::string fits_table(std::span<const identification::Fit> fits);

}  // namespace trochoid::results
