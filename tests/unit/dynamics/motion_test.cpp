#include <trochoid/base/units.h>
#include <trochoid/dynamics/cut_force.h>
#include <trochoid/dynamics/make_grid.h>
#include <trochoid/dynamics/motion.h>
#include <trochoid/dynamics/power_of.h>
#include <trochoid/dynamics/propagator.h>
#include <trochoid/dynamics/stepper.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace trochoid::dynamics::motion_test {

namespace {

constexpr double turn = 2 * std::numbers::pi;

/// The small tool of the paper on runout correction: 8 mm, two teeth, 26 um apart.
MotionProblem small_tool() {
  MotionProblem p;
  p.setup.cutter = {.profile = geometry::cylinder(8e-3),
                    .pitch = geometry::equal_pitch(2),
                    .lag_diameter = 8e-3};
  p.setup.runout.radial_offsets = {13e-6, -13e-6};
  p.setup.cut = {geometry::Slot{}, 1e-3, 0.05e-3, 20 * turn};
  p.setup.chip.model = chip::Model::radial;
  p.law = force::LinearEdge{.K_tc = 800e6, .K_rc = 300e6, .K_te = 5e3, .K_re = 3e3};
  p.system.modes = {{0.0324, 25.5, 8e6, 1, 0},
                    {0.0324, 25.5, 8e6, 0, 1},
                    {0.194, 77.3, 1.7e7, -1, 0}};
  p.revolutions = 6;
  p.grid.steps_per_tooth = 500;
  return p;
}

MotionProblem without_cutting() {
  MotionProblem p = small_tool();
  p.law = force::LinearEdge{};
  return p;
}

}  // namespace

TEST(PowerOf, IsThePower) {
  for (const double p : {-0.9, -0.598, -0.28, 0.4, 0.5, 1.5}) {
    for (double u = 1e-12; u < 40; u *= 1.00037) {
      ASSERT_NEAR(power_of(u, p) / std::pow(u, p), 1.0, 2e-14) << u << ' ' << p;
    }
    EXPECT_EQ(power_of(1.0, p), 1.0);
  }
}

TEST(PowerOf, NearAnotherIsThePower) {
  for (const double m : {-0.5, 0.0, 0.28, 0.598, 0.97}) {
    NearPower near(m, 2);
    for (double h = 1e-9; h < 1e-3; h *= 1.0013) {
      // Two teeth whose chips differ: each has its own
      ASSERT_NEAR(near(0, h) / std::pow(h / 1e-3, -m), 1.0, 1e-12) << h << ' ' << m;
      ASSERT_NEAR(near(1, 3 * h) / std::pow(3 * h / 1e-3, -m), 1.0, 1e-12);
    }
  }
}

TEST(Propagator, OfAFastModeOverALongStepDies) {  // [T-3]
  // A decay of many decades within a step must not leave rounding that grows.
  const double m = 0.03;
  const double k = 8e14;
  const double c = 0.05 * std::sqrt(k * m);
  const std::array<double, 4> A = {0, 1, -k / m, -c / m};
  const std::array<double, 2> B = {0, 1 / m};
  const Propagator p = propagator(A, B, 2, 1e-3);
  for (const std::size_t i : {0U, 3U}) {
    EXPECT_LT(std::abs(p.Phi[i]), 1e-6);
  }
  EXPECT_NEAR(p.G_0[0] + p.G_1[0], 1 / k, 1e-9 / k);  // it stands where it is pushed
}

TEST(Propagator, FollowsALinearForceExactly) {  // [T-3]
  const double m = 0.2;
  const double c = 80.0;
  const double k = 2e7;
  const std::array<double, 4> A = {0, 1, -k / m, -c / m};
  const std::array<double, 2> B = {0, 1 / m};
  constexpr double dt = 3e-4;
  const Propagator p = propagator(A, B, 2, dt);
  // z = (a + b t, b) solves m x'' + c x' + k x = f with f = c b + k (a + b t).
  const double a = 2e-6;
  const double b = 0.01;
  const double f_0 = c * b + k * a;
  const double f_1 = f_0 + k * b * dt;
  for (std::size_t i = 0; i < 2; ++i) {
    const double got =
        p.Phi[2 * i] * a + p.Phi[2 * i + 1] * b + p.G_0[i] * f_0 + p.G_1[i] * f_1;
    EXPECT_NEAR(got, i == 0 ? a + b * dt : b, i == 0 ? 1e-15 : 1e-10) << i;
  }
}

