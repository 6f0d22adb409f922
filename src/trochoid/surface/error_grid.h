#pragma once

#include <trochoid/surface/error_map.h>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::surface {

/// One feed and radial depth, and the wall that they leave.
struct GridCell {
  double f_z = 0.0;   ///< [m]
  double a_e = 0.0;   ///< [m]
  bool ok = false;    ///< false: no steady state was found, and no error is known
  double peak = 0.0;  ///< largest distance from the wall as wanted, either way [m]
  double mean = 0.0;  ///< over feed and height [m]
  double removal_rate = 0.0;  ///< [m^3/s]
};

/// @brief Volume that is cut in a time.
/// @eq E-62 Q = a_p a_e N f_z Omega/(2 pi)
/// @src standard: cross section of the stock times feed rate
double removal_rate(const force::Setup& setup);

/// @brief Width of the stock that is cut [m].
/// @throws std::invalid_argument for a slot or a band
double radial_depth_of(const geometry::Engagement& engagement);

/// @brief The same cut with another radial depth, on the same side of the wall.
force::Setup with_radial_depth(force::Setup setup, double a_e);

/// @brief Peak and mean error over feeds and radial depths.
///
/// With feedback, what that changes is found at up to 5 by 5 of the cells and is bilinear
/// between them: a steady state takes a hundred times as long as a rigid wall.
/// @param samples  of the map at each; its feedback counts
/// @return row after row: all feeds of the first radial depth, then of the next
std::vector<GridCell> error_grid(const Setting& setting, const MapOptions& samples,
                                 std::span<const double> feeds,
                                 std::span<const double> radial_depths);

/// @brief The largest feed of each radial depth that keeps a limit, between cells.
/// @param error  of a cell, whichever counts [m]
/// @return shape (radial depths); nothing: not even the smallest feed does, or a cell
///         before has no answer
std::vector<std::optional<double>> feed_limits(
    std::span<const GridCell> cells, std::size_t feeds, double limit,
    const std::function<double(const GridCell&)>& error);

/// @brief A thickness of the wall, and the error that it leaves.
struct ThinnestWall {
  std::optional<double> thickness;  ///< [m]; nothing: none of those looked at is enough
  double error = 0.0;        ///< there, or of the thickest that was looked at [m]
  bool thinner_too = false;  ///< the thinnest that was looked at is enough already
};

/// @brief The thinnest wall that keeps a limit, the cut as it is.
///
/// @eq E-63 t* = min t with |e|(t') <= limit for t' >= t, by bisection of log t: the wall
///          gives as 1/t^3 (B-3), so that the error falls with t
/// @src derived
/// @param error  at a thickness [m]; not finite: no answer, which counts as too much
ThinnestWall thinnest_wall(double from, double to, double limit,
                           const std::function<double(double thickness)>& error);

}  // namespace trochoid::surface
