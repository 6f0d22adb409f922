#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::numerics {

/// @brief A root L of a covariance of any rank, by Cholesky of the correlations with
/// large pivots: the first one that is nearly as large as any.
///
/// @eq U-2 C = L L^T
/// @src standard
/// @param C  symmetric, row-major, shape (n, n)
/// @return row-major, shape (n, n), its columns past the rank zero; none where C is no
///         covariance: a negative variance, or a combination that has one
std::optional<std::vector<double>> semidefinite_root(std::span<const double> C,
                                                     std::size_t n);

}  // namespace trochoid::numerics
