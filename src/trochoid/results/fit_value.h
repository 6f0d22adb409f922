#pragma once

#include <trochoid/identification/identify.h>
#include <trochoid/results/value.h>

namespace trochoid::results {

/// @brief One entry of `fits` of the summary.
Object fit_value(const identification::Fit& fit);

}  // namespace trochoid::results
