#pragma once

#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/pass.h>

#include <span>
#include <vector>

namespace trochoid::surface {

/// What stays of a wall at one place, and who made it.
struct SurfacePoint {
  double error = 0.0;  ///< positive: material left [m]
  int tooth = 0;       ///< 0-based
  double phi = 0.0;    ///< spindle angle when it was made [rad]
};

/// @brief How the wall at one height comes into being.
struct HeightCut {
  Side side;
  double R = 0.0;                       ///< nominal radius of the cutter [m]
  double feed = 0.0;                    ///< of the tool per turn [m]
  double x_0 = 0.0;                     ///< of the axis at phi = 0 [m]
  std::vector<EdgePlace> teeth;         ///< at this height
  numerics::PeriodicPieces deflection;  ///< delta(phi), the first function [m]
  numerics::PeriodicPieces along = {};  ///< u_x(phi); without functions: none [m]
  double most_along = 0.0;              ///< no |u_x| is larger [m]
};

/// @brief The tooth whose tip entered the stock last, 0-based.
/// @param tips   the teeth at the tip
/// @param entry  theta at which an edge enters the stock [rad]
std::size_t last_entered(std::span<const EdgePlace> tips, double entry,
                         double phi) noexcept;

/// @brief Surface error of [wang2015]: what the cutter leaves at a spindle angle as if
/// it touched there, which is a pulse of force and no surface.
///
/// @eq E-7 e(phi, h) = delta(phi, h) - (R_i(h) - R), i: whose tip entered last
/// @src [wang2015] eq. 10
/// @param tooth  last_entered at phi
SurfacePoint quasi_static_error(const HeightCut& cut, std::size_t tooth,
                                double phi) noexcept;

/// @brief Error of the wall where each tooth touches it squarely.
/// @eq E-8 e_i(h) = delta(phi_i, h) - (R_i(h) - R), phi_i = theta_s + psi_i + lag(h)
/// @src [wang2015] section 4; derived
/// @return shape (teeth)
std::vector<SurfacePoint> imprint_errors(const HeightCut& cut);

/// @brief The wall that all passes of all teeth leave: nothing stands above any path.
/// @eq E-9 e(x, h) = min over passes of R + sigma R_i cos(theta) + delta(phi, h),
///         x = x_0 + f phi / 2 pi + R_i sin(theta)
/// @eq E-44 the same with x = x_0 + f phi / 2 pi + R_i sin(theta) + u_x(phi, h)
/// @src derived; one-sided form of the swept envelope
/// @param x  along the feed [m]
SurfacePoint envelope_error(const HeightCut& cut, double x) noexcept;

}  // namespace trochoid::surface
