#pragma once

#include <trochoid/surface/calibrate.h>
#include <trochoid/surface/plan_wall.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// How to measure a wall so that it tells the coefficients and the runout as well as is
/// wanted (E-60).
namespace trochoid::surface {

/// A way to measure a wall, and what it would tell.
struct PlannedDesign {
  WallDesign design;
  std::size_t readings = 0;
  WallPrediction told;
  bool enough = false;  ///< every interval that is wanted is kept
};

/// What more readings at one height would make of the answer.
struct MoreReadings {
  double height = 0.0;  ///< above the tip [m]
  WallPrediction told;
};

/// One thing of the cut or of the wall made another, all else and the readings kept.
struct ChangedWall {
  std::string key;     ///< as in the case, for example `axial_depth_mm`
  double value = 0.0;  ///< [m]
  WallPrediction told;
};

/// @brief Half of a 95 % interval of either coefficient as a part of its value, and of the
/// eccentricity [m]; not finite: not told.
struct HalfWidths {
  double K_tc;
  double K_rc;
  double eccentricity;
};

/// @param expected  with the coefficients that the parts are of
HalfWidths half_widths(const force::Law& expected, const WallPrediction& told);

/// How well coefficients and runout are to be known.
struct WantedWidths {
  double coefficients = 0.1;   ///< half width, a part of the value
  double eccentricity = 1e-6;  ///< half width [m]
};

/// Which readings to take.
struct ReadingsPlan {
  std::string why_no_runout;  ///< empty: readings can show it
  std::optional<WallPrediction> so_far;
  std::vector<PlannedDesign> designs;  ///< as they were given
  std::optional<std::size_t>
      chosen;                      ///< cheapest that is enough; else the best, if any
  std::vector<MoreReadings> more;  ///< ten at each height, the best first
  double shortfall = 0.0;  ///< of the chosen: its worst interval against what is wanted
};

/// @brief What is expected once a wall has been measured: the coefficients, the runout
/// where it was seen, and the noise of the readings.
/// @param c  ok, of the setting of the trial
WallTrial expected_after(WallTrial trial, const Calibration& c);

/// @brief Every combination of spread, heights and places at each height, once, the fewest
/// readings first.
/// @param heights, places  whole numbers; of places the next that a turn divides into
std::vector<WallDesign> wall_designs(std::span<const double> spreads,
                                     std::span<const double> heights,
                                     std::span<const double> places, int teeth);

/// @brief What each of some ways to measure a wall would tell, and what ten readings more
/// would: beside the chosen way, or beside what was measured already.
///
/// @param trial     with the coefficients and the runout that are expected
/// @param designs   the fewest readings first
/// @param measured  readings so far; empty: none
/// @param position  of the cutter along the wall [m]
/// @throws std::domain_error where the wall has no steady state
ReadingsPlan plan_readings(const WallTrial& trial, std::span<const WallDesign> designs,
                           const WantedWidths& wanted,
                           std::span<const Reading> measured, double position);

/// @brief What a way to measure tells of other cuts, walls and places: one thing another at
/// a time, the heights in proportion to the axial depth.
/// @param dimensions  of the bodies of the trial
std::vector<ChangedWall> plan_changes(const WallTrial& trial, const WallDesign& design,
                                      const BodyDimensions& dimensions);

}  // namespace trochoid::surface
