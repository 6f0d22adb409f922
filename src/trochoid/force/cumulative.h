#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/force/law.h>
#include <trochoid/force/setup.h>
#include <trochoid/geometry/runout.h>
#include <trochoid/numerics/piecewise_integral.h>

#include <array>
#include <span>
#include <vector>

namespace trochoid::force {

/// @brief The integrals along an edge of a cylinder
/// of which every entry of [C] is made.
///
/// w_t sin, w_t cos, w_r sin, w_r cos, w_a with the weights of column_weights, then
/// e sin, e cos, e with e = dS/dz where in cut.
using EdgeMoments = std::array<double, 8>;
/// The moments of which the force in x, y, z is made: rows of [C]{K}.
using MomentWeights = std::array<EdgeMoments, 3>;

/// @brief Forces on a constant-lead cylinder whose
/// teeth keep their radius along the edge.
///
/// theta and height are one variable there: what an edge does at height z, its tip did
/// lag(z) earlier. So the sum over the edge is a difference of an antiderivative over
/// theta, which is found once for each tooth.
///
/// @eq F-5 F_j(phi) = lead [G_j(theta) - G_j(theta - lag(a_p))], theta = phi - psi_j,
///         lead = a_p / lag(a_p); a_p G_j'(theta) at zero helix
/// @src derived from [riviere2009] eq. 19
class CumulativeForce {
 public:
  /// @param setup      one that keeps_radius
  /// @param tolerance  relative to the largest value of each moment
  CumulativeForce(const Setup& setup, const Law& law, double tolerance);

  /// @brief Moments of all teeth at one angle of the tip of tooth 1.
  [[nodiscard]] EdgeMoments moments(double phi) const noexcept;

  /// @brief Force on the tool for given coefficients, shape (n, 3).
  void forces(const MomentWeights& weights, std::span<const double> phi,
              std::span<std::array<double, 3>> out) const;

 private:
  [[nodiscard]] chip::Slice slice() const noexcept {
    return {.r = r_, .teeth = teeth_, .near = near_};
  }
  void find_near_marks();
  [[nodiscard]] EdgeMoments integrand(std::size_t tooth, double theta) const noexcept;
  void tabulate(std::size_t tooth, double tolerance);

  chip::Passage passage_;
  Form form_;
  double r_ = 0.0;            ///< [m]
  double edge_factor_ = 1.0;  ///< dS/dz
  double a_p_ = 0.0;          ///< [m]
  double lag_ = 0.0;          ///< of the edge over a_p [rad]; 0: zero helix
  std::vector<double> psi_;
  std::vector<geometry::EdgePosition> teeth_;
  std::vector<std::pmr::vector<int>> near_;  ///< marks; empty: any may be near
  std::vector<numerics::PiecewiseIntegral<8>> tables_;  ///< one, if the teeth are equal
};

}  // namespace trochoid::force
