#pragma once

#include <trochoid/correction/plan.h>
#include <trochoid/correction/residual_map.h>

#include <string>
#include <vector>

namespace trochoid::correction {

/// What was chosen at one speed.
struct ChosenAt {
  double width = 0.0;  ///< of a change of level [rad]
  int harmonics = 0;   ///< of the motion; 0: all
};

/// One curve of the map.
struct Curve {
  std::string name;              ///< for example `sine_lead`
  std::vector<MapPoint> points;  ///< shape (speeds)
  std::vector<ChosenAt> chosen;  ///< shape (speeds); empty: one motion for all
  double highest = 0.0;          ///< speed that keeps the difference allowed [rad/s]
};

/// @brief Differences of the peaks over the spindle speed.
struct SpeedMap {
  MapCut cut = MapCut::rigid;  ///< on which they were found
  std::vector<double> Omega;   ///< [rad/s]
  std::vector<Curve> curves;
  /// A spindle speed within the turn in place of the table, at the speed of the case.
  std::optional<SpeedModulation> spindle;
};

/// @brief A plan at other speeds, beside five usual strategies.
///
/// `quintic_chosen` takes width and harmonics by R-27 at every speed, the others one
/// motion for all speeds. `spindle_sine`, where there is a drive, turns the spindle
/// unevenly instead and is always of the rigid cut. On the moving cut the highest speed is looked for between the
/// speeds of the map only.
/// @param options  of the plan; without spindle speeds the map is empty
SpeedMap speed_map(const Setting& setting, const Plan& plan,
                   const CorrectionOptions& options);

}  // namespace trochoid::correction
