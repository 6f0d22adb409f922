#include "paper_case.h"

#include <trochoid/correction/speed_map.h>
#include <trochoid/correction/transition.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trochoid::correction::transition_test {

namespace {

constexpr double h_ro = 26e-6;

RigidCut paper_cut() {
  return {slot_with({h_ro / 2, -h_ro / 2}), steep_law()};
}

MapSetting paper_map() {
  return {.model = paper_plant(),
          .real = paper_plant(),
          .limits = {},
          .command = {.n_max = 9}};
}

/// What the choice leaves at a speed, as the speed map looks at it.
double left_at(const RigidCut& cut, std::span<const TransitionCandidate> candidates,
               double rpm) {
  const double Omega = rpm * unit::rpm;
  const TransitionCandidate& best =
      chosen_transition(cut, candidates, Method::inverse, paper_map(), Omega);
  return residual_at(cut, {best.motion, Method::inverse}, paper_map(), Omega)
      .peak_difference;
}

}  // namespace

/// An independent study finds 0.5 and 1.1 % with the best of six widths; one width of
/// 80 deg leaves 1.2 and 2.6 %.
TEST(Transition, ChosenBySpeedLeavesLessThanAnyFixedOne) {
  const RigidCut cut = paper_cut();
  const auto candidates = transition_candidates(cut, {});
  for (const double rpm : {400.0, 1200.0, 2000.0}) {
    EXPECT_LT(left_at(cut, candidates, rpm), 0.005) << rpm;
  }
  for (const double rpm : {3000.0, 4000.0, 5000.0, 6000.0}) {
    EXPECT_LT(left_at(cut, candidates, rpm), 0.011) << rpm;
  }
  const PeriodicMotion fixed = table_motion(cut, Shape::quintic, {});
  const double before =
      residual_at(cut, {fixed, Method::inverse}, paper_map(), 6000 * unit::rpm)
          .peak_difference;
  EXPECT_GT(before, 0.02);
}

TEST(Transition, AFasterSpindleGetsFewerHarmonics) {
  const RigidCut cut = paper_cut();
  const auto candidates = transition_candidates(cut, {});
  const auto at = [&](double rpm) -> const TransitionCandidate& {
    return chosen_transition(cut, candidates, Method::inverse, paper_map(),
                             rpm * unit::rpm);
  };
  EXPECT_GT(at(1200).harmonics, at(6000).harmonics);
  const double most = most_frequency(ActuatorLimits{}, paper_plant());
  for (const double rpm : {1200.0, 3000.0, 6000.0}) {
    EXPECT_LE(at(rpm).harmonics * rpm / 60, most);
  }
}

TEST(Transition, OfTheBestPeaksItTakesTheMostEvenChips) {
  const RigidCut cut = paper_cut();
  const auto candidates = transition_candidates(cut, {});
  const TransitionCandidate& best = chosen_transition(cut, candidates, Method::inverse,
                                                      paper_map(), 1200 * unit::rpm);
  for (const TransitionCandidate& other : candidates) {
    const bool follows = other.harmonics * 20 <= 400;
    if (follows && other.peak_difference <= 1e-3) {
      const MapPoint point = residual_at(cut, {other.motion, Method::inverse},
                                         paper_map(), 1200 * unit::rpm);
      if (point.n_max == other.harmonics && !point.clipped) {
        EXPECT_LE(best.area_difference, other.area_difference);
      }
    }
  }
}

/// Rounding, which is not the same everywhere, must not choose the command.
TEST(Transition, OfEqualOnesItTakesTheFirst) {
  const RigidCut cut = paper_cut();
  auto candidates = transition_candidates(cut, {});
  std::erase_if(candidates, [](const auto& one) { return one.harmonics != 3; });
  ASSERT_GT(candidates.size(), 2U);
  double less = 0.0;
  for (TransitionCandidate& one : candidates) {
    one.peak_difference = 1e-15 - less;
    one.area_difference = 1e-15 - less;
    less += 1e-17;
  }
  const TransitionCandidate& best = chosen_transition(cut, candidates, Method::inverse,
                                                      paper_map(), 1200 * unit::rpm);
  EXPECT_EQ(&best, candidates.data());
}

TEST(Transition, WhereNoCommandFitsTheBestThatIsCutOffIsTaken) {
  const RigidCut cut = paper_cut();
  const auto candidates = transition_candidates(cut, {});
  MapSetting small = paper_map();
  small.limits.stroke_high = 5e-6;
  const TransitionCandidate& best =
      chosen_transition(cut, candidates, Method::inverse, small, 6000 * unit::rpm);
  EXPECT_TRUE(residual_at(cut, {best.motion, Method::inverse}, small, 6000 * unit::rpm)
                  .clipped);
}

TEST(Transition, ThePlanChoosesWhereNoneIsGiven) {
  const Setting s = known_setting(moving_case(27.8e-6), {}, RunoutEstimate::known);
  CorrectionOptions options{.shape = Shape::quintic};
  const Plan chosen = plan_correction(s, options);
  ASSERT_TRUE(chosen.ok) << chosen.reason;
  ASSERT_TRUE(chosen.transition);
  EXPECT_TRUE(std::ranges::find(transition_widths, *chosen.transition) !=
              transition_widths.end());
  options.transition = 80 * unit::deg;
  EXPECT_DOUBLE_EQ(plan_correction(s, options).transition.value_or(0.0),
                   80 * unit::deg);
  options.shape = Shape::sine;
  EXPECT_FALSE(plan_correction(s, options).transition);
}

}  // namespace trochoid::correction::transition_test
