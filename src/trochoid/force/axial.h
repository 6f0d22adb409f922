#pragma once

#include <trochoid/force/edge_curve.h>
#include <trochoid/force/element.h>
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
/// @eq F-4 [C] = sum over teeth of the integral of [B][A] along the edge
/// @src [riviere2009] eq. 19
class AxialForce {
 public:
  /// @param tolerance  relative to the largest possible value of each entry
  AxialForce(const Setup& setup, const Law& law, double tolerance);

  /// @param[out] C  row-major, shape (3, columns)
  void matrix(double phi, std::span<double> C) const;

  /// @brief Force, torque, and bending moments about the point at the gauge length on
  /// the axis (F-6, F-7).
  [[nodiscard]] SixLoads loads(double phi, double gauge_length) const;

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
