#pragma once

#include <trochoid/force/edge_curve.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

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

/// @brief One tooth at the nodes of a panel: all that does not depend on the spindle
/// angle, in rows of NodeRule::width.
///
/// Rows: cosine and sine of the angle of the edge behind the tip of tooth 1; the same
/// without epsilon, for the chip of the simplified models; the radius R_j; and for each
/// mark R_j - R_k, its angle or slope, R_k and feed / R_k.
struct NodeTooth {
  enum Row { cosine, sine, chip_cosine, chip_sine, radius, first_mark };
  enum MarkRow { apart, back, mark_radius, bend, rows_of_mark };
  double middle = 0.0;   ///< angle of the middle behind the tip of tooth 1 [rad]
  std::size_t edge = 0;  ///< which of NodePanel::edges it has
  std::size_t marks = 0;
  std::vector<double> rows;
};

/// @brief An edge at the nodes of a panel, without runout: that of all teeth, or of one.
struct NodeEdge {
  NodeRow r{};       ///< radius [m]
  NodeRow width{};   ///< dz/dt, t from -1 to 1: of the chip [m]
  NodeRow length{};  ///< ds/dt along the meridian [m]
  NodeRow edge{};    ///< dS/dt: of the edge force [m]
  NodeRow sin_kappa{};
  NodeRow cos_kappa{};
};

/// A part of the edges on which chips are polynomials of the place along it.
struct NodePanel {
  double from = 0.0;  ///< arc length along the meridian [m], or place in a Zone
  double to = 0.0;
  double half_turn = 0.0;    ///< half of what the edge turns by, and epsilon [rad]
  double centre = 0.0;       ///< of the angles theta where there may be a chip [rad]
  double reach = 0.0;        ///< half of what they span [rad]
  double slack = 0.0;        ///< how far a chip may bend between two nodes [m]
  double stock_slack = 0.0;  ///< the same for y of the edge [m]
  int steps = 1;             ///< of Newton's; more than 2: with the full slope
  double half = 0.0;         ///< ds/dt, of edges that differ the mean [m]
  NodeRow z{};               ///< height above the tip [m]
  std::vector<NodeEdge> edges;
  std::vector<NodeTooth> teeth;

  [[nodiscard]] const NodeEdge& edge_of(const NodeTooth& tooth) const noexcept {
    return edges[tooth.edge];
  }
};

/// @brief Edges cut into panels.
struct NodePanels {
  chip::Passage passage;
  std::vector<double> psi;  ///< [rad]
  const NodeRule* rule = nullptr;
  Form form;           ///< of the law whose forces are summed
  double begin = 0.0;  ///< where panels begin: arc length, of AnyEdges height [m]
  bool at_stock_edge = false;  ///< whether the stock ends somewhere in y
  std::vector<NodePanel> panels;
};

/// @brief A panel with its nodes and teeth, and how far chips may bend between two nodes.
/// @param from, to  arc length along the meridian [m], within one part of the profile
NodePanel node_panel(const Edges& edges, const NodeRule& rule, double from, double to);

struct AnyEdges;
struct Zone;

/// @brief The same of edges that differ, within a zone.
/// @param from, to  places in the zone, from 0 to 1
NodePanel node_panel(const AnyEdges& any, const NodeRule& rule, const Zone& zone,
                     double from, double to);

/// @brief How far offsets and eccentricity move a tooth [m].
double reach_of(const geometry::Runout& runout) noexcept;

}  // namespace trochoid::force