TEST(Motion, WithoutCuttingTheActuatorStepsAsItsPolesSay) {  // [T-2]
  MotionProblem p = without_cutting();
  const double K_0 = 0.99536;
  const double T = 1.134e-3;  // twice the same, a little above the paper's pair
  p.drive = Drive{2, 1 / K_0, 2 * T / K_0, T * T / K_0, 1.7e7, 77.3};
  p.command = [](double) { return 6e-6; };
  p.kept = 6;
  const Motion m = motion(p);
  ASSERT_EQ(m.time.size(), 6U * 720U);
  for (std::size_t i = 0; i < m.time.size(); i += 37) {
    const double u = m.time[i] / T;
    EXPECT_NEAR(m.actuator[i], 6e-6 * K_0 * (1 - (1 + u) * std::exp(-u)), 2e-11) << i;
  }
  // The table is a stiff follower: in the end it stands where the actuator stands.
  EXPECT_NEAR(m.mode[2].back(), 6e-6 * K_0, 1e-11);
}

TEST(Motion, AControllerSeesEveryStepInOrderAndIsAskedOnce) {
  MotionProblem p = small_tool();
  p.drive = Drive{2, 1.0, 2e-3, 1e-6, 1.7e7, 77.3};
  p.revolutions = 3;
  std::vector<double> asked;
  std::vector<double> seen;
  std::vector<double> tables;
  std::vector<Force> forces;
  p.command = [&](double t) {
    asked.push_back(t);
    return 5e-6;
  };
  p.observe = [&](double t, const Force& F, double table) {
    seen.push_back(t);
    forces.push_back(F);
    tables.push_back(table);
  };
  const Motion m = motion(p);
  ASSERT_EQ(asked.size(), seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_LT(seen[i], asked[i]);
    if (i > 0) {
      EXPECT_LT(asked[i - 1], seen[i]);
    }
  }
  EXPECT_EQ(seen.front(), 0.0);
  EXPECT_EQ(tables.front(), 0.0);
  EXPECT_GT(tables.back(), 1e-6);
  const auto turns = static_cast<std::size_t>(p.revolutions);
  ASSERT_EQ(seen.size() % turns, 0U);
  const std::size_t last_turn = seen.size() / turns * (turns - 1);
  EXPECT_NEAR(tables[last_turn], m.mode[2].front(), 1e-12);
  EXPECT_NEAR(forces[last_turn][1], m.force.front()[1], 1e-9);
  for (const double c : m.command) {
    EXPECT_NEAR(c, 5e-6, 1e-20);
  }
}

TEST(Motion, ACommandThatJumpsAtANodeActsFromThere) {  // [T-2]
  MotionProblem p = without_cutting();
  const double T = 1.2e-3;
  p.drive = Drive{2, 1.0, 2 * T, T * T, 1.7e7, 77.3};
  p.revolutions = 1;
  const double half = 0.025;  // a node: half a turn
  p.command = [half](double t) { return t < half ? 0.0 : 6e-6; };
  const Motion m = motion(p);
  for (std::size_t i = 0; i < m.time.size(); i += 7) {
    const double u = std::max(0.0, (m.time[i] - half) / T);
    EXPECT_NEAR(m.actuator[i], 6e-6 * (1 - (1 + u) * std::exp(-u)), 2e-12) << i;
  }
}

