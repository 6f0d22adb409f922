#pragma once

namespace trochoid::numerics {

/// @brief Quantile of Student's t distribution.
/// @param probability  in (0, 1); 0.975 gives the factor of a two-sided 95 % interval
/// @param freedom      degrees of freedom, above 0
/// @throws std::domain_error outside of these ranges
double student_t(double probability, double freedom);

}  // namespace trochoid::numerics
