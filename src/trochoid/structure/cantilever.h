#pragma once

namespace trochoid::structure {

/// @brief A cutter as a beam clamped at the holder: an arbor, then the fluted part.
///
/// All lengths positive but `flute_length`, which may be 0 (arbor only) or reach the
/// overhang (fluted only; what lies beyond is inside the holder).
struct Cantilever {
  double overhang = 0.0;        ///< from the holder to the tip [m]
  double flute_length = 0.0;    ///< from the tip up [m]
  double shank_diameter = 0.0;  ///< of the arbor [m]
  double flute_diameter = 0.0;  ///< of a round bar as stiff as the fluted part [m]
  double youngs_modulus = 0.0;  ///< [N/m^2]
};

/// @brief What moves a point of the fluted part, apart by cause [m/N].
struct CantileverParts {
  double arbor_deflection = 0.0;  ///< shift of the end of the arbor
  double arbor_slope = 0.0;       ///< tilt of the end of the arbor times the distance
  double fluted = 0.0;            ///< bending of the fluted part itself
};

/// @brief Deflection at one height for 1 N across the axis at another.
///
/// @eq  B-1  G(z1,z2) = int_0^min(s1,s2) (s1-s)(s2-s)/(E I(s)) ds,  s = overhang - z
/// @src [wang2015] eq. (4), reconstructed
///
/// @param[in] z_observed  height above the tip [m], at least 0
/// @param[in] z_loaded    height above the tip [m], at least 0
/// @return [m/N], exact for the slender beam (no shear); 0 at or above the holder.
///         Symmetric in the two heights.
double compliance(const Cantilever& cutter, double z_observed,
                  double z_loaded) noexcept;

/// @brief The three terms whose sum is `compliance`.
///
/// @eq  B-2  delta_s = (3 p v^2 - v^3 + <v-p>^3)/(6 E I_s) with p = s_load, v =
///           min(s, L_s);  theta_s u = (2 p L_s - L_s^2 + <L_s-p>^2) u/(2 E I_s);
///           delta_t = (3 p_t u^2 - u^3 + <u-p_t>^3)/(6 E I_t),
///           u = <s-L_s>, p_t = <s_load-L_s>
/// @src [wang2015] eq. (4), reconstructed; <v-p> = max(v-p, 0) adds loads on the arbor
CantileverParts compliance_parts(const Cantilever& cutter, double z_observed,
                                 double z_loaded) noexcept;

/// @brief Deflection at one height for a couple of 1 N m at another.
///
/// A couple is a force and its opposite a little higher up: the derivative of
/// `compliance` by the height of the load.
/// @eq  B-12  G_M(z1,z2) = dG(z1,z2)/dz2 = -int_0^min(s1,s2) (s1-s)/(E I(s)) ds
/// @src derived from B-1
/// @return [m/(N m)], never positive; 0 at or above the holder
double couple_compliance(const Cantilever& cutter, double z_observed,
                         double z_loaded) noexcept;

}  // namespace trochoid::structure
