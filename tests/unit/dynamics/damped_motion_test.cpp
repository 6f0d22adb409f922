#include <trochoid/dynamics/force_balance.h>
#include <trochoid/dynamics/growth.h>
#include <trochoid/dynamics/make_grid.h>
#include <trochoid/dynamics/motion.h>
#include <trochoid/dynamics/past.h>
#include <trochoid/dynamics/stepper.h>

#include "milling_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// Motion in time with a worn flank.
namespace trochoid::dynamics::damped_motion_test {

constexpr force::ProcessDamping worn{80e-6, 3e13, 0.3};
constexpr double c_worn = 0.5 * 3e13 * 80e-6 * 80e-6;  // [N/m]

MotionProblem worn_tool(double helix = 0.0) {
  MotionProblem p;
  p.setup = straight_cut(2, geometry::Slot{});
  p.setup.cutter.helix = helix;
  p.setup.process_damping = worn;
  p.setup.cut.a_p = 1.5e-3;
  p.setup.cut.Omega = 1200 * unit::rpm;
  p.setup.chip = {chip::Model::radial, chip::Lookback::all};
  p.law = benchmark_law();
  p.system = {{mode_of(0.4, 600, 0.02, 1, 0), mode_of(0.2, 900, 0.02, 0, 1)}};
  p.grid.steps_per_tooth = 500;
  return p;
}

/// The node next to a spindle angle.
std::size_t node_near(const EngagedGrid& grid, double phi) {
  return static_cast<std::size_t>(
      std::lower_bound(grid.angle.begin(), grid.angle.end(), phi) - grid.angle.begin());
}

TEST(DampedForce, IsAgainstTheSpeedIntoTheWork) {  // [T-16] [F-16]
  const MotionProblem p = worn_tool();
  const EngagedGrid grid = engaged_grid(p.setup, p.grid, 500);
  const std::size_t node = node_near(grid, 1.0);
  const Past still(grid);
  CutForce sharp(p.law, grid);
  CutForce cut(p.law, grid, flank_terms(p.setup));
  EXPECT_FALSE(sharp.damps());
  ASSERT_TRUE(cut.damps());
  const double s = std::sin(grid.angle[node]);
  const double c = std::cos(grid.angle[node]);
  const std::array<double, 2> v = {0.02, 0.05};
  const double rdot = v[0] * s + v[1] * c;
  const double f_r = c_worn * 1.5e-3 * rdot / (5e-3 * p.setup.cut.Omega);
  const double f_t = 0.3 * f_r;
  sharp.prepare(node, grid.after[node], still.last());
  cut.prepare(node, grid.after[node], still.last());
  const Response without = sharp.response({1e-6, 2e-6}, v);
  const Response with = cut.response({1e-6, 2e-6}, v);
  EXPECT_NEAR(with.F[0] - without.F[0], -f_t * c - f_r * s, 1e-9 * f_r);
  EXPECT_NEAR(with.F[1] - without.F[1], f_t * s - f_r * c, 1e-9 * f_r);
  EXPECT_EQ(with.per_q, without.per_q);
  // Out of the cut there is none
  const Response off = cut.response({-1e-3, -1e-3}, v);
  EXPECT_EQ(off.F[0], 0);
  EXPECT_EQ(off.per_speed[0], 0);
}

TEST(DampedForce, OfAHelixIsTheSumOfItsPoints) {  // [T-16]
  const MotionProblem p = worn_tool(0.6);
  const EngagedGrid grid = engaged_grid(p.setup, p.grid, 500);
  const std::size_t node = node_near(grid, 1.0);
  const Past still(grid);
  CutForce cut(p.law, grid, flank_terms(p.setup));
  cut.prepare(node, grid.after[node], still.last());
  const std::array<double, 2> v = {0.02, 0.05};
  const auto at_rest = cut.response({0, 0}, {0, 0}).F;
  const auto moving = cut.response({0, 0}, v).F;
  Force sum{};
  for (std::size_t k = grid.after[node].first; k < grid.after[node].last; ++k) {
    const Stretch& stretch = grid.stretches[k];
    for (std::size_t i = stretch.first; i < stretch.first + stretch.count; ++i) {
      const double s = grid.sine[i];
      const double c = grid.cosine[i];
      const double f_r =
          c_worn * grid.width[i] * (v[0] * s + v[1] * c) / (5e-3 * p.setup.cut.Omega);
      sum[0] += -0.3 * f_r * c - f_r * s;
      sum[1] += 0.3 * f_r * s - f_r * c;
    }
  }
  ASSERT_GT(std::abs(sum[0]), 1.0);
  EXPECT_NEAR(moving[0] - at_rest[0], sum[0], 1e-9 * std::abs(sum[0]));
  EXPECT_NEAR(moving[1] - at_rest[1], sum[1], 1e-9 * std::abs(sum[0]));
}

TEST(DampedForce, MakesOfItselfWhatTheSlopesSay) {  // [T-17]
  const MotionProblem p = worn_tool();
  const EngagedGrid grid = engaged_grid(p.setup, p.grid, 500);
  const std::size_t node = node_near(grid, 0.8);
  const Past still(grid);
  CutForce cut(p.law, grid, flank_terms(p.setup));
  cut.prepare(node, grid.after[node], still.last());
  const StepCompliance compliance{{2e-8, -3e-9, 1e-8}, {2e-4, 5e-5, 1e-4}};
  const auto& [P, V] = compliance;
  const auto to = [&](double x, double y) {
    return cut.response({P[0] * x + P[1] * y, P[1] * x + P[2] * y},
                        {V[0] * x + V[1] * y, V[1] * x + V[2] * y});
  };
  const std::array<double, 4> slopes = feedback(to(0, 0), compliance);
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_NEAR(slopes[2 * row], 0.5 * (to(1, 0).F[row] - to(-1, 0).F[row]), 1e-9);
    EXPECT_NEAR(slopes[2 * row + 1], 0.5 * (to(0, 1).F[row] - to(0, -1).F[row]), 1e-9);
  }
  // Newton's step finds the force of this linear cut at once, and so does the search
  const Response start = to(0, 0);
  const NewtonStep newton(slopes);
  const double x = newton.xx * start.F[0] + newton.xy * start.F[1];
  const double y = newton.yx * start.F[0] + newton.yy * start.F[1];
  const bool solved = newton.strength > NewtonStep::mild;
  ASSERT_TRUE(solved);
  EXPECT_NEAR(to(x, y).F[0], x, 1e-9 * std::abs(x));
  const auto response_of = [&](const Force& F) { return to(F[0], F[1]); };
  const ForceBalance found = balanced_force(response_of, compliance, {}, 1e-15);
  EXPECT_NEAR(found.F[0], x, 1e-5 * std::abs(x));
  EXPECT_NEAR(found.F[1], y, 1e-5 * std::abs(x));
}

