#pragma once

#include <trochoid/numerics/columns.h>

#include <span>
#include <vector>

namespace trochoid::numerics {

/// @brief min |A x - b|, with what tells whether x is an answer.
struct LeastSquares {
  std::vector<double> x;         ///< shape (n); basic solution when rank < n
  std::vector<double> residual;  ///< b - A x, shape (m)
  double rss = 0.0;              ///< sum of the squared residuals
  int rank = 0;
  double condition = 0.0;  ///< largest over smallest singular value, unit-norm columns
  std::vector<double> singular_values;  ///< of A with unit-norm columns, descending
  std::vector<double> norms;            ///< of the columns of A, shape (n)
  /// Directions that leave A x unchanged, in the
  /// unit-norm columns: shape (n - rank, n).
  std::vector<double> null_space;
  std::vector<double> inverse_gram;  ///< (A^T A)^-1, shape (n, n); empty if rank < n
};

/// @brief Least squares by rank-revealing QR of A with its columns scaled to unit norm.
///
/// @eq  I-1  A S = Q R P,  x = S P^T R^-1 Q^T b,  S = diag(1/|a_j|)
/// @eq  I-6  rank = number of singular values of A S above rank_tolerance times the
///           largest;  condition = sigma_1/sigma_n
///
/// @param[in] A  row-major, shape (m, n)
/// @param[in] n  columns, at least 1
/// @param[in] b  shape (m)
/// @param[in] rank_tolerance  relative to the largest singular value
/// @throws std::invalid_argument when the shapes do not agree
LeastSquares least_squares(std::span<const double> A, int n, std::span<const double> b,
                           double rank_tolerance);

/// @brief The same of columns: by the normal equations of the scaled A with one step of
/// refinement, where these keep the accuracy; else by QR.
LeastSquares least_squares(const Columns& A, std::span<const double> b,
                           double rank_tolerance);

/// @brief Take the columns of A out of the columns of B: fast, for A of fair condition.
///
/// Solves the normal equations of the scaled A; good to condition^2 times rounding.
/// @param[in]     A  row-major, shape (m, n)
/// @param[in]     n  columns of A
/// @param[in,out] B  row-major, shape (m, k): becomes B - A X
/// @param[in]     k  columns of B
/// @return X, row-major, shape (n, k)
std::vector<double> project_out(std::span<const double> A, int n, std::span<double> B,
                                int k);

/// @brief The same of columns whose products are known.
/// @param[in]     gram  A^T A (gram_of)
/// @param[in,out] B     one or more columns: becomes B - A X
/// @return X by columns, shape (columns of B, columns of A)
std::vector<double> project_out(const Columns& A, std::span<const double> gram,
                                std::span<double> B);

/// @brief min over x of x^T G x - 2 g^T x, for a small positive semidefinite G.
/// @param[in]  G  row-major, shape (n, n)
/// @param[in]  g  shape (n)
/// @param[out] x  shape (n)
/// @return g^T x, by which the fit lowers the sum of squares
double solve_normal(std::span<const double> G, std::span<const double> g,
                    std::span<double> x);

/// @brief Orthonormal columns that span those of A, as many as are independent.
/// @param A          row-major, shape (m, n)
/// @param tolerance  of what a column adds to the others, relative to the longest
/// @return           row-major, shape (m, rank)
std::vector<double> orthonormal(std::span<const double> A, int n, double tolerance);

}  // namespace trochoid::numerics
