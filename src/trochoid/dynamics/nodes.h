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

/// @brief Size of the last two Chebyshev coefficients of values at the nodes.
double chebyshev_tail(std::span<const double> values) noexcept;

}  // namespace trochoid::dynamics
