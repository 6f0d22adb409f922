#include <trochoid/correction/before_after.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::correction {

namespace {

using dynamics::Motion;
using dynamics::Verdict;

/// How far the arc of cut may miss a wall that it reaches [rad].
constexpr double wall_slack = 1e-6;

/// The table over the last turn.
const std::vector<double>& table_of(const Setting& s, const Motion& m) {
  return m.mode[s.cut.tool.size()];
}

std::vector<MarkedWall> walls_of(const Setting& s, const Motion& m) {
  const RigidCut cut(s.cut.setup, s.cut.law, 1);
  const PeriodicMotion X = harmonics_of_samples(table_of(s, m), table_harmonics);
  std::vector<MarkedWall> walls;
  for (const bool exit : {false, true}) {
    const double theta = exit ? std::numbers::pi : 0.0;
    if (theta >= cut.arc().from - wall_slack && theta <= cut.arc().to + wall_slack) {
      walls.push_back({exit, wall_marks(cut, X, exit)});
    }
  }
  return walls;
}

/// The peaks of the whole force in the place of those of each flute alone.
void take_whole_force(const Setting& s, MovedCut& cut) {
  Motion& m = cut.motion;
  cut.own = m.flutes;
  if (!m.finite || !m.solved) {
    return;
  }
  const RigidCut rigid(s.cut.setup, s.cut.law, 1);
  for (dynamics::FluteMotion& flute : m.flutes) {
    flute.peak_x = 0.0;
    flute.peak_y = 0.0;
  }
  for (std::size_t i = 0; i < m.angle.size(); ++i) {
    dynamics::FluteMotion& flute = m.flutes[rigid.turn_of(m.angle[i])];
    flute.peak_x = std::max(flute.peak_x, std::abs(m.force[i][0]));
    flute.peak_y = std::max(flute.peak_y, std::abs(m.force[i][1]));
  }
}

}  // namespace

MovedCut moved_cut(const Setting& setting, const PeriodicMotion& command) {
  dynamics::MotionProblem p = problem_of(setting.cut, command);
  p.kept = 1;
  MovedCut cut{.motion = dynamics::motion(p)};
  cut.verdict = dynamics::verdict_so_far(cut.motion);
  take_whole_force(setting, cut);
  if (cut.verdict != Verdict::chatter) {
    cut.walls = walls_of(setting, cut.motion);
  }
  return cut;
}

std::string chatter_in(const MovedCut& cut, std::string_view when) {
  const Motion& m = cut.motion;
  if (cut.verdict != Verdict::chatter) {
    return {};
  }
  if (!m.finite || !m.solved) {
    return fmt::format(
        "chatter {} the correction: after {} turns the "
        "motion had grown beyond all bounds",
        when, m.turns_done);
  }
  return fmt::format(
      "chatter {} the correction: the force still changes by {:.3g} of {:.3g} N "
      "from turn to turn; there are no steady peaks to make equal",
      when, m.last_change, dynamics::largest_component(m));
}

double table_deviation(const Setting& setting, const Plan& plan,
                       const MovedCut& after) {
  const std::vector<double>& table = table_of(setting, after.motion);
  double most = 0.0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double wanted = place_at(plan.motion, after.motion.angle[i]);
    most = std::max(most, std::abs(table[i] - wanted));
  }
  return most;
}

std::optional<double> reduction(const BeforeAfter& cuts) {
  const double before = dynamics::peak_difference(cuts.before.motion);
  const double after = dynamics::peak_difference(cuts.after.motion);
  return before > 0 ? std::optional(1 - after / before) : std::nullopt;
}

double own_difference(const MovedCut& cut) {
  std::vector<double> peaks;
  for (const dynamics::FluteMotion& flute : cut.own) {
    peaks.push_back(flute.peak_y);
  }
  return dynamics::relative_difference(peaks);
}

}  // namespace trochoid::correction
