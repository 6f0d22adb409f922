#pragma once

#include <trochoid/identification/channel_rows.h>
#include <trochoid/numerics/combinations.h>

#include <span>
#include <vector>

/// Search for what is not linear in a fit to the channels of a sensor.
namespace trochoid::identification {

/// Singular values below this part of the largest do not count.
inline constexpr double channel_rank_tolerance = 1e-8;

/// Equations with the rows of the prior below them, data weighted by `scale`.
struct Equations {
  std::vector<double> A;  ///< row-major, shape (m, columns)
  std::vector<double> b;
};

/// @brief Equations of the data and, below them, those of the prior.
/// @param A      rows of the data, row-major; coefficients are its first columns
/// @param scale  factor of the data, where their standard deviations are only relative
Equations with_prior(const ChannelProblem& problem, std::vector<double> A,
                     std::span<const double> y, double scale);

numerics::Combinations solved(const Equations& equations, double tolerance);

/// A fit in the making: the problem, its data and how much they count.
struct ChannelSearch {
  const ChannelProblem& problem;
  std::vector<double> y;
  double scale = 1.0;

  /// Coefficients at a point.
  [[nodiscard]] numerics::Combinations at(const ChannelPoint& point) const;
};

/// @brief The unknowns that leave least (I-27), all coefficients free; empty: there are none.
std::vector<double> best_unknowns(const ChannelSearch& search);

}  // namespace trochoid::identification
