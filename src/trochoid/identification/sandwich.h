#pragma once

#include <trochoid/identification/problem.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::identification {

/// @brief What a fit leaves, and of what.
struct Leftover {
  double rss = 0.0;        ///< of all samples [N^2]
  double equations = 0.0;  ///< that rss stands for
  std::span<const Run> runs;
  std::span<const std::vector<std::array<double, 3>>> fitted;  ///< as Fit::fitted
  std::span<const double> rows;  ///< residual rows of the problem
};

/// @brief Covariance of unknowns whose residuals are not white noise.
struct Sandwich {
  std::vector<double> covariance;  ///< shape (unknowns, unknowns)
  double freedom = 0.0;            ///< of its least known variance
  double chance = 0.0;  ///< sum of squares that an unknown explains by chance [N^2]
};

/// @brief Covariance by the spectrum of what the fit leaves, and by how far the runs agree.
///
/// What repeats turn by turn is taken as one draw of a random function of the angle, of a
/// power that changes slowly with the harmonic and may differ between the harmonics of the
/// teeth and the others; what differs from turn to turn as noise. No further turn
/// averages the first away.
///
/// @eq I-14 cov = G^-1 (sum over rows of x x^T P) G^-1, P = scatter + max(0, sum (r^2 -
///          scatter (1 - h))/sum (1 - h)), h = x^T G^-1 x, over near rows of a kind
/// @eq I-15 of R > 1 runs: times max(1, B^2), B^2 = mean over unknowns of R/(R - 1)
///          sum_r (G^-1 J_r^T d_r)^2 / cov
/// @src [white1980], [newey1987]; I-15 after the scale factor of [birge1932]
/// @param J             columns of the unknowns, shape (rows of the problem, unknowns)
/// @param inverse_gram  G^-1 = (J^T J)^-1
/// @param shared        unknowns that all runs have in common
/// @return nothing where a run has too few whole turns for a spectrum
std::optional<Sandwich> sandwich(const Problem& problem, const numerics::Columns& J,
                                 std::span<const double> inverse_gram,
                                 std::span<const std::size_t> shared,
                                 const Leftover& left);

}  // namespace trochoid::identification
