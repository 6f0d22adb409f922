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
/// mark takes over; between, the integrand is smooth. Of angles close together not all
/// are computed: where forces change smoothly a polynomial leads from one to the next.
///
/// @eq F-4 [C] = sum over teeth of the integral of [B][A] along the edge
/// @src [riviere2009] eq. 19
class AxialForce {
 public:
  /// @param tolerance  relative to the largest possible value of each entry
  AxialForce(const Setup& setup, const Law& law, double tolerance);

  using Matrix = std::array<double, 18>;  ///< row-major; first the 3 x columns

  /// @param phi     best ascending [rad]
  /// @param[out] C  shape (angles)
  void matrices(std::span<const double> phi, std::span<Matrix> C) const;

  /// @brief Force, torque, and bending moments about the point at the gauge length on
  /// the axis (F-6, F-7).
  /// @param phi       best ascending [rad]
  /// @param[out] all  shape (angles)
  void loads(std::span<const double> phi, double gauge_length,
             std::span<SixLoads> all) const;
  [[nodiscard]] SixLoads loads(double phi, double gauge_length) const;

 private:
  [[nodiscard]] Matrix matrix(double phi, const Matrix& allowed) const;
  [[nodiscard]] SixLoads loads(double phi, double gauge_length,
                               const SixLoads& allowed) const;

  template <std::size_t M, class Element>
  void integrate(double phi, const std::array<double, M>& allowed,
                 const Element& element, std::array<double, M>& sum) const;

  Edges edges_;
  Terms terms_;
  double allowed_cutting_ = 0.0;
  double allowed_edge_ = 0.0;
  double smallest_ = 0.0;    ///< shortest panel [m]
  double resolution_ = 0.0;  ///< of where pieces begin and end [m]
};

}  // namespace trochoid::force
