#pragma once

#include <trochoid/force/node_panel.h>

#include <array>
#include <cstddef>
#include <span>

namespace trochoid::surface {

/// Room of a row of basis points: the most there may be.
inline constexpr std::size_t point_room = 16;
using PointRow = std::array<double, point_room>;

/// @brief Barycentric interpolation on the nodes of a panel and on the basis points; what
/// is left of a row lies far off and weighs nothing.
struct MomentRule {
  alignas(64) force::NodeRow node{};
  alignas(64) force::NodeRow node_weight{};
  alignas(64) PointRow point{};  ///< basis points over the axial depth, from -1 to 1
  alignas(64) PointRow point_weight{};
};

/// @brief A stretch of a panel along which one mark bounds the chip.
struct EdgeStretch {
  const double* over = nullptr;  ///< chip over that mark at the nodes [m]
  double from = 0.0;             ///< from -1 to 1 on the panel
  double to = 0.0;
  bool by_stock = false;  ///< the edge of the stock cuts the chip short somewhere
};

/// @brief One tooth at the nodes of a panel, and where the panel is.
struct ToothRows {
  const double* sine = nullptr;    ///< of theta, effective
  const double* cosine = nullptr;  ///< of it
  const double* radius = nullptr;  ///< [m]
  const double* shift = nullptr;   ///< of the axis in y [m]
  std::array<double, 2> stock{};   ///< y from and to [m]
  double middle = 0.0;             ///< of the panel, over the axial depth from -1 to 1
  double half = 0.0;               ///< of its length, the same way
  double height = 0.0;             ///< half of its height [m]
  double edge = 0.0;               ///< edge force per height, as column_weights has it
};

/// @brief Moments of E-3 across the wall by unit coefficient, and forces along it.
struct MomentSums {
  alignas(64) std::array<PointRow, 4> across{};  ///< cutting t, r, edge t, r
  std::array<double, 4> along{};
};

/// @brief Add what a stretch gives, by Gauss points between its ends.
void add_stretch(const MomentRule& rule, const ToothRows& tooth,
                 const EdgeStretch& stretch, MomentSums& sums) noexcept;

}  // namespace trochoid::surface
