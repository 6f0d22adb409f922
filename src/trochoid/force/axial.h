#pragma once

#include <trochoid/force/edge_curve.h>
#include <trochoid/force/forces.h>
#include <trochoid/force/law.h>

#include <array>
#include <memory>
#include <span>

namespace trochoid::force {

/// @brief An element of edge: which way it faces and where it is.
struct Element {
  double sine = 0.0;  ///< of theta, effective
  double cosine = 0.0;
  double sin_kappa = 0.0;
  double cos_kappa = 0.0;
  double R = 0.0;  ///< distance from the axis of rotation [m]
  double z = 0.0;  ///< height above the section that bends [m]
};

/// @brief Add what a force on an element does.
/// @eq F-3 [B] = [-cos(theta), -sin(theta) sin(kappa), -sin(theta) cos(kappa);
///                 sin(theta), -cos(theta) sin(kappa), -cos(theta) cos(kappa);
///                 0, cos(kappa), -sin(kappa)], from (t, r, a) to (x, y, z)
/// @eq F-6 T = sum of R dF_t; power = T Omega; positive where the spindle must drive
/// @eq F-7 M = sum of r x dF
/// @src [riviere2009] eq. 18 with the third row repaired; F-6, F-7 derived
/// @param tra  force in t, r and a [N]
inline void add_loads(const Element& at, const std::array<double, 3>& tra,
                      SixLoads& sum) noexcept {
  const auto [t, r, a] = tra;
  const double inward = r * at.sin_kappa + a * at.cos_kappa;
  const auto [F_x, F_y] = in_plane(t, inward, at.sine, at.cosine);  // F-3
  const double F_z = r * at.cos_kappa - a * at.sin_kappa;
  sum[0] += F_x;
  sum[1] += F_y;
  sum[2] += F_z;
  sum[3] += at.R * t;                             // F-6
  sum[4] += at.R * at.cosine * F_z - at.z * F_y;  // F-7
  sum[5] += at.z * F_x - at.R * at.sine * F_z;
}

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
