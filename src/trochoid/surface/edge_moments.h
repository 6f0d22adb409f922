#pragma once

#include <trochoid/force/edge_curve.h>
#include <trochoid/force/law.h>
#include <trochoid/numerics/lagrange.h>

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace trochoid::surface {

class EdgeNodes;
struct NodeBend;

/// Coefficients that matter for the force across and along the wall: cutting t, cutting
/// r, edge t, edge r. The axial ones do nothing there on a cylinder.
inline constexpr std::size_t columns = 4;

/// @brief Those coefficients of a law; 0 of the edge where it has no edge forces.
std::array<double, columns> wall_coefficients(const force::Law& law);

/// How much more than the radial depth stands before the cutter, by the height above its
/// tip [m]; empty: nothing.
using StockLeft = std::function<double(double z)>;

/// Where forces are taken about.
struct LeverArms {
  double sigma = 1.0;      ///< of the side (E-1)
  double mid_plane = 0.0;  ///< of the wall, from the axis towards the wall [m]
};

/// @brief How the force along the edges is spread over the height, at a spindle angle.
///
/// @eq E-2 dF_y = (K_tc sin(theta) - K_rc cos(theta)) h dz + (K_te sin(theta) - K_re
///         cos(theta)) dS,  dF_x = -(K_tc cos(theta) + K_rc sin(theta)) h dz - ...
/// @eq E-3 m_q = integral of L_q(z) dF_y over all edges
/// @src [wang2015] eq. 1 to 3; E-3 derived
class EdgeMoments {
 public:
  /// @eq E-40 radial depth at z: a_e + left(z), which the stock at y + sigma left(z) is
  /// @param left  by the pass before; empty: the stock is as deep as the setup says
  /// @throws std::invalid_argument where something is left beside no single wall
  EdgeMoments(const force::Setup& setup, const force::Law& law,
              const numerics::LagrangeBasis& basis, const StockLeft& left = {});

  /// Values of one coefficient: the moments, then F_x, then F_y.
  [[nodiscard]] std::size_t values() const noexcept { return basis_.size() + 2; }

  /// @param[in]  phi   angle of the tip of tooth 1 [rad]
  /// @param[in]  bend  of the cutter relative to the wall, or none
  /// @param[out] out   per unit coefficient, row-major, shape (columns, values())
  void at(double phi, const force::Bend* bend, std::span<double> out) const;

  /// @brief The same of a cutter that is bent between the basis points.
  ///
  /// From chips at fixed nodes where the law is linear and no stock was left: there no cut
  /// that is short in height is overlooked.
  void bent_at(double phi, const NodeBend& bend, std::span<double> out) const;

  /// @brief Forces along the feed and couples of forces out of line, by the same L_q.
  ///
  /// @eq E-42 m_q = integral of L_q(z) dM_q of dF_x, of sigma l dF_x, of R cos(theta) dF_z
  ///          and of sigma l dF_z, l = mid plane + sigma R cos(theta), dF_z = -dF_a
  /// @param[out] out  with the coefficients of the law, shape (4, basis points)
  void couples_at(double phi, const LeverArms& arms, std::span<double> out) const;

  /// @brief Angles phi at which something switches at the tip or at the top of the cut,
  /// where the force has a kink [rad].
  /// @param bent  where deflection decides the entry, though there be none yet
  [[nodiscard]] std::vector<double> kinks(bool bent) const;

  /// Do all teeth cut alike, so that everything repeats with every tooth?
  [[nodiscard]] bool equal_teeth() const;

  /// Angle from a tooth to the m-th tooth before it [rad], shape (teeth, teeth).
  [[nodiscard]] std::span<const double> back() const noexcept {
    return edges_.passage.back;
  }

  [[nodiscard]] const force::Setup& setup() const noexcept { return edges_.setup; }
  [[nodiscard]] const numerics::LagrangeBasis& basis() const noexcept { return basis_; }

 private:
  void from_nodes(double phi, const NodeBend* bend, std::span<double> out) const;

  /// add(point, state, ds) at the nodes of all edges in the cut.
  template <class Add>
  void integrate(double phi, const force::Bend* bend, const Add& add) const;

  force::Edges edges_;
  force::Form form_;
  force::Terms terms_;
  std::function<double(double z)> shift_;  ///< of the axis in y that stands for `left`
  numerics::LagrangeBasis basis_;
  std::shared_ptr<const EdgeNodes> nodes_;  ///< where they do what `integrate` does
};

}  // namespace trochoid::surface
