#pragma once

#include <trochoid/correction/plan.h>
#include <trochoid/correction/wall_marks.h>
#include <trochoid/dynamics/steady_state.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::correction {

/// A wall that the teeth leave, with the table as it moved.
struct MarkedWall {
  bool exit = false;  ///< where the teeth leave the stock, at theta = pi, else at 0
  WallMarks marks;
};

/// @brief The moving cut with a command, in its last turn.
struct MovedCut {
  dynamics::Motion motion;
  dynamics::Verdict verdict;
  /// Those that the arc of cut reaches; of a rigid tool, none where it chatters.
  std::vector<MarkedWall> walls;
};

/// @brief The same cut without and with its command.
struct BeforeAfter {
  MovedCut before;
  MovedCut after;
  double table_deviation = 0.0;  ///< of the table from the motion wanted, at most [m]
};

/// @brief The cut of a setting with a command, from rest on; followed further where it
/// seems to chatter.
/// @param command  of the actuator, about mid-stroke
MovedCut moved_cut(const Setting& setting, const PeriodicMotion& command);

/// @brief Why there are no steady peaks to make equal.
/// @param when  "before" or "after" the correction
/// @return empty where the cut does not chatter
std::string chatter_in(const MovedCut& cut, std::string_view when);

/// @brief Largest distance of the table from the motion of a plan [m].
/// @param after  the cut with the command of the plan; it does not chatter
double table_deviation(const Setting& setting, const Plan& plan, const MovedCut& after);

/// @brief 1 less the ratio of both differences of the peaks.
/// @return none where there was no difference
std::optional<double> reduction(const BeforeAfter& cuts);

}  // namespace trochoid::correction
