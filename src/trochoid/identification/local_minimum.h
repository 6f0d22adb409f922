#pragma once

#include <trochoid/identification/derivatives.h>
#include <trochoid/numerics/levenberg_marquardt.h>

#include <memory>
#include <string>
#include <vector>

namespace trochoid::identification {

/// A minimum over p with the coefficients at their best for every p.
struct Minimum {
  std::vector<double> p;
  double rss = 0.0;  ///< [N^2], over the rows of the problem
  bool converged = false;
  std::string reason;
  double correlation =
      1.0;  ///< of residuals at neighbouring angles, where refine ended
  std::shared_ptr<Evaluation> at;  ///< where refine ended; or null
};

/// @brief Sum of squares at p with the best coefficients [N^2]; infinite out of range.
double rss_at(const Problem& problem, std::span<const double> p);

/// @brief The same beside an evaluation nearby.
/// @param[in,out] last  serves again where only phases differ; becomes that at p
double rss_at(const Problem& problem, std::span<const double> p, Evaluation& last);

/// @brief Local minimum by Levenberg-Marquardt with the coefficients eliminated.
///
/// @eq  I-3 r(p) = (1 - P) {F}, dr/dp = -(1 - P) d[D]/dp {K}, P the projection on [D]
/// @src [golub1973], in the form of [kaufman1975]: exact gradient, Gauss-Newton Hessian;
///      Jacobians are kept from step to step (secant_levenberg_marquardt)
Minimum refine(const Problem& problem, std::vector<double> start, const Step& step,
               const numerics::LevenbergMarquardtOptions& options);

/// @brief Whether the edges enter so suddenly that the sum of squares jumps when one of
/// them passes a sample.
bool sum_of_squares_jumps(const Problem& problem);

/// @brief The same problem without the jumps: its runs in a band, with rows from the
/// turn. Its minimum is near.
Problem smooth_problem(const Problem& problem);

/// @brief The minimum near a start.
///
/// The phases at which an edge passes a sample are known: the sum of squares is compared
/// between them, and followed downhill from the best places, until nothing changes.
Minimum refine_between_jumps(const Problem& problem, std::vector<double> start);

}  // namespace trochoid::identification
