#pragma once

#include <trochoid/force/edge_curve.h>

#include "node_rule.h"

#include <optional>
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
  bool at_stock_edge = false;
  NodeRow r{};      ///< nominal radius [m]
  NodeRow width{};  ///< half sin(kappa) dS: of a chip [m]
  NodeRow edge{};   ///< half dS: of the edge force [m]
  NodeRow sin_kappa{};
  NodeRow cos_kappa{};
  std::vector<NodeTooth> teeth;
};

/// @brief Edges cut into panels.
struct NodePanels {
  chip::Passage passage;
  std::vector<double> psi;  ///< [rad]
  const NodeRule* rule = nullptr;
  double begin =
      0.0;  ///< arc length where the panels begin; before, they do not hold [m]
  std::vector<NodePanel> panels;
};

/// @brief Panels for a setup, as short as the tolerance asks.
/// @param tolerance  of chips, relative to the feed
/// @return none where marks are not smooth or the edge ends at the axis
std::optional<NodePanels> node_panels(const Edges& edges, double tolerance);

}  // namespace trochoid::force
