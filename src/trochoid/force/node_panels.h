#pragma once

#include "node_panel.h"

#include <optional>
#include <vector>

namespace trochoid::force {

/// @brief Edges cut into panels.
struct NodePanels {
  chip::Passage passage;
  std::vector<double> psi;  ///< [rad]
  const NodeRule* rule = nullptr;
  double begin = 0.0;          ///< arc length before which the panels do not hold [m]
  bool at_stock_edge = false;  ///< whether the stock ends somewhere in y
  std::vector<NodePanel> panels;
};

/// @brief Panels for a setup, as short as the tolerance asks.
/// @param tolerance  of chips, relative to the feed
/// @return none where marks are not smooth or the edge ends at the axis
std::optional<NodePanels> node_panels(const Edges& edges, double tolerance);

}  // namespace trochoid::force
