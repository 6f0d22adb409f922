#pragma once

#include <trochoid/force/law.h>
#include <trochoid/results/answer.h>
#include <trochoid/surface/plan_cutting.h>
#include <trochoid/surface/plan_readings.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::results {

/// Unit of a removal rate [m^3/s].
inline constexpr double mm3_per_min = 1e-9 / 60.0;

using surface::ChangedWall;
using surface::HalfWidths;
using surface::MoreReadings;
using surface::PlannedCutting;
using surface::PlannedDesign;

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

/// @brief `Measure 9 heights ...: K_tc to +- 8 % ... Within 30 um: ...`
std::string wall_plan_sentence(const PlanWallResult& result);

/// @brief What the program prints for a person.
std::string wall_plan_table(const PlanWallResult& result);

Answer answer_of(const PlanWallResult& result);

}  // namespace trochoid::results
