#pragma once

#include <trochoid/force/any_edges.h>
#include <trochoid/force/axial.h>
#include <trochoid/force/node_pieces.h>
#include <trochoid/force/tip_force.h>

#include <optional>
#include <span>
#include <variant>

namespace trochoid::force {

/// @brief Forces of any cutter from chips at fixed nodes along the edges.
///
/// What does not depend on the spindle angle is worked out once a node. At an angle the
/// chips over all marks are polynomials through their values at the nodes; where they
/// cross one another, zero or the edge of the stock, pieces begin and end. Under a power
/// law Gauss points lie on each piece, crowded where the chip begins and ends.
///
/// @eq F-15
/// @src derived
class NodeForce {
 public:
  /// @param tolerance  relative to the largest possible value of each entry
  static std::optional<NodeForce> make(const Setup& setup, const Law& law,
                                       double tolerance);

  /// @brief The same for edges that differ.
  static std::optional<NodeForce> make(const AnyEdges& any, const Law& law,
                                       double tolerance);

  /// Into how many panels an edge is cut.
  [[nodiscard]] std::size_t panels() const noexcept { return panels_.panels.size(); }

  /// @param[out] C  row-major, the first 3 x columns of each, shape (angles)
  void matrices(std::span<const double> phi, std::span<std::array<double, 18>> C) const;

  /// @param[out] F  force on the tool [N], shape (angles)
  void forces(std::span<const double> phi, std::span<std::array<double, 3>> F) const;

  /// @param      gauge_length  height of the section that bends above the tip [m]
  /// @param[out] all           force, torque and bending moments (F-6, F-7), shape (angles)
  void loads(std::span<const double> phi, double gauge_length,
             std::span<SixLoads> all) const;

 private:
  NodeForce(NodePanels panels, const Law& law);

  void add_tip(std::span<const double> phi, double gauge_length,
               std::span<SixLoads> all) const;

  NodePanels panels_;
  Terms terms_;
  /// Of the edge near the axis, where it gets there.
  std::variant<std::monostate, TipForce, AxialForce, AnyForce> tip_;
};

}  // namespace trochoid::force
