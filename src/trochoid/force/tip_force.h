#pragma once

#include <trochoid/force/axial.h>
#include <trochoid/force/node_panel.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::force {

/// @brief Forces of edges near the axis under the exact chip, from chips at fixed nodes.
///
/// Nearer to the axis than about a feed marks begin and end, and teeth pass one another.
/// Panels grow with the distance from the axis and end where teeth meet, which no spindle
/// angle changes. Where all nodes of a panel have their chip from one mark, the nodes are
/// the quadrature. Otherwise the places where the mark changes are narrowed down, eight
/// places at a time, and the parts between them have eight nodes of their own.
///
/// @eq F-4
/// @src derived
class TipForce {
 public:
  /// @param tolerance  relative to the largest possible value of each entry
  /// @return none where something else than marks bounds the chip there, and for the
  ///         simplified chips
  static std::optional<TipForce> make(const Setup& setup, const Law& law,
                                      double tolerance);

  /// @param[out] C  row-major, the first 3 x columns of each, shape (angles)
  void matrices(std::span<const double> phi, std::span<AxialForce::Matrix> C) const;

  /// @param      gauge_length  height of the section that bends above the tip [m]
  /// @param[out] all           force, torque and bending moments (F-6, F-7), shape (angles)
  void loads(std::span<const double> phi, double gauge_length,
             std::span<SixLoads> all) const;

 private:
  class Walk;

  /// Rows at the nodes as polynomials.
  struct Powers {
    std::vector<NodeRow> of_panel;  ///< sin and cos of kappa, z, edge
    std::vector<std::vector<NodeRow>> of_teeth;
  };

  /// As many panels as where the teeth stand needs.
  void add_panel(const Edges& edges, double from, double to);

  NodePanels panels_;
  std::vector<Powers> powers_;  ///< of each panel
  Terms terms_;
  double resolution_ = 0.0;  ///< of the places where marks change [m]
  double allowed_ = 0.0;  ///< what a polynomial may leave of a chip along a part [m^2]
};

}  // namespace trochoid::force
