#pragma once

#include <trochoid/force/law.h>
#include <trochoid/force/node_kernel.h>
#include <trochoid/force/node_panels.h>
#include <trochoid/numerics/lagrange.h>
#include <trochoid/surface/moment_kernel.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace trochoid::surface {

/// What of a bent cutter changes chips, at one spindle angle.
struct NodeBend {
  std::span<const double> shift;  ///< of the axis in y at the basis points [m]
  /// The same when each tooth before left its mark, shape (teeth, teeth, points); empty:
  /// chips over marks stay as they are.
  std::span<const double> before;
};

/// @brief Moments along the edges of a cylinder under a law linear in the chip, from chips
/// at fixed nodes (F-15).
///
/// Chips over all marks are polynomials through their values at the nodes. Between the
/// places where they cross one another, zero or the edge of the stock, E-2 and E-3 are
/// summed at Gauss' points.
class EdgeNodes {
 public:
  /// Nothing where the law is a power of the chip, marks are not smooth, or the basis has
  /// more points than there is room for.
  static std::shared_ptr<const EdgeNodes> make(const force::Edges& edges,
                                               const force::Form& form,
                                               const numerics::LagrangeBasis& basis);

  /// @brief By unit coefficient, as EdgeMoments::at.
  /// @param bend  or none
  void at(double phi, const NodeBend* bend, MomentSums& sums) const;

  [[nodiscard]] std::size_t points() const noexcept { return points_; }

 private:
  class Look;

  /// What does not depend on the spindle angle, at the nodes of a panel.
  struct Panel {
    double middle = 0.0;  ///< over the axial depth from -1 to 1
    double half = 0.0;
    double height = 0.0;      ///< half of its height [m]
    double edge = 0.0;        ///< edge force per height
    force::NodeRow cosine{};  ///< of the lag
    force::NodeRow sine{};
    std::vector<double> shares;  ///< of the basis points, shape (nodes, point_room)
  };

  force::NodePanels all_;
  std::vector<Panel> panels_;
  MomentRule rule_;
  std::size_t points_ = 0;
};

}  // namespace trochoid::surface
