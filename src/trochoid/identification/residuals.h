#pragma once

#include <trochoid/identification/fit.h>
#include <trochoid/identification/problem.h>

#include <span>

namespace trochoid::identification {

/// @brief RMS and correlation of what a fit leaves, and how much of the force that is.
///
/// Each run counts in its own band: where one is set
/// by its harmonics, else by its samples.
///
/// @eq I-5 RMS_q = sqrt(mean over samples of dF_q^2), RMS^2 = sum_q RMS_q^2
/// @eq I-8 r = sum(dF_i dF_(i+1)) / sum(dF_i^2), over channels and runs
/// @eq I-9 u = sqrt(sum |dF|^2 / sum |F|^2), over the samples or over the rows in
///         the band
///
/// @param left  residual rows of the problem, shape (rows)
/// @param fit   with its `fitted`; the RMS, the correlation and `unexplained` are set
void fill_residuals(const Problem& problem, std::span<const Run> runs,
                    std::span<const double> left, Fit& fit);

/// @brief Sum of squares that the folded rows no longer hold, because no model changes
/// it: the scatter of samples at the same angle [N^2]; 0 with a band limit.
double scatter_of(const Run& run, const FoldedRun& folded);

}  // namespace trochoid::identification
