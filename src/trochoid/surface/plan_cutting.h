#pragma once

#include <trochoid/surface/error_grid.h>

#include <cstddef>
#include <optional>
#include <vector>

/// Which cut and which wall keep an allowed error.
namespace trochoid::surface {

/// The cuts that are looked at, and the error that is allowed.
struct CuttingRequest {
  std::vector<double> feeds;          ///< per tooth, rising [m]
  std::vector<double> radial_depths;  ///< rising [m]
  Feedback feedback = Feedback::none;
  bool mean = false;            ///< the mean error is limited, not the peak
  std::optional<double> limit;  ///< of the error [m]; nothing: none is given
};

/// Which cut and which wall keep an error.
struct PlannedCutting {
  std::vector<double> feeds;          ///< [m]
  std::vector<double> radial_depths;  ///< [m]
  std::vector<GridCell> cells;        ///< all feeds of the first radial depth first
  GridCell stated;                    ///< the cut as it stands
  bool mean = false;                  ///< the mean error is limited, not the peak
  std::optional<double> limit;        ///< [m]; nothing: none is given
  std::optional<std::size_t> best;    ///< cell with the largest removal rate
  /// Largest feed of each radial depth; nothing: none of those looked at.
  std::vector<std::optional<double>> feed_limits;
  std::optional<double> thickness;       ///< of the wall as it stands [m]
  std::optional<ThinnestWall> thinnest;  ///< with a limit and a wall
};

/// The error of a cell that is limited [m].
double limited_error(const PlannedCutting& cutting, const GridCell& cell);

/// @brief The error over feeds and radial depths, and what keeps the allowed one: the cut
/// that removes most, the largest feeds (bilinear between cells) and the thinnest wall
/// (E-63).
///
/// @param expected    with the coefficients and the runout that are expected
/// @param dimensions  of the bodies of the setting
PlannedCutting plan_cutting(const Setting& expected, const BodyDimensions& dimensions,
                            const CuttingRequest& request);

}  // namespace trochoid::surface
