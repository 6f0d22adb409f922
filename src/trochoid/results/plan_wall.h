#pragma once

#include <trochoid/force/law.h>
#include <trochoid/results/answer.h>
#include <trochoid/surface/error_grid.h>
#include <trochoid/surface/plan_wall.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::results {

/// A way to measure a wall, and what it would tell.
struct PlannedDesign {
  surface::WallDesign design;
  std::size_t readings = 0;
  surface::WallPrediction told;
  bool enough = false;  ///< every interval that is wanted is kept
};

/// What more readings at one height would make of the answer.
struct MoreReadings {
  double height = 0.0;  ///< above the tip [m]
  surface::WallPrediction told;
};

/// One thing of the cut or of the wall made another, all else and the readings kept.
struct ChangedWall {
  std::string key;     ///< as in the case, for example `axial_depth_mm`
  double value = 0.0;  ///< [m]
  surface::WallPrediction told;
};

/// Which cut and which wall keep an error.
struct PlannedCutting {
  std::vector<double> feeds;             ///< [m]
  std::vector<double> radial_depths;     ///< [m]
  std::vector<surface::GridCell> cells;  ///< all feeds of the first radial depth first
  surface::GridCell stated;              ///< the cut as it stands
  bool mean = false;                     ///< the mean error is limited, not the peak
  std::optional<double> limit;           ///< [m]; nothing: none is given
  std::optional<std::size_t> best;       ///< cell with the largest removal rate
  /// Largest feed of each radial depth; nothing: none of those looked at.
  std::vector<std::optional<double>> feed_limits;
  std::optional<double> thickness;                ///< of the wall as it stands [m]
  std::optional<surface::ThinnestWall> thinnest;  ///< with a limit and a wall
};

/// @brief What `plan` answers for a wall: how to measure it, and how to cut it.
struct PlanWallResult {
  Heading heading;
  force::Law law;             ///< with the coefficients that are expected
  double eccentricity = 0.0;  ///< expected [m]
  surface::PlannedForm form = surface::PlannedForm::offset;
  double a_p = 0.0;                ///< axial depth [m]
  double noise = 0.0;              ///< of a reading [m]
  std::string noise_from;          ///< `readings`, `given` or `assumed`
  std::string why_no_runout;       ///< empty: readings can show it
  double wanted = 0.0;             ///< half width of a coefficient, a part of its value
  double wanted_runout = 0.0;      ///< half width of the eccentricity [m]
  std::vector<std::string> files;  ///< measured so far
  std::size_t measured = 0;        ///< readings
  std::optional<surface::WallPrediction> so_far;
  std::vector<PlannedDesign> designs;  ///< the fewest readings first
  std::optional<std::size_t> chosen;   ///< cheapest that is enough; else the best
  std::vector<MoreReadings> more;      ///< ten at each height, the best first
  std::vector<ChangedWall> changes;
  PlannedCutting cutting;
};

/// @brief Half of a 95 % interval of either coefficient as a part of its value, and of the
/// eccentricity [m]; not finite: not told.
struct HalfWidths {
  double K_tc;
  double K_rc;
  double eccentricity;
};
HalfWidths half_widths(const PlanWallResult& result,
                       const surface::WallPrediction& told);

/// The error of a cell that is limited [m].
double limited_error(const PlannedCutting& cutting, const surface::GridCell& cell);

/// @brief `Measure 9 heights ...: K_tc to +- 8 % ... Within 30 um: ...`
std::string wall_plan_sentence(const PlanWallResult& result);

/// @brief What the program prints for a person.
std::string wall_plan_table(const PlanWallResult& result);

Answer answer_of(const PlanWallResult& result);

}  // namespace trochoid::results
