#pragma once

#include <trochoid/identification/identify.h>
#include <trochoid/results/value.h>

namespace trochoid::results {

/// @brief One entry of `fits` of the summary.
Object fit_value(const identification::Fit& fit);

/// @brief What each group of records found: its name, coefficients and files.
/// @param files  one a record
Array groups_value(const identification::Fit& fit, std::span<const std::string> files);

}  // namespace trochoid::results
