#pragma once

#include <trochoid/force/edge_curve.h>

#include "node_rule.h"

#include <vector>

namespace trochoid::force {

/// @brief One tooth at the nodes of a panel: all that does not depend on the spindle
/// angle, in rows of NodeRule::width.
///
/// Rows: cosine and sine of the angle of the edge behind the tip of tooth 1; the same
/// without epsilon, for the chip of the simplified models; the radius R_j; and for each
/// mark R_j - R_k, its angle or slope, R_k and feed / R_k.
struct NodeTooth {
  enum Row { cosine, sine, chip_cosine, chip_sine, radius, first_mark };
  enum MarkRow { apart, back, mark_radius, bend, rows_of_mark };
  double middle = 0.0;  ///< angle of the middle behind the tip of tooth 1 [rad]
  std::vector<double> rows;
};

/// A part of the edges on which chips are polynomials of the arc length.
struct NodePanel {
  double from = 0.0;  ///< arc length along the meridian [m]
  double to = 0.0;
  double half_turn = 0.0;    ///< half of what the edge turns by, and epsilon [rad]
  double centre = 0.0;       ///< of the angles theta where there may be a chip [rad]
  double reach = 0.0;        ///< half of what they span [rad]
  double slack = 0.0;        ///< how far a chip may bend between two nodes [m]
  double stock_slack = 0.0;  ///< the same for y of the edge [m]
  int steps = 1;             ///< of Newton's; more than 2: with the full slope
  NodeRow r{};               ///< nominal radius [m]
  NodeRow z{};               ///< height above the tip [m]
  NodeRow width{};           ///< dz/dt, t from -1 to 1: of the chip [m]
  NodeRow edge{};            ///< dS/dt: of the edge force [m]
  NodeRow sin_kappa{};
  NodeRow cos_kappa{};
  std::vector<NodeTooth> teeth;
};

/// @brief A panel with its nodes and teeth, and how far chips may bend between two nodes.
/// @param from, to  arc length along the meridian [m], within one part of the profile
NodePanel node_panel(const Edges& edges, const NodeRule& rule, double from, double to);

/// @brief How far offsets and eccentricity move a tooth [m].
double reach_of(const geometry::Runout& runout) noexcept;

}  // namespace trochoid::force
