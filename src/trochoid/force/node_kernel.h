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
  alignas(64) NodeRow radius{};    ///< that the chip model takes [m]
  alignas(64) NodeRow least{};     ///< chip over the closest mark [m]
  std::vector<double> over;        ///< chip over each mark [m], shape (marks, width)
  const NodeEdge* edge = nullptr;  ///< of the tooth
};

/// @brief Moments of the chip and of the edge: integrals of sin, cos, sin sin(kappa),
/// cos sin(kappa), cos(kappa), sin cos(kappa), cos cos(kappa), sin(kappa).
struct NodeMoments {
  static constexpr std::size_t count = 16;  ///< 8 of the chip, 8 of the edge
  alignas(64) std::array<std::array<double, 8>, count> lanes{};  ///< summed at the end
};

/// @brief Weights of the nodes of a panel, for one tooth at one spindle angle.
struct NodeWeights {
  NodeRow chip{};  ///< h at the nodes times their weights [m]; of a power law unused
  NodeRow edge{};  ///< weights of the nodes over what is in cut
  /// Of a power law: those of F-2 in t, r and a times the weights of the nodes [m].
  std::array<NodeRow, 3> power{};
};

/// @brief Chips over all marks at the nodes of a panel (C-2 to C-6).
/// @param      sine, cosine  of the angle of the tip of tooth 1
/// @param[out] out           with room for all marks there are
void node_chips(const NodePanels& all, const NodePanel& panel, const NodeTooth& tooth,
                std::array<double, 2> sine_cosine, NodeChips& out) noexcept;

/// Most places on a piece at which a power law is taken.
inline constexpr std::size_t power_room = 24;
/// Rows of them; what is not used is 0.
using PowerRow = std::array<double, power_room>;

/// @brief Products of two polynomials through values at the nodes, at some places.
void chips_across(const NodeRule& rule, const double* h, const double* sin_kappa,
                  const PowerRow& t, PowerRow& out) noexcept;

/// A piece under a power law.
struct PowerPiece {
  const std::array<double, 3>& m;
  const PowerRow& t;
  const PowerRow& across;  ///< h sin(kappa) there; 0 or less: no chip [m]
  const PowerRow& weight;  ///< of the places, over the length; 0 beyond them
  std::size_t places = 0;
  double length = 0.0;
};

/// @brief Add to the weights of the nodes what F-2 makes of a piece:
/// sum over places of weight h_0 (across/h_0)^(1 - m) L_i(t).
void add_powers(const NodeRule& rule, const PowerPiece& piece,
                std::array<NodeRow, 3>& out) noexcept;

/// @brief Add what an edge gives along a panel.
/// @param power  whether the law is a power of the chip
void add_moments(const NodeEdge& edge, bool power, const NodeChips& chips,
                 const NodeWeights& weights, NodeMoments& sum) noexcept;

}  // namespace trochoid::force