/// A tooth that leaves the cut takes the force of its flank with it.
TEST(DampedForce, GoesWithItsTooth) {  // [T-5] [T-16]
  const MotionProblem p = worn_tool();
  const EngagedGrid grid = engaged_grid(p.setup, p.grid, 500);
  const std::size_t node = node_near(grid, 1.0);
  const Past still(grid);
  CutForce cut(p.law, grid, flank_terms(p.setup));
  cut.prepare(node, grid.after[node], still.last());
  const std::array<double, 2> v = {-0.02, -0.05};
  const auto in_cut = cut.response({0, 0}, v).F;
  const auto at_rest = cut.response({0, 0}, {0, 0}).F;
  cut.watch(0, 0);
  EXPECT_TRUE(cut.crossings({1e-6, 1e-6}, v).empty());
  const auto& gone = cut.crossings({-1e-3, -1e-3}, v);
  ASSERT_EQ(gone.size(), 1U);
  for (std::size_t a = 0; a < 2; ++a) {
    const double flank = in_cut[a] - at_rest[a];
    EXPECT_NEAR(gone[0].jump[a], -flank, 1e-9 * std::abs(flank)) << a;
  }
  // No force of a flank is larger than what the search allows for
  const double most = cut.largest_jump(std::hypot(v[0], v[1]));
  EXPECT_GE(most, std::hypot(gone[0].jump[0], gone[0].jump[1]));
  EXPECT_LT(cut.largest_jump(0.0), 1e-6 * most);
}

