#pragma once

#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/bodies.h>
#include <trochoid/surface/edge_moments.h>
#include <trochoid/surface/setting.h>

#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief Deflections by forces along the feed and along the axis, to the first order:
/// they leave the chip as it is.
///
/// @eq E-43 u_y += -sum_q [dG_c/dz m_q^cz + dG_w/dz m_q^wz]                  (z)
///          u_y += -sum_q dG_w/dx m_q^wx,  u_x = sum_q G_c m_q^x            (x)
/// @src derived from the work of the forces on tilted sections: B-10, B-12
class AlsoBent {
 public:
  /// @param compliance  must outlive this
  /// @param tolerance   relative, of each kind of moment
  AlsoBent(const Setting& setting, const EdgeMoments& edges,
           const Compliance& compliance, double tolerance);

  /// @brief Deflection across the wall at one height: E-4 with what E-43 adds.
  /// @param row  G_q of E-5 [m/N], shape (basis points)
  /// @return delta [m], one function
  [[nodiscard]] numerics::PeriodicPieces deflection(double height,
                                                    std::span<const double> row) const;

  /// @brief u_x at one height [m], one function; none where x bends nothing.
  [[nodiscard]] numerics::PeriodicPieces along(double height) const;

  /// Moments, F_x and F_y as of with_coefficients.
  [[nodiscard]] numerics::PeriodicPieces moments() const;

 private:
  const Compliance& compliance_;
  double sigma_;
  bool x_;
  bool z_;
  numerics::PeriodicPieces all_;  ///< those of E-42, then moments, F_x and F_y
};

}  // namespace trochoid::surface
