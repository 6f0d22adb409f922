#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace trochoid::numerics {

/// @brief Residuals r(p), and their derivatives when `jacobian` is not empty.
///
/// jacobian: column-major, shape (residuals, parameters). Scale r and p to about one:
/// the tolerances refer to that. Returns false where r cannot be evaluated; a step that
/// leads there is taken back.
using Residuals = std::function<bool(std::span<const double> p, std::span<double> r,
                                     std::span<double> jacobian)>;

struct LevenbergMarquardtOptions {
  int max_iterations = 60;
  double gradient_tolerance = 1e-14;   ///< largest |J^T r|
  double parameter_tolerance = 1e-10;  ///< |step| relative to |p|
  double function_tolerance = 1e-22;   ///< change of |r|^2
  /// A step that promises to change |r|^2 by less than one of so many standard errors
  /// would, what is left taken for noise, is negligible. The secant version alone asks.
  double standard_errors = 0.0;
};

struct LevenbergMarquardtSummary {
  std::vector<double> p;
  double initial_cost = 0.0;  ///< |r|^2/2
  double final_cost = 0.0;    ///< |r|^2/2
  int iterations = 0;
  bool converged = false;
  std::string reason = "not started";
};

/// @brief Local minimum of |r(p)|^2 near the start.
/// @src [madsen2004], with the scaling and the ends of TinySolver in [ceres2022]
LevenbergMarquardtSummary levenberg_marquardt(const Residuals& residuals,
                                              int residual_count,
                                              std::vector<double> start,
                                              const LevenbergMarquardtOptions& options);

/// @brief Covariance of the parameters at the end of a search, what is left taken for white
/// noise; row-major, empty where some of them cannot be told apart.
///
/// @eq I-4 2 cost/(m - n) (J^T J)^-1
/// @param cost            |r|^2/2 at p
/// @param rank_tolerance  as of least_squares
std::vector<double> covariance_at(const Residuals& residuals, int residual_count,
                                  std::span<const double> p, double cost,
                                  double rank_tolerance);

}  // namespace trochoid::numerics
