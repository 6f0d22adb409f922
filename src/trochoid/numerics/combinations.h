#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::numerics {

/// @brief What equations A x = b tell of x, where they need not tell all of it.
///
/// Every known linear combination of x is one of those listed, which are in reduced echelon
/// form: each has the weight 1 at its own unknown, the pivot, and 0 at the other pivots. An
/// unknown that is known alone is a combination without further weights.
struct Combinations {
  std::vector<std::size_t> pivots;  ///< ascending, shape (r)
  std::vector<double> weights;      ///< row-major, shape (r, n)
  std::vector<double> value;        ///< shape (r)
  std::vector<double> covariance;   ///< for rows with an error of 1, shape (r, r)
  double condition =
      0.0;           ///< largest over smallest singular value that counts, of A with
                     ///< columns of length one
  double rss = 0.0;  ///< sum of the squared residuals
  std::vector<double> x;         ///< one of the solutions, shape (n)
  std::vector<double> residual;  ///< b - A x, shape (m)

  [[nodiscard]] std::size_t rank() const noexcept { return pivots.size(); }
  /// Whether a combination is one unknown alone.
  [[nodiscard]] bool alone(std::size_t i) const noexcept;
};

/// @brief Least squares, and which combinations of the unknowns it determines.
///
/// @eq  I-26 A S = A_p B: B reduced echelon form of the row space of A S, A_p its pivot
///      columns; B S^-1 x = y, cov(y) = (A_p^T A_p)^-1
/// @src derived
///
/// @param[in] A  row-major, shape (m, n); a column of zeros is an unknown of which nothing is
///               told
/// @param[in] rank_tolerance  relative to the largest singular value
/// @throws std::invalid_argument when the shapes do not agree
Combinations known_combinations(std::span<const double> A, int n,
                                std::span<const double> b, double rank_tolerance);

}  // namespace trochoid::numerics
