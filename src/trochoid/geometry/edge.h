#pragma once

#include <trochoid/geometry/cutter.h>
#include <trochoid/geometry/meridian.h>
#include <trochoid/geometry/runout.h>

#include <span>
#include <vector>

namespace trochoid::geometry {

/// @brief Lag of an edge behind its tip, and its slope.
struct Lag {
  double angle = 0.0;    ///< [rad]
  double per_arc = 0.0;  ///< d lag / ds [rad/m]
};

/// @eq G-7 lag = 2 z tan(helix) / lag_diameter              (constant lead)
/// @eq G-8 lag = lag(N_z) + tan(helix)/sin(beta) ln(r/N_r)
///         (constant helix, on the flank)
/// @src [riviere2009] section 3.1 for the cylinder; G-8 derived from
///      d lag = tan(helix) dz / (r cos(beta))
Lag lag_at(const Cutter& cutter, const Meridian& m, double s) noexcept;

/// @brief How the edge of one tooth lags.
struct LagOf {
  double tan_helix = 0.0;
  LagLaw law = LagLaw::constant_lead;
  double diameter = 0.0;  ///< [m]
};

/// @brief The same for one tooth, where the point at s is known.
Lag lag_at(const LagOf& tooth, const Meridian& m, double s,
           const MeridianPoint& p) noexcept;

/// @brief The same where the point at s is known.
Lag lag_at(const Cutter& cutter, const Meridian& m, double s,
           const MeridianPoint& p) noexcept;

/// @brief Length of edge in space per length of meridian, dS/ds, at least 1.
/// @eq G-6 dS = sqrt(1 + (r dlag/ds)^2) ds
/// @src [riviere2009] eq. 14 (dS), derived
double edge_length_factor(const MeridianPoint& point, const Lag& lag) noexcept;

/// @brief Radius and turn of an edge point from the axis of rotation.
/// @eq G-9  R = sqrt(r^2 + rho^2 + 2 r rho cos(c)),
///          epsilon = atan2(rho sin(c), r + rho cos(c))
/// @eq G-10 R = r + rho cos(c), epsilon = 0
/// @param r  nominal radius plus the tooth's radial offset [m]
/// @param c  psi_k + lag - lambda [rad]
EdgePosition edge_position(const Runout& runout, double r, double c) noexcept;

/// @brief Positions of all teeth at one arc length.
/// @param[in]  psi  angles of the tips [rad], shape (teeth)
/// @param[out] out  shape (teeth)
void edge_positions(const Runout& runout, std::span<const double> psi, double r,
                    double lag, std::span<EdgePosition> out) noexcept;

}  // namespace trochoid::geometry
