#pragma once

#include <trochoid/force/node_panel.h>

#include <optional>
#include <vector>

namespace trochoid::force {

/// @brief Panels for a setup, as short as the tolerance asks.
/// @param tolerance  of chips, relative to the feed
/// @return none where marks are not smooth or the edge ends at the axis
std::optional<NodePanels> node_panels(const Edges& edges, double tolerance);

/// @brief The same of edges that differ.
/// @return none too where edges cross, and for a stock of arcs
std::optional<NodePanels> node_panels(const AnyEdges& any, double tolerance);

}  // namespace trochoid::force
