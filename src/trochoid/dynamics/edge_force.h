#pragma once

#include <trochoid/force/form.h>

#include <array>
#include <cstddef>
#include <span>

/// Many points of edges at once, on as wide vectors as the machine has.
namespace trochoid::dynamics {

/// @brief Points of edges that cut, side by side.
struct PointsInCut {
  std::size_t count = 0;
  const double* sine = nullptr;    ///< of theta
  const double* cosine = nullptr;  ///< of theta
  const double* width = nullptr;   ///< of chip [m]
  const double* edge = nullptr;    ///< length [m]
};

/// Where an earlier tooth stood when it left a mark, away from its place at rest [m].
struct Displaced {
  double x = 0.0;
  double y = 0.0;
};

/// @brief The chip but for the motion now, at the points of one tooth.
///
/// @eq  T-1 min over m of a_m - q(t - t_m) . n
/// @src [diez2010] eq. 8 to 14
/// @param[in]  above  of the stock, then of each mark, row-major, shape (1 + marks, count) [m]
/// @param[in]  marks  of the teeth before
/// @param[out] least  shape (count) [m]
void chips_over_marks(const PointsInCut& points, const double* above,
                      std::span<const Displaced> marks, double* least) noexcept;

/// Sums over points: force along x, y, z [N], then dF/dq, rows x, y, z; columns x, y [N/m].
using ForceSums = std::array<double, 9>;

/// @brief Force of points and its slope over q; those that do not cut make none.
/// @param constant  chip without q [m], shape (count)
ForceSums force_of_points(const PointsInCut& points, const double* constant,
                          const Displaced& q, const force::Terms& law) noexcept;

}  // namespace trochoid::dynamics
