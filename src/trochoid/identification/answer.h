#pragma once

#include <trochoid/identification/fit.h>
#include <trochoid/identification/uncertainty.h>
#include <trochoid/numerics/least_squares.h>

#include <span>

namespace trochoid::identification {

/// @brief Number of equations: three a sample, or three a column of the band.
double equations_of(const Problem& problem, std::span<const Run> runs);

/// @brief Fitted forces and channel offsets, and what they leave (fill_residuals).
void fill_fitted(const Problem& problem, std::span<const Run> runs,
                 const Evaluation& at, const numerics::LeastSquares& linear, Fit& fit);

/// @brief Values with standard errors and intervals, and what has none.
///
/// @eq I-8 value +- t_0.975(freedom) se
void fill_estimates(const Problem& problem, std::span<const double> p,
                    std::span<const double> K, const Uncertainty& known, Fit& fit);

/// @brief What was found with an error, and its covariance (I-4, I-14): of the phases and
/// of the constants of channels the rest is taken whatever they are.
FoundTogether found_together(const Problem& problem, std::span<const double> p,
                             std::span<const double> K, const Uncertainty& known);

/// No coefficient has a value, for the reason in the message.
void refuse_coefficients(const Problem& problem, Fit& fit);

/// One tooth meets only its own marks: no runout can be seen.
void refuse_runout_of_one_tooth(Fit& fit);

}  // namespace trochoid::identification
