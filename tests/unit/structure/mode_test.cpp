#include <gtest/gtest.h>
#include <trochoid/structure/frequency_response.h>
#include <trochoid/structure/mode.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace trochoid::structure::mode_test {

using trochoid::structure::completed;
using trochoid::structure::free_vibration;
using trochoid::structure::Mode;
using trochoid::structure::Motion;
using trochoid::structure::receptance;
using trochoid::structure::ResponseKind;

constexpr Mode table{.mass = 0.194, .stiffness = 1.7e7, .damping = 77.3};

TEST(Mode, TwoOfMassStiffnessAndFrequencyGiveTheThird) {  // [M-1]
  const double frequency = natural_frequency(table) / (2 * std::numbers::pi);
  EXPECT_NEAR(frequency, 1489.854055, 1e-6);
  const double zeta = damping_ratio(table);
  EXPECT_NEAR(zeta, 0.021282575, 1e-9);
  const std::vector<trochoid::structure::ModeGiven> ways = {
      {.mass = 0.194, .stiffness = 1.7e7, .damping_ratio = zeta},
      {.mass = 0.194, .damping = 77.3, .frequency = frequency},
      {.stiffness = 1.7e7, .frequency = frequency, .damping_ratio = zeta}};
  for (const auto& given : ways) {
    const Mode mode = completed(given);
    EXPECT_NEAR(mode.mass, 0.194, 1e-12);
    EXPECT_NEAR(mode.stiffness, 1.7e7, 1e-4);
    EXPECT_NEAR(mode.damping, 77.3, 1e-9);
  }
}

TEST(Mode, WhatContradictsOrIsOutOfRangeIsRefused) {
  EXPECT_THROW(completed({.mass = 1.0, .damping = 1.0}), std::invalid_argument);
  EXPECT_THROW(completed({.mass = 1.0, .stiffness = 1.0}), std::invalid_argument);
  EXPECT_THROW(completed({.mass = -1.0, .stiffness = 1.0, .damping = 1.0}),
               std::invalid_argument);
  EXPECT_THROW(completed({.mass = 1.0, .stiffness = 0.0, .damping = 1.0}),
               std::invalid_argument);
  EXPECT_THROW(completed({.mass = 1.0, .stiffness = 1.0, .damping = -1.0}),
               std::invalid_argument);
}

/// One Runge-Kutta step of the equation of motion, which the solution must follow.
Motion stepped(const Mode& mode, Motion s, double dt) {
  const auto slope = [&](Motion at) {
    return Motion{at.v, -(mode.stiffness * at.x + mode.damping * at.v) / mode.mass};
  };
  const auto moved = [](Motion at, Motion by, double h) {
    return Motion{at.x + h * by.x, at.v + h * by.v};
  };
  const Motion a = slope(s);
  const Motion b = slope(moved(s, a, dt / 2));
  const Motion c = slope(moved(s, b, dt / 2));
  const Motion d = slope(moved(s, c, dt));
  return {s.x + dt / 6 * (a.x + 2 * b.x + 2 * c.x + d.x),
          s.v + dt / 6 * (a.v + 2 * b.v + 2 * c.v + d.v)};
}

TEST(Mode, FreeVibrationSolvesItsEquationAtAnyDamping) {  // [M-2]
  for (const double zeta : {0.0, 0.02, 0.9999999, 1.0, 1.0000001, 3.0}) {
    const Mode mode = completed({.mass = 2.0, .stiffness = 8.0, .damping_ratio = zeta});
    Motion state{.x = 1.0, .v = -0.3};
    constexpr int steps = 4000;
    constexpr double dt = 5.0 / steps;
    for (int i = 1; i <= steps; ++i) {
      state = stepped(mode, state, dt);
      const Motion exact = free_vibration(mode, {1.0, -0.3}, i * dt);
      ASSERT_NEAR(exact.x, state.x, 1e-10) << zeta << " at " << i * dt;
      ASSERT_NEAR(exact.v, state.v, 1e-10) << zeta << " at " << i * dt;
    }
  }
}

TEST(Mode, HighDampingDoesNotOverflow) {
  const Mode mode = completed({.mass = 1.0, .stiffness = 1.0, .damping_ratio = 1e4});
  const Motion late = free_vibration(mode, {1.0, 0.0}, 1e4);
  EXPECT_NEAR(late.x, std::exp(-0.5), 1e-7);
}

TEST(Mode, ReceptanceIsStaticComplianceAtZeroAndTurnedAtResonance) {  // [M-3]
  EXPECT_DOUBLE_EQ(receptance(table, 0.0).real(), 1 / 1.7e7);
  const double omega = natural_frequency(table);
  const auto peak = receptance(table, omega);
  EXPECT_NEAR(std::arg(peak), -std::numbers::pi / 2, 1e-9);
  EXPECT_NEAR(std::abs(peak), 1 / (77.3 * omega), 1e-15);
}

TEST(Mode, MobilityAndAcceleranceAreDerivatives) {  // [M-4]
  // Position, speed and acceleration of x = Re(e^{i w t}) at t = 0.1.
  const double w = 3.0;
  const std::complex<double> turn = std::polar(1.0, w * 0.1);
  EXPECT_NEAR((factor(ResponseKind::receptance, w) * turn).real(), std::cos(0.3),
              1e-15);
  EXPECT_NEAR((factor(ResponseKind::mobility, w) * turn).real(), -3 * std::sin(0.3),
              1e-14);
  EXPECT_NEAR((factor(ResponseKind::accelerance, w) * turn).real(), -9 * std::cos(0.3),
              1e-14);
}

}  // namespace trochoid::structure::mode_test
