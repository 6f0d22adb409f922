#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::dynamics {

/// Gauss nodes between two neighbouring nodes of an element.
inline constexpr std::size_t gauss_count = 8;

/// @brief Chebyshev-Lobatto nodes of an element on [-1, 1], and what belongs to them.
struct ElementNodes {
  std::vector<double> t;        ///< ascending, both ends included, shape (n + 1)
  std::vector<double> weights;  ///< barycentric, shape (n + 1)
  std::vector<double> gauss_t;  ///< shape (n, gauss_count)
  std::vector<double> gauss_w;  ///< their weights, shape (n, gauss_count)
  /// Lagrange polynomials at the Gauss nodes, shape (n, gauss_count, n + 1).
  std::vector<double> at_gauss;
};

inline constexpr int largest_degree = 160;

/// @brief Nodes of degree n, made once.
/// @param n  from 1 to largest_degree
const ElementNodes& element_nodes(int n);

/// @brief Row of the Lagrange polynomials at t.
/// @param[out] row  shape (n + 1)
void lagrange_row(const ElementNodes& nodes, double t, std::span<double> row) noexcept;

/// @brief What makes the slopes at the nodes of the values there.
///
/// @eq  D-32 q'_i = (2 / (b - a)) sum over j of E_ij q_j on an element from a to b,
///           E_ij = (w_j / w_i) / (t_i - t_j), each row of the sum 0; w barycentric
/// @src standard: the derivative of the barycentric interpolant
/// @return E, row-major, shape (n + 1, n + 1)
std::vector<double> slopes_at_nodes(const ElementNodes& nodes);

/// @brief Size of the last two Chebyshev coefficients of values at the nodes.
double chebyshev_tail(std::span<const double> values) noexcept;

}  // namespace trochoid::dynamics
