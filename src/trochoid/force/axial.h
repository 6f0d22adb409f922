#pragma once

#include <trochoid/force/edge_curve.h>
#include <trochoid/force/law.h>

#include <array>
#include <memory>
#include <span>

namespace trochoid::force {

/// @brief Forces of any cutter, by quadrature along its edges.
///
/// At each spindle angle an edge is cut where something switches on or off or another
/// mark takes over; between, the integrand is smooth.
///
/// @eq F-3 [B] = [-cos(theta), -sin(theta) sin(kappa), -sin(theta) cos(kappa);
///                 sin(theta), -cos(theta) sin(kappa), -cos(theta) cos(kappa);
///                 0, cos(kappa), -sin(kappa)], from (t, r, a) to (x, y, z)
/// @eq F-4 [C] = sum over teeth of the integral of [B][A] along the edge
/// @src [riviere2009] eq. 18 with the third row repaired, eq. 19
class AxialForce {
 public:
  /// @param tolerance  relative to the largest possible value of each entry
  AxialForce(const Setup& setup, const Law& law, double tolerance);

  /// @param[out] C  row-major, shape (3, columns)
  void matrix(double phi, std::span<double> C) const;

  /// @brief Force [N], torque about the spindle axis and bending moment [N m].
  ///
  /// @eq F-6 T = sum of R dF_t; power = T Omega
  /// @eq F-7 M = sum of r x dF about the point at the gauge length on the axis
  /// @return (F_x, F_y, F_z, T, M_x, M_y); T is positive where the spindle must drive
  [[nodiscard]] std::array<double, 6> loads(double phi, double gauge_length) const;

 private:
  template <std::size_t M, class Element>
  void integrate(double phi, const std::array<double, M>& allowed,
                 const Element& element, std::array<double, M>& sum) const;

  Edges edges_;
  Terms terms_;
  double allowed_cutting_ = 0.0;
  double allowed_edge_ = 0.0;
  double smallest_ = 0.0;  ///< shortest panel [m]
};

}  // namespace trochoid::force