TEST(Stepper, SpeedAtTheEndFollowsTheForceThere) {  // [T-17] [T-3]
  MotionProblem p = worn_tool();
  p.system.modes.push_back(mode_of(0.194, 1490, 0.0213, -1, 0));
  p.system.modes.push_back(mode_of(0.3, 700, 0.03, 0.6, 0.8));
  p.drive = Drive{.mode = 2, .a_0 = 1, .a_1 = 2e-3, .a_2 = 1e-6, .k_s = 1e7};
  Stepper stepper(p, std::vector<double>(10, 1e-4));
  stepper.begin(0, {3, -2, 0}, 1e-6);
  const auto still = stepper.end_speed({0, 0, 0});
  const auto x = stepper.end_speed({1, 0, 0});
  const auto y = stepper.end_speed({0, 1, 0});
  const auto& V = stepper.speed_per_force();
  EXPECT_NEAR(x[0] - still[0], V[0], 1e-12 * V[0]);
  EXPECT_NEAR(x[1] - still[1], V[1], 1e-12 * V[0]);
  EXPECT_NEAR(y[0] - still[0], V[1], 1e-12 * V[0]);
  EXPECT_NEAR(y[1] - still[1], V[2], 1e-12 * V[0]);
  stepper.accept({1, 0, 0});
  EXPECT_EQ(stepper.speed(), x);
  // A force that comes up linearly over a short step gives a mass half of its impulse
  EXPECT_NEAR(V[2], 0.5e-4 * (1 / 0.2 + 0.64 / 0.3), 0.1 * V[2]);
}

/// By what a tooth makes a disturbance grow, read from the motion.
double seen_growth(const MotionProblem& p) {
  const Motion m = motion(p);
  EXPECT_TRUE(m.finite && m.solved);
  const auto per_turn = growth_per_turn(m.once, 0.01 * p.setup.cut.f_z);
  EXPECT_TRUE(per_turn);
  return std::sqrt(per_turn.value_or(0.0));
}

/// A light tool along the feed, a little worn.
MotionProblem light_tool(double helix, double rpm) {
  MotionProblem p = worn_tool(helix);
  p.setup.process_damping.wear_land = 20e-6;
  p.setup.cut.Omega = rpm * unit::rpm;
  p.system = benchmark_system();
  p.grid.steps_per_tooth = 2000;
  return p;
}

TEST(DampedMotion, GrowsAsTheMultiplierSays) {  // [T-16] [D-30]
  for (const double helix : {0.0, 0.5}) {
    for (const double depth_mm : {0.4, 1.2}) {
      MotionProblem p = light_tool(helix, depth_mm < 1 ? 1200 : 3000);
      p.setup.cut.a_p = depth_mm * unit::mm;
      const double expected = growth(p.setup, p.law, p.system);
      const bool decays = expected < 1;
      p.start = decays ? Start::rest : Start::periodic;
      p.revolutions = 30;
      // Of second order: 1000 steps leave four times as much
      EXPECT_NEAR(seen_growth(p), expected, 6e-4) << helix << ' ' << depth_mm;
      p.setup.process_damping = {};
      EXPECT_GT(growth(p.setup, p.law, p.system), 1.1 * expected);
    }
  }
}

/// At the limit that the multiplier gives, the motion neither grows nor fades.
TEST(DampedMotion, HasTheLimitOfTheMultiplier) {  // [T-16] [D-30]
  MotionProblem p = light_tool(0.0, 1200);
  double low = 0.4e-3;
  double high = 1.2e-3;
  for (int i = 0; i < 30; ++i) {
    p.setup.cut.a_p = 0.5 * (low + high);
    (growth(p.setup, p.law, p.system, 1e-6) < 1 ? low : high) = p.setup.cut.a_p;
  }
  p.revolutions = 50;
  for (const double factor : {0.99, 1.01}) {
    MotionProblem near = p;
    near.setup.cut.a_p *= factor;
    const double seen = seen_growth(near);
    EXPECT_EQ(seen > 1, factor > 1) << factor << ": " << seen;
    EXPECT_NEAR(seen, 1, 0.05);
  }
}

TEST(DampedMotion, OfASharpEdgeIsTheSameToTheLastBit) {  // [T-16]
  MotionProblem p = worn_tool();
  p.revolutions = 2;
  p.setup.process_damping = {};
  const Motion without = motion(p);
  p.setup.process_damping = {.wear_land = 0.0, .indentation = 3e13, .friction = 0.3};
  const Motion with = motion(p);
  EXPECT_EQ(with.force, without.force);
  EXPECT_EQ(with.mode, without.mode);
  p.setup.process_damping = worn;
  EXPECT_NE(motion(p).force, without.force);
}

}  // namespace trochoid::dynamics::damped_motion_test
