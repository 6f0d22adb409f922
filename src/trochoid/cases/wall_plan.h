#pragma once

#include <trochoid/surface/choices.h>

#include <optional>
#include <string_view>
#include <vector>

namespace trochoid::cases {

/// What a plan is about.
enum class PlanOf { forces, wall, finish };

/// As files spell it.
constexpr std::string_view name_of(PlanOf of) noexcept {
  switch (of) {
    case PlanOf::forces:
      return "forces";
    case PlanOf::wall:
      return "wall";
    case PlanOf::finish:
      return "finish";
  }
  return {};
}

/// Which error of a wall counts against a limit.
enum class LimitedError { peak, mean };

/// As files spell it.
constexpr std::string_view name_of(LimitedError error) noexcept {
  switch (error) {
    case LimitedError::peak:
      return "peak";
    case LimitedError::mean:
      return "mean";
  }
  return {};
}

/// [plan] of a wall, its defaults filled in by check_wall_plan.
struct WallPlan {
  std::vector<double> heights;     ///< numbers of heights
  std::vector<double> per_height;  ///< numbers of readings at each
  std::vector<double> spreads;     ///< lowest to highest, parts of the axial depth
  std::optional<double> noise;     ///< of a reading [m]
  std::optional<surface::PlannedForm> form;
  std::optional<double> wanted;         ///< of coefficients [percent]
  std::optional<double> wanted_runout;  ///< [m]
  std::optional<double> largest_error;  ///< of the wall [m]
  LimitedError limited = LimitedError::peak;
};

/// [plan] of a finish.
struct FinishPlanTable {
  std::optional<double> largest_Ra;  ///< [m]
  double inserts_within = 5e-6;      ///< of another set [m]
};

}  // namespace trochoid::cases
