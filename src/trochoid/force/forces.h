#pragma once

#include <trochoid/force/law.h>
#include <trochoid/force/setup.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::force {

using Vector3 = std::array<double, 3>;

/// Force [N] in x, y, z, torque about the spindle axis and bending moments about x and y
/// [N m].
using SixLoads = std::array<double, 6>;

/// @brief The matrix [C] of eq. 19, prepared once for a setup and evaluated anywhere.
///
/// Only the exponents of a Power law are used here, never the coefficients.
class ForceMatrix {
 public:
  /// @param tolerance  error allowed, relative to the largest entry of a column
  ForceMatrix(const Setup& setup, const Law& law, double tolerance);

  [[nodiscard]] int columns() const noexcept;
  /// About what it takes to find it at so many angles, in evaluations of a chip and its
  /// force at a point of an edge.
  [[nodiscard]] double work(std::size_t angles) const noexcept;

  /// @brief Angles at which the matrix jumps, in [0, 2 pi] and ascending, where they are
  /// known: of straight edges under a linear law. Nothing: they are not.
  [[nodiscard]] std::optional<std::vector<double>> jumps() const;

  /// @param[in]  phi  angles of the tip of tooth 1 [rad], shape (n)
  /// @param[out] C    row-major, shape (n, 3, columns)
  void evaluate(std::span<const double> phi, std::span<double> C) const;

  /// @brief The same by columns, for least squares.
  /// @param[in]  phi     angles of the tip of tooth 1 [rad], shape (n)
  /// @param[in]  weight  factors of the rows of each angle, shape (n)
  /// @param[out] C       column c from c stride on: three rows an angle
  void evaluate_columns(std::span<const double> phi, std::span<const double> weight,
                        std::span<double> C, std::size_t stride) const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

/// @brief Mean force on the tool over a turn, by integrals: that of samples misses what a
/// straight edge does between them.
/// @param tolerance  as of forces
/// @return [N], workpiece frame; absent where there are no integrals: a power law, edges
///         that change their radius, chips of many harmonics
std::optional<Vector3> mean_force(const Setup& setup, const Law& law, double tolerance);

/// @brief Force on the tool [N] at the angles phi of the tip of tooth 1 [rad].
/// @param tolerance  relative to the largest force that the feed and depth could make
/// @return shape (n, 3), workpiece frame
std::vector<Vector3> forces(const Setup& setup, const Law& law,
                            std::span<const double> phi, double tolerance);

/// @brief Forces of many cuts over the same angles, shared between the cores.
/// @param[out] F  [N], shape (setups, n, 3); the same bits for any number of threads
void forces_of_many(std::span<const Setup> setups, const Law& law,
                    std::span<const double> phi, double tolerance,
                    std::span<Vector3> F);

/// What the workpiece, the spindle and the tool holder feel.
struct Loads {
  Vector3 force{};       ///< on the tool [N], workpiece frame
  double torque = 0.0;   ///< about the spindle axis [N m], positive: the spindle drives
  double bending = 0.0;  ///< bending moment at the gauge length [N m]
};

/// Means of force and torque over a turn.
struct MeanLoads {
  Vector3 force{};      ///< [N], workpiece frame
  double torque = 0.0;  ///< [N m]
};

/// @brief Means over a turn, of any cutter under any law: an integral over theta and
/// height, not a mean of samples.
/// @eq F-31 mean = 1/(2 pi) sum over teeth of the integral over z and theta of [B] dF
MeanLoads exact_mean(const Setup& setup, const Law& law, double tolerance);

/// Means over a turn of all that a sensor may read.
struct TurnMeans {
  SixLoads fixed{};  ///< in the workpiece frame
  /// F_u, F_v [N], M_u, M_v [N m] in the frame that turns with the tool, u through the tip
  /// of tooth 1 (F-32).
  std::array<double, 4> turning{};
};

/// @brief Means as exact_mean, with bending moments and in the turning frame.
/// @param gauge_length  of the section about which moments are taken [m]
TurnMeans turn_means(const Setup& setup, const Law& law, double gauge_length,
                     double tolerance);

/// @brief Force, torque and bending moments about x and y at the angles phi [rad].
/// @param gauge_length  of the section [m]; nothing: moments are not asked for and stay 0
/// @return shape (n)
std::vector<SixLoads> six_loads(const Setup& setup, const Law& law,
                                std::span<const double> phi,
                                std::optional<double> gauge_length, double tolerance);

/// @brief Force, torque and bending moment at the angles phi [rad] (F-4, F-6, F-7).
/// @param gauge_length  height of the section above the tool tip [m]; nothing: bending is
///                      not asked for and stays 0
/// @return shape (n)
std::vector<Loads> loads(const Setup& setup, const Law& law,
                         std::span<const double> phi,
                         std::optional<double> gauge_length, double tolerance);

}  // namespace trochoid::force
