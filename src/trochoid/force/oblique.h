#pragma once

namespace trochoid::force {

/// @brief What cutting across the edge, a tube turned say, tells of a material.
struct OrthogonalCut {
  double tau_s = 0.0;    ///< shear stress in the shear plane [N/m^2]
  double phi_c = 0.0;    ///< shear angle [rad]
  double beta_a = 0.0;   ///< friction angle on the rake face [rad]
  double alpha_n = 0.0;  ///< normal rake angle [rad]
};

/// Cutting coefficients of an edge along t, r, a [N/m^2].
struct ObliqueCoefficients {
  double K_tc = 0.0;
  double K_rc = 0.0;
  double K_ac = 0.0;
};

/// @brief Shear angle of a chip that became thicker. [rad]
///
/// @eq F-17 tan(phi_c) = r cos(alpha) / (1 - r sin(alpha))
/// @src [budak1996]
/// @param ratio  of the uncut chip to the chip, above 0
double shear_angle(double ratio, double alpha) noexcept;

/// @brief Mean chip over the arc of cut. [m]
///
/// @eq F-18 h_m = f_z (cos(theta_st) - cos(theta_ex)) / (theta_ex - theta_st)
/// @src [budak1996]
/// @param f_z   [m]
/// @param from  where a tooth enters, below `to` [rad]
/// @param to    where it leaves [rad]
double mean_chip(double f_z, double from, double to) noexcept;

/// @brief Coefficients of an edge that is inclined, from what cutting across an edge tells.
///
/// @eq F-19 K_tc = tau_s/sin(phi_n) (cos(beta_n - alpha_n) + tan(i) tan(eta) sin(beta_n))/c,
///          K_rc = tau_s/(sin(phi_n) cos(i)) sin(beta_n - alpha_n)/c,
///          K_ac = tau_s/sin(phi_n) (cos(beta_n - alpha_n) tan(i) - tan(eta) sin(beta_n))/c,
///          c = sqrt(cos(phi_n + beta_n - alpha_n)^2 + tan(eta)^2 sin(beta_n)^2),
///          tan(beta_n) = tan(beta_a) cos(eta), phi_n = phi_c, eta = i
/// @src [budak1996]
/// @param i  inclination of the edge: the helix angle of a cylinder, below pi/2 [rad]
/// @note phi_n + beta_n - alpha_n must be below pi/2, phi_n above 0
ObliqueCoefficients oblique_coefficients(const OrthogonalCut& cut, double i) noexcept;

}  // namespace trochoid::force