TEST(Motion, TheStepIsOfSecondOrder) {  // [T-3]
  const auto motion_with = [](int steps) {
    MotionProblem p = small_tool();
    p.setup.runout = {};
    p.setup.cut.a_p = 0.2e-3;  // it settles: one that grows has no order
    p.law = force::LinearEdge{.K_tc = 800e6, .K_rc = 300e6};
    p.grid.steps_per_tooth = steps;
    p.samples_per_rev = 60;
    return motion(p).mode;
  };
  const auto fine = motion_with(6400);
  const auto off = [&](int steps) {
    const auto got = motion_with(steps);
    double largest = 0.0;
    for (std::size_t r = 0; r < got.size(); ++r) {
      for (std::size_t i = 0; i < got[r].size(); ++i) {
        largest = std::max(largest, std::abs(got[r][i] - fine[r][i]));
      }
    }
    return largest;
  };
  const double a = off(200);
  EXPECT_LT(off(400), 0.4 * a);
  EXPECT_LT(off(800), 0.12 * a);
}

TEST(Motion, APushInwardMakesTheChipThinner) {  // [T-1]
  const MotionProblem p = small_tool();
  const EngagedGrid grid = engaged_grid(p.setup, {}, 100);
  CutForce cut(p.law, grid);
  const std::vector<double> zero(grid.memory() + 1, 0.0);
  const double* still = &zero.back();
  const History past{still, still, still, still};
  const std::size_t middle = grid.pitch / 2;  // theta is 90 degrees: outward is +x
  ASSERT_NEAR(grid.angle[middle], turn / 4, 0.05);
  cut.prepare(middle, grid.after[middle], past);
  EXPECT_LT(cut.chips(-1e-6, 0)[0].second, cut.chips(0, 0)[0].second);
  EXPECT_GT(cut.response(-1e-6, 0).F[0],
            cut.response(0, 0).F[0]);  // less push, F_x is negative
}

TEST(Motion, SoftToolChattersAndIsSaidTo) {
  MotionProblem p = small_tool();
  p.setup.cut.a_p = 3e-3;
  for (ChipMode& mode : p.system.modes) {
    mode.stiffness /= 40;
  }
  p.revolutions = 30;
  const Motion m = motion(p);
  EXPECT_TRUE(!m.finite || m.last_change > 1.0);
}

/// The chips of a power law begin with an infinite slope: a force is found all the same,
/// whether the cut settles, stays bounded or runs away.
TEST(Motion, AlwaysFindsTheForceOfATouchingTooth) {  // [T-12]
  for (const double a_e : {0.5e-3, 1.99e-3, 2e-3, 2.01e-3, 4e-3}) {
    for (const double rpm : {60.0, 300.0, 1200.0, 9000.0}) {
      for (const double soft : {1.0, 40.0}) {
        MotionProblem p = small_tool();
        p.setup.cut.engagement = geometry::DownMilling{a_e};
        p.setup.cut.Omega = rpm * unit::rpm;
        for (ChipMode& mode : p.system.modes) {
          mode.stiffness /= soft;
        }
        p.revolutions = rpm < 500 ? 2 : 20;
        EXPECT_TRUE(motion(p).solved) << a_e << " m, " << rpm << " rpm, /" << soft;
      }
    }
  }
}

TEST(Motion, TheLongFluteTakesWhatTheShortOneLeaves) {  // [T-1]
  MotionProblem p = small_tool();
  for (ChipMode& mode : p.system.modes) {
    mode.stiffness *= 1e8;
    mode.damping *= 1e4;
  }
  const Motion m = motion(p);
  ASSERT_EQ(m.flutes.size(), 2U);
  const double both = m.flutes[0].chip_area + m.flutes[1].chip_area;
  EXPECT_NEAR(both, 4 * 0.05e-3, 1e-3 * both);  // all that there is
  EXPECT_GT(m.flutes[0].chip_area, 3 * m.flutes[1].chip_area);
}

TEST(Motion, TellsOfEveryRevolution) {
  MotionProblem p = small_tool();
  std::vector<int> told;
  p.turned = [&](int done) { told.push_back(done); };
  p.revolutions = 3;
  motion(p);
  EXPECT_EQ(told, (std::vector<int>{1, 2, 3}));
}

TEST(EngagedGrid, RefusesWhatItCannotShift) {
  MotionProblem p = small_tool();
  p.setup.cutter.profile = geometry::ball(8e-3);
  EXPECT_THROW(engaged_grid(p.setup, {}, 1000), std::invalid_argument);
}

}  // namespace trochoid::dynamics::motion_test
