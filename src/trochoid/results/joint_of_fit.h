#pragma once

#include <trochoid/identification/identify.h>
#include <trochoid/results/joint.h>

namespace trochoid::results {

/// @brief What another case takes of a fit, with its covariance: coefficients of one
/// group of records, runout and exponents. Phases and channels are of the record alone.
Joint joint_of(const identification::Fit& fit, std::size_t group);

}  // namespace trochoid::results
