#pragma once

#include <trochoid/force/node_kernel.h>

#include <vector>

namespace trochoid::force {

/// What is used again from one panel to the next.
struct NodeScratch {
  std::vector<std::size_t> marks;  ///< that may be the closest somewhere on the panel
  std::vector<double> breaks;      ///< places in [-1, 1], ascending
  NodeRow difference{};
};

/// @brief Which parts of a panel are in cut, over which mark, and what its nodes count.
/// @return whether anything is in cut
bool weigh(const NodePanels& all, const NodePanel& panel, const NodeChips& chips,
           NodeScratch& scratch, NodeWeights& weights);

}  // namespace trochoid::force
