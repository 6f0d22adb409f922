#pragma once

#include <trochoid/dynamics/gradient.h>
#include <trochoid/force/law.h>
#include <trochoid/force/setup.h>

#include <memory>
#include <vector>

namespace trochoid::dynamics {

/// Degree of the polynomials by which a directional matrix is given.
inline constexpr int directional_degree = 20;

/// @brief An interval of the spindle angle in which nothing switches on or off.
struct DirectionalElement {
  double from = 0.0;  ///< [rad]
  double to = 0.0;    ///< [rad]
  /// At the nodes of directional_degree, shape (1 + delays, nodes) [N/m]: first what
  /// acts on q(phi), then what acts on q(phi - delay). Empty: zero.
  std::vector<std::vector<Matrix2>> matrices;
  /// What acts on dq/dphi, shape (nodes) [N]. Empty: no process damping here.
  std::vector<Matrix2> damping;
};

/// @brief The linearised cutting force, periodic in the spindle angle.
///
/// @eq D-8 dF(phi) = A_0(phi) q(phi) - sum over delays d of A_d(phi) q(phi - d)
/// @src [diez2010] eq. 14 for every tooth, height and mark
/// @eq D-30 and with process damping + D(phi) dq/dphi
/// @src derived: F-16 with dq/dt / v = (dq/dphi) / R
struct Directional {
  double period = 0.0;         ///< pitch of equal teeth, else a turn [rad]
  std::vector<double> delays;  ///< [rad], ascending, at most the period
  std::vector<DirectionalElement> elements;  ///< ascending, one period without gaps
};

/// How deep and how fast a cut is looked at.
struct Reach {
  double deepest = 0.0;  ///< greatest depth asked for [m]; at least that of the cut
  /// Of the fastest vibration, as an angle of the spindle [rad]: needed where delays
  /// change along the edge.
  double cycle = 0.05;
};

/// @brief Makes D-8 of a cut for any axial depth.
///
/// @eq D-9 A_d(phi) = sum over teeth and pieces with that delay of the integral
///         of g along the edge
/// @src derived; on constant-lead cylinders as F-5
/// @eq D-31 D(phi) = sum over teeth of the integral of g_d / R along the edge in cut,
///          g_d the g of the linear law K_t = mu c, K_r = c, K_a = 0
/// @src derived: F-16 in the directions of D-7; R not below a feed per tooth, where no
///      chip forms either
/// @note The normal of a mark is taken along the ray: good to f/R.
class DirectionalModel {
 public:
  /// @param h_floor    least chip of the gradient of a power law [m], positive
  /// @param tolerance  of the matrices, relative to their largest entry; other cutters than
  ///                   cylinders of constant lead reach 1e-5, serrated ones 1e-4 (D-37)
  DirectionalModel(const force::Setup& setup, const force::Law& law, double h_floor,
                   double tolerance, const Reach& reach = {});

  /// @param a_p  axial depth [m], positive; of other cutters than cylinders of constant lead
  ///             at most the deepest, else std::invalid_argument
  [[nodiscard]] Directional at_depth(double a_p) const;
  /// Is all of it proportional to a_p? So it is on straight edges of a cylinder.
  [[nodiscard]] bool proportional() const noexcept;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

}  // namespace trochoid::dynamics
