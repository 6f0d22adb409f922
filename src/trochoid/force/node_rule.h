#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace trochoid::force {

/// Room of a row: the most nodes of a panel, filled up to whole vectors.
inline constexpr std::size_t node_room = 16;
using NodeRow = std::array<double, node_room>;

/// @brief Interpolation on the nodes t_i = -cos(pi i / (n - 1)) of [-1, 1], ends included.
///
/// @eq F-15 integral from a to b of p = sum of p(t_i) (W_i(b) - W_i(a)),
///          W_i the antiderivative of the i-th Lagrange polynomial
/// @src derived
struct NodeRule {
  std::size_t nodes = 0;
  std::size_t width = 0;  ///< nodes, filled up to a multiple of 8
  NodeRow t{};
  NodeRow whole{};                         ///< W_i(1) - W_i(-1)
  std::array<NodeRow, node_room> l{};      ///< [k][i]: factor of t^k in Lagrange's i-th
  std::array<NodeRow, node_room> power{};  ///< [i][k]: the same, the other way round
  std::array<NodeRow, node_room + 1> area{};  ///< [k][i]: factor of t^k in W_i
  /// From node values to the last two Chebyshev coefficients: what a panel leaves out.
  std::array<NodeRow, 2> tail{};
};

/// @brief The rule for a tolerance: 8 nodes, or 12.
const NodeRule& node_rule(double tolerance);

/// Factors of 1, t, t^2, ... of the polynomial through the values at the nodes.
NodeRow powers_of(const NodeRule& rule, const double* values) noexcept;

/// Value of a polynomial given by its powers.
double value_at(const NodeRule& rule, const NodeRow& powers, double t) noexcept;

/// Lagrange's polynomials of all nodes at one place.
NodeRow basis_at(const NodeRule& rule, double t) noexcept;

/// W_i of all nodes at one place.
NodeRow area_at(const NodeRule& rule, double t) noexcept;

/// Roots of a polynomial in (-1, 1), ascending in pairs of nodes.
struct NodeRoots {
  std::array<double, 2 * node_room> t{};
  std::size_t count = 0;
};

/// @brief Roots of the polynomial through the values at the nodes.
/// @param slack  how far it may bend between two neighbouring nodes: only where it comes
///               nearer to zero a pair of roots between two nodes is looked for
NodeRoots roots_of(const NodeRule& rule, const double* values, double slack) noexcept;

}  // namespace trochoid::force
