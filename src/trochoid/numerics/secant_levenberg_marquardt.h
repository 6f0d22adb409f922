#pragma once

#include <trochoid/numerics/levenberg_marquardt.h>

#include <vector>

namespace trochoid::numerics {

/// @brief Local minimum of |r(p)|^2 near the start, where Jacobians are dear.
///
/// A Jacobian is asked for at the start, where steps no longer gain what they promise,
/// and once more near the end; from step to step it is kept, and corrected by what the
/// step has shown (Broyden): J += (r(p + h) - r(p) - J h) h^T/(h^T h). The minimum is that
/// of a Jacobian asked for nearby, within a hundred times the parameter tolerance.
/// @src [madsen2004], the secant version
LevenbergMarquardtSummary secant_levenberg_marquardt(
    const Residuals& residuals, int residual_count, const std::vector<double>& start,
    const LevenbergMarquardtOptions& options);

}  // namespace trochoid::numerics
