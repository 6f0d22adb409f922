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
///
/// The peaks in `motion` are those of the whole force while a tooth is the one nearest to
/// the middle of the arc of cut: what a dynamometer shows and a plan makes equal.
struct MovedCut {
  dynamics::Motion motion;
  /// Of each flute's own force, which no dynamometer shows where several teeth cut at
  /// once.
  std::vector<dynamics::FluteMotion> own;
  dynamics::Verdict verdict = dynamics::Verdict::periodic;
  /// Those that the arc of cut reaches; of a rigid tool, none where it chatters.
  std::vector<MarkedWall> walls;
};

/// @brief The same cut without and with its command.
struct BeforeAfter {
  MovedCut before;
  MovedCut after;
  double table_deviation = 0.0;  ///< of the table from the motion wanted, at most [m]
};

/// @brief The cut of a setting with a command, from rest on.
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

/// @brief dynamics::relative_difference of the peaks of |F_y| of the flutes' own forces.
double own_difference(const MovedCut& cut);

}  // namespace trochoid::correction
