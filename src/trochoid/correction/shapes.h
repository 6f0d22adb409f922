#pragma once

#include <trochoid/correction/periodic_motion.h>
#include <trochoid/correction/rigid_cut.h>

#include <span>
#include <string_view>
#include <vector>

namespace trochoid::correction {

/// How the table goes from one level to the next.
enum class Shape {
  sine,       ///< a sine at spindle frequency through the levels
  square,     ///< at once
  trapezoid,  ///< at constant speed
  quintic,    ///< without jump of place, speed and acceleration
  harmonics,  ///< harmonics of the spindle, by least squares over the whole cut
};

/// The names that files use.
constexpr std::string_view name_of(Shape shape) noexcept {
  switch (shape) {
    case Shape::sine:
      return "sine";
    case Shape::square:
      return "square";
    case Shape::trapezoid:
      return "trapezoid";
    case Shape::quintic:
      return "quintic";
    case Shape::harmonics:
      return "harmonics";
  }
  return {};
}

struct ShapeOptions {
  double transition = 1.3962634015954636;  ///< width of a change of level [rad]: 80 deg
  int harmonics = 9;                       ///< highest of Shape::harmonics
};

/// @brief Where the table should stand while each tooth cuts [m].
///
/// @eq R-3 x_j = rho_j - mean(rho): x_j - x_(j-m) = rho_j - rho_(j-m), h_j = m f_z at
///         theta = 90 deg for every m
/// @src derived
std::vector<double> levels(std::span<const double> rho);

/// @brief A motion of the table through the levels of a cut.
///
/// @eq R-4 square: x_j from b_j to b_(j+1), b_j = psi_j + (theta_st + theta_ex)/2 -
///         pitch_(j-1)/2; trapezoid, quintic: transitions centred on b_j
/// @eq R-5 sine: min over a, b of the sum over j of (x_j - a sin(phi_j) - b
///         cos(phi_j))^2, phi_j = psi_j + (theta_st + theta_ex)/2
/// @src derived; harmonics: R-7 over all a_n, b_n
/// @note b_j is the entry of tooth j in a slot with two teeth. The transition is cut
///       to the smallest pitch. With equal pitch, harmonics that are multiples of the
///       number of teeth change no chip and are left out.
PeriodicMotion table_motion(const RigidCut& cut, Shape shape,
                            const ShapeOptions& options);

/// @brief The same through levels of their own.
/// @param rho  in place of the offsets of the teeth [m], shape (teeth)
PeriodicMotion table_motion(const RigidCut& cut, Shape shape,
                            const ShapeOptions& options, std::span<const double> rho);

/// @brief The first harmonics of a motion, as large as keeps the middle of every pass.
///
/// @eq R-24 X_n = q (harmonics 1 to n), q = sum of X X_n/sum of X_n^2 over phi_j of R-5
/// @src derived: a square's first harmonic alone is larger than the square
PeriodicMotion limited(const RigidCut& cut, const PeriodicMotion& motion, int n_max);

/// @brief Root mean square over all arcs of cut of what a motion leaves of the chip
/// differences [m].
///
/// @eq R-7 e_j = rho_j - rho_(j-1) - (X(phi) - X(phi - pitch_(j-1))) sin(theta_j)
/// @src R-1 with the mark of the tooth before
double chip_rms(const RigidCut& cut, const PeriodicMotion& X);

/// @brief What is left of the chip differences at best [m], R-7.
///
/// One axis cannot serve two teeth in cut at once; two can do more.
///
/// @eq R-8 with a second axis: e_j - (Y(phi) - Y(phi - pitch_(j-1))) cos(theta_j)
/// @eq R-30 |e_0 - A x| >= (r e_0 - |A^T r|_1 x_max)/|r| for every |x_n| <= x_max, r the
///          residual of the answer, x_max = 1 mm: a bound below, by duality
/// @src derived; [boyd2004] for the dual of a least norm
struct AxisLimits {
  double uncorrected = 0.0;
  double one_axis = 0.0;        ///< table along the feed
  double two_axes = 0.0;        ///< table along and across the feed
  int most_teeth = 0;           ///< in cut at once
  double one_axis_bound = 0.0;  ///< no motion of these harmonics leaves less [m]
  double two_axes_bound = 0.0;
};
/// @param n_max  highest harmonic of the spindle that the table follows
AxisLimits axis_limits(const RigidCut& cut, int n_max);

}  // namespace trochoid::correction
