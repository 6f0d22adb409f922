#pragma once

#include <trochoid/force/node_panel.h>

#include <array>
#include <vector>

namespace trochoid::force {

/// @brief What the nodes of a panel see of one tooth at one spindle angle.
struct NodeChips {
  alignas(64) NodeRow sine{};  ///< of theta, effective
  alignas(64) NodeRow cosine{};
  alignas(64) NodeRow chip_sine{};  ///< of the theta that the chip model takes
  alignas(64) NodeRow chip_cosine{};
  alignas(64) NodeRow radius{};  ///< that the chip model takes [m]
  alignas(64) NodeRow least{};   ///< chip over the closest mark [m]
  std::vector<double> over;      ///< chip over each mark [m], shape (marks, width)
};

/// @brief Moments of the chip and of the edge: integrals of sin, cos, sin sin(kappa),
/// cos sin(kappa), cos(kappa), sin cos(kappa), cos cos(kappa), sin(kappa).
struct NodeMoments {
  static constexpr std::size_t count = 16;  ///< 8 of the chip, 8 of the edge
  alignas(64) std::array<std::array<double, 8>, count> lanes{};  ///< summed at the end
};

/// @brief Weights of the nodes of a panel, for one tooth at one spindle angle.
struct NodeWeights {
  NodeRow chip{};  ///< h at the nodes times their weights [m]
  NodeRow edge{};  ///< weights of the nodes over what is in cut
};

/// @brief Chips over all marks at the nodes of a panel (C-2 to C-6).
/// @param sine, cosine  of the angle of the tip of tooth 1
void node_chips(const NodePanels& all, const NodePanel& panel, const NodeTooth& tooth,
                std::array<double, 2> sine_cosine, NodeChips& out) noexcept;

/// @brief Add what a panel gives.
void add_moments(const NodePanel& panel, const NodeChips& chips,
                 const NodeWeights& weights, NodeMoments& sum) noexcept;

}  // namespace trochoid::force
