#include "milling_cut.h"

#include <trochoid/dynamics/growth.h>
#include <trochoid/dynamics/motion.h>
#include <trochoid/dynamics/stepper.h>
#include <trochoid/force/forces.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>

/// The motion against what is known without it: analytic solutions, energy, forces of a
/// rigid cut, multipliers.
namespace trochoid::dynamics::motion_checks_test {

namespace {

constexpr double turn = 2 * pi;

MotionProblem two_axes() {
  MotionProblem p;
  p.setup = straight_cut(2, geometry::Slot{});
  p.setup.chip = {chip::Model::radial, chip::Lookback::all};
  p.setup.cut.Omega = 20 * turn;
  p.law = force::LinearEdge{.K_tc = 800e6, .K_rc = 300e6};
  p.system.modes = {{0.0324, 25.5, 8e6, 1, 0}, {0.0324, 25.5, 6e6, 0, 1}};
  p.revolutions = 3;
  return p;
}

double largest_difference(const Motion& a, const Motion& b) {
  double largest = 0.0;
  for (std::size_t r = 0; r < a.mode.size(); ++r) {
    for (std::size_t i = 0; i < a.mode[r].size(); ++i) {
      largest = std::max(largest, std::abs(a.mode[r][i] - b.mode[r][i]));
    }
  }
  return largest;
}

/// How much nearer four times the steps come to a fine answer.
double gain_of_four(MotionProblem p, int steps) {
  p.revolutions = 2;
  p.kept = 2;
  p.samples_per_rev = 120;
  const auto with = [&](int n) {
    p.grid.steps_per_tooth = n;
    return motion(p);
  };
  const Motion fine = with(32 * steps);
  return largest_difference(with(steps), fine) /
         largest_difference(with(4 * steps), fine);
}

void expect_forces(const MotionProblem& p, double tolerance) {
  const Motion m = motion(p);
  ASSERT_TRUE(m.finite && m.solved);
  // Where an edge force jumps either side will do.
  std::array<std::vector<force::Vector3>, 3> want;
  for (const int side : {-1, 0, 1}) {
    std::vector<double> phi = m.angle;
    for (double& angle : phi) {
      angle += side * 1e-7;
    }
    want[static_cast<std::size_t>(side + 1)] =
        force::forces(p.setup, p.law, phi, 1e-10);
  }
  double peak = 0.0;
  for (const auto& F : want[1]) {
    peak = std::max(peak, std::hypot(F[0], F[1], F[2]));
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < m.angle.size(); ++i) {
    double off = peak;
    for (const auto& side : want) {
      off = std::min(off,
                     std::hypot(m.force[i][0] - side[i][0], m.force[i][1] - side[i][1],
                                m.force[i][2] - side[i][2]));
    }
    worst = std::max(worst, off);
  }
  EXPECT_LT(worst, tolerance * peak);
}

struct RigidCase {
  int teeth = 1;
  chip::Model model = chip::Model::radial;
  double helix = 0.0;
  geometry::Engagement engagement;
};

class RigidMotion : public testing::TestWithParam<int> {};

}  // namespace

/// Every cutter of 1 to 6 teeth, pitch, model, engagement and law: a structure that
/// does not yield feels what `simulate` computes.
TEST_P(RigidMotion, HasTheForcesOfSimulate) {  // [T-1] [T-4]
  const int teeth = GetParam();
  const geometry::Engagement engagements[] = {
      geometry::Slot{}, geometry::UpMilling{1e-3}, geometry::DownMilling{1.5e-3},
      geometry::Band{-1e-3, 2.5e-3}};
  for (const int model : {0, 1, 2, 3}) {
    for (const auto& engagement : engagements) {
      for (const double helix : {0.0, 0.5}) {
        SCOPED_TRACE(testing::Message() << "model " << model << ", engagement "
                                        << engagement.index() << ", helix " << helix);
        MotionProblem p = two_axes();
        p.setup.cutter.profile = geometry::cylinder(8e-3);
        p.setup.cutter.pitch = teeth == 3 ? std::vector<double>{1.9, 2.2, turn - 4.1}
                                          : geometry::equal_pitch(teeth);
        p.setup.cutter.helix = helix;
        for (int j = 0; j < teeth; ++j) {
          p.setup.runout.radial_offsets.push_back((j % 2 == 0 ? 4e-6 : -5e-6) *
                                                  (1 + 0.1 * j));
        }
        p.setup.cut.engagement = engagement;
        p.setup.cut.a_p = 2e-3;
        p.setup.chip.model = static_cast<chip::Model>(model);
        const bool power = (teeth + model) % 2 == 0;
        if (power) {
          p.law = force::Power{.K_t1 = 900e6,
                               .K_r1 = 300e6,
                               .K_a1 = 100e6,
                               .m_t = 0.3,
                               .m_r = 0.4,
                               .m_a = 0.2};
        } else {
          p.law = force::LinearEdge{.K_tc = 800e6,
                                    .K_rc = 300e6,
                                    .K_ac = 100e6,
                                    .K_te = 5e3,
                                    .K_re = 3e3,
                                    .K_ae = 1e3};
        }
        for (ChipMode& mode : p.system.modes) {
          mode.stiffness *= 1e8;
          mode.damping *= 1e4;
        }
        p.grid.steps_per_tooth = 60;
        p.samples_per_rev = 180;
        p.revolutions = 3;
        expect_forces(p, helix == 0 ? 2e-7 : (power ? 3e-6 : 1e-6));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfTeeth, RigidMotion, testing::Range(1, 7));

TEST(Motion, EccentricHelixHasTheForcesOfSimulate) {  // [T-1]
  for (const bool edge : {false, true}) {
    MotionProblem p = two_axes();
    p.setup.cutter.helix = 0.5;
    p.setup.runout = {{4e-6, -5e-6}, 6e-6, 0.7, geometry::EccentricityOrder::exact};
    p.setup.chip.model = chip::Model::trochoidal;
    p.setup.cut.a_p = 2e-3;
    p.law = force::LinearEdge{.K_tc = 800e6, .K_rc = 300e6, .K_te = edge ? 5e3 : 0.0};
    for (ChipMode& mode : p.system.modes) {
      mode.stiffness *= 1e8;
      mode.damping *= 1e4;
    }
    p.grid.steps_per_tooth = 100;
    expect_forces(p, 1e-4);
  }
}

/// Table and actuator against their transfer functions, for every coupling: all of the
/// table's stiffness is the actuator's (M0), or a part (M1), damped or not.
TEST(Motion, FollowsASineAsItsTransferFunctionSays) {  // [T-2] [T-3]
  using Complex = std::complex<double>;
  const double k = 1.7e7;
  const double c = 77.3;
  const double m = 0.194;
  for (const double share : {1.0, 0.9}) {
    for (const bool damped : {false, true}) {
      MotionProblem p = two_axes();
      p.law = force::LinearEdge{};
      p.system.modes.push_back({m, c, k, -1, 0});
      const Drive d{2,       1 / 0.99536, 2.27e-3,
                    1.29e-6, share * k,   damped ? share * c : 0.0};
      p.drive = d;
      p.revolutions = 12;
      const double omega = p.setup.cut.Omega;
      p.command = [omega](double t) { return 13e-6 * std::cos(3 * omega * t); };
      const Motion got = motion(p);
      const Complex s(0, 3 * omega);
      const Complex actuator = 13e-6 / (d.a_2 * s * s + d.a_1 * s + d.a_0);
      const Complex table = actuator * (d.k_s + d.c_s * s) / (m * s * s + c * s + k);
      // A command that stands still over a step is smaller by (omega dt)^2 / 24.
      const double dt = 0.025 / 1000;
      const double allowed = 1.5 * std::pow(std::abs(s) * dt, 2) / 24 * 13e-6;
      for (std::size_t i = 0; i < got.time.size(); ++i) {
        const Complex turned = std::exp(s * got.time[i]);
        EXPECT_NEAR(got.actuator[i], (actuator * turned).real(), allowed);
        EXPECT_NEAR(got.mode[2][i], (table * turned).real(), allowed);
      }
    }
  }
}

/// Kinetic and potential energy, and what damping took, are the work of cut and
/// actuator, the better the finer the steps.
TEST(Motion, EnergyComesFromForcesOnly) {  // [T-4]
  const auto imbalance = [](int steps) {
    MotionProblem p = two_axes();
    p.setup.cut.a_p = 0.4e-3;
    p.setup.runout.radial_offsets = {3e-6, -3e-6};
    p.system.modes.push_back({0.194, 77.3, 1.7e7, -1, 0});
    const double k_s = 1.5e7;
    p.drive = Drive{2, 1.0, 2.27e-3, 1.29e-6, k_s, 0.0};
    p.command = [](double t) { return 5e-6 * std::sin(300 * t); };
    p.grid.steps_per_tooth = steps;
    p.revolutions = 2;
    p.kept = 2;
    p.samples_per_rev = 20000;
    const Motion m = motion(p);
    const double dt = m.time[1] - m.time[0];
    const auto energy = [&](std::size_t i) {
      double sum = 0.0;
      for (std::size_t r = 0; r < 3; ++r) {
        const ChipMode& mode = p.system.modes[r];
        sum += 0.5 * mode.mass * m.speed[r][i] * m.speed[r][i] +
               0.5 * mode.stiffness * m.mode[r][i] * m.mode[r][i];
      }
      return sum;
    };
    const auto power = [&](std::size_t i) {
      double sum = k_s * m.actuator[i] * m.speed[2][i];
      for (std::size_t r = 0; r < 3; ++r) {
        const ChipMode& mode = p.system.modes[r];
        sum += (mode.x * m.force[i][0] + mode.y * m.force[i][1]) * m.speed[r][i] -
               mode.damping * m.speed[r][i] * m.speed[r][i];
      }
      return sum;
    };
    double balance = energy(0);
    double largest = 0.0;
    double worst = 0.0;
    for (std::size_t i = 0; i + 1 < m.time.size(); ++i) {
      balance += 0.5 * dt * (power(i) + power(i + 1));
      largest = std::max(largest, energy(i + 1));
      worst = std::max(worst, std::abs(energy(i + 1) - balance));
    }
    return worst / largest;
  };
  const double coarse = imbalance(250);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_LT(imbalance(1000), coarse / 10);
}

TEST(Motion, AFreeStructureOnlyLosesEnergy) {  // [T-3]
  MotionProblem p = two_axes();
  for (const double dt : {1e-6, 2.5e-5, 1e-3, 0.5}) {
    const double steps[] = {dt};
    Stepper stepper(p, steps);
    const auto energy = [&] {
      const Snapshot z = stepper.snapshot();
      double sum = 0.0;
      for (std::size_t r = 0; r < z.size(); ++r) {
        const ChipMode& m = p.system.modes[r];
        sum += 0.5 * m.stiffness * z[r][0] * z[r][0] + 0.5 * m.mass * z[r][1] * z[r][1];
      }
      return sum;
    };
    stepper.begin(0, {}, 0.0);
    stepper.accept({100, -50, 0});
    stepper.begin(0, {100, -50, 0}, 0.0);
    stepper.accept({});
    double last = energy();
    EXPECT_GT(last, 0.0);
    for (int i = 0; i < 1000; ++i) {
      stepper.begin(0, {}, 0.0);
      stepper.accept({});
      EXPECT_LE(energy(), last * (1 + 1e-12));
      last = energy();
    }
  }
}

/// A disturbance of a motion that repeats grows in time as the multiplier says.
TEST(Motion, GrowsAsTheMultiplierSays) {  // [T-4] [D-11]
  for (const double depth_mm : {0.2, 0.5, 1.0, 2.0}) {
    MotionProblem p;
    p.setup = straight_cut(2, geometry::Slot{});
    p.setup.cut.a_p = depth_mm * unit::mm;
    p.setup.chip = {chip::Model::radial, chip::Lookback::all};
    p.law = benchmark_law();
    p.system = benchmark_system();
    p.grid.steps_per_tooth = 1000;
    // One that decays shows while it is still there; one that grows, before a tooth
    // leaves the cut.
    const bool decays = depth_mm < 0.3;
    p.start = decays ? Start::rest : Start::periodic;
    p.revolutions = decays ? 24 : 18;
    const Motion m = motion(p);
    const auto per_turn = growth_per_turn(m.once, 0.01 * p.setup.cut.f_z);
    ASSERT_TRUE(per_turn) << depth_mm;
    EXPECT_NEAR(std::sqrt(*per_turn), growth(p.setup, p.law, p.system), 1e-3)
        << depth_mm;
  }
}

TEST(Motion, APeriodicStartIsTheMotionThatStays) {  // [T-7]
  MotionProblem p = two_axes();
  p.setup.cut.a_p = 0.1e-3;
  p.start = Start::periodic;
  p.revolutions = 2;
  const Motion at_once = motion(p);
  EXPECT_LT(at_once.last_change, 1e-8 * at_once.peak);
  EXPECT_TRUE(repeats_every_turn(at_once));
  p.start = Start::rest;
  p.revolutions = 120;
  const Motion in_the_end = motion(p);
  EXPECT_LT(largest_difference(at_once, in_the_end), 1e-12);
}

/// Short teeth enter where no node is, and every tooth is thrown out by vibration.
TEST(Motion, EdgeForcesThatComeAndGoKeepTheOrder) {  // [T-3] [T-5]
  for (const bool equal : {true, false}) {
    for (const bool slot : {true, false}) {
      MotionProblem p = two_axes();
      p.setup.cutter.pitch =
          equal ? geometry::equal_pitch(2) : std::vector<double>{2.9, turn - 2.9};
      if (!slot) {
        p.setup.cut.engagement = geometry::DownMilling{2e-3};
      }
      p.setup.cut.a_p = 0.3e-3;
      p.setup.cut.f_z = 0.01e-3;
      p.setup.runout.radial_offsets = {3e-6, -3e-6};
      p.law = force::LinearEdge{.K_tc = 800e6, .K_rc = 300e6, .K_te = 500, .K_re = 300};
      p.system.modes = {{0.0324, 25.5, 1e6, 1, 0}, {0.0324, 25.5, 1.2e6, 0, 1}};
      EXPECT_GT(gain_of_four(p, 200), 8) << equal << slot;
    }
  }
}

TEST(Motion, OfNearlyEqualPitchesIsThatOfEqualOnes) {  // [T-1]
  MotionProblem p = two_axes();
  p.setup.cut.a_p = 0.2e-3;
  p.setup.runout.radial_offsets = {3e-6, -2e-6, 0};
  p.setup.cutter.pitch = geometry::equal_pitch(3);
  const Motion equal = motion(p);  // delays are whole steps
  p.setup.cutter.pitch = {turn / 3 + 1e-6, turn / 3 - 1e-6, turn / 3};
  const Motion nearly = motion(p);  // delays are between the nodes
  EXPECT_LT(largest_difference(equal, nearly), 3e-11);
  EXPECT_GT(*std::max_element(equal.mode[1].begin(), equal.mode[1].end()), 1e-6);
}

/// A mass that the force moves by more than the chip within one step.
TEST(Motion, AMassWithoutInertiaStillHasAForceThatAgrees) {  // [T-4] [T-6]
  for (const bool power : {false, true}) {
    MotionProblem p = two_axes();
    p.setup.cut.a_p = 2e-3;
    if (power) {
      p.law = force::Power{.K_t1 = 900e6, .K_r1 = 300e6, .m_t = 0.3, .m_r = 0.3};
    } else {
      p.law = force::LinearEdge{.K_tc = 800e6, .K_rc = 300e6};
    }
    // Springs with hardly any mass, and so much damping that nothing rings
    p.system.modes = {{1e-9, 20, 4e6, 1, 0}, {1e-9, 20, 4e6, 0, 1}};
    p.grid.steps_per_tooth = 100;
    p.revolutions = 10;
    const Motion m = motion(p);
    EXPECT_TRUE(m.finite && m.solved) << power;
    EXPECT_TRUE(repeats_every_turn(m)) << power << ' ' << m.last_change;
    // A fixed point would need dF/dq times the yielding in a step to be below one.
    const double step = turn / 2 / 100 / p.setup.cut.Omega;
    EXPECT_GT(800e6 * 2e-3 * step / 20 / 2, 9.9);
  }
}

TEST(Motion, StepsFollowTheFastestModeThatMoves) {
  MotionProblem p = two_axes();
  EXPECT_NEAR(steps_needed(p), 20 * std::sqrt(8e6 / 0.0324) / turn * 0.025, 1);
  p.system.modes[0].mass = 0.1;
  p.system.modes[1].mass = 0.1;
  EXPECT_EQ(steps_needed(p), 1000);
  p.system.modes[0] = {1e-4, 1.0, 8e6, 1, 0};  // 45 kHz
  const double frequency = std::sqrt(8e6 / 1e-4) / turn;
  EXPECT_NEAR(steps_needed(p), 20 * frequency * 0.025, 1);
  p.system.modes[0].stiffness = 8e14;  // nothing that cuts moves it
  EXPECT_EQ(steps_needed(p), 1000);
  p.system.modes[0] = {1e-9, 1.0, 8e6, 1, 0};
  EXPECT_GT(steps_needed(p), 100000);
  p.system.modes[0].mass = 1e-12;
  EXPECT_THROW(motion(p), std::invalid_argument);
}

TEST(Motion, WithoutFeedNothingIsCut) {
  MotionProblem p = two_axes();
  p.setup.cut.f_z = 0;
  p.setup.runout.radial_offsets = {10e-6, -10e-6};
  const Motion m = motion(p);
  EXPECT_EQ(m.peak, 0.0);
}

}  // namespace trochoid::dynamics::motion_checks_test
