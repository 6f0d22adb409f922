#include "paper_case.h"

#include <trochoid/correction/equal_flutes.h>
#include <trochoid/correction/spindle_speed.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace trochoid::correction::spindle_speed_test {

namespace {

constexpr double Omega = 1200 * unit::rpm;
constexpr SpindleDrive strong{.inertia = 5e-4, .torque = 1e3};

RigidCut eccentric(double e, int teeth) {
  std::vector<double> rho;
  for (int j = 0; j < teeth; ++j) {
    rho.push_back(e * std::cos(unit::turn * j / teeth + 0.4));
  }
  return {slot_with(rho), ordinary_law()};
}

PeriodicMotion sine_for(const RigidCut& cut) {
  return table_motion(cut, Shape::sine, {});
}

}  // namespace

TEST(SpindleSpeed, IsRightForAnEccentricity) {
  const RigidCut cut = eccentric(6e-6, 4);
  EXPECT_GT(peak_difference(cut.peaks(Harmonics{})), 0.1);
  const SpeedModulation m = speed_modulation(cut, sine_for(cut), strong, Omega);
  EXPECT_EQ(m.part, 1.0);
  EXPECT_TRUE(m.limit.empty());
  EXPECT_LT(m.peak_difference, 0.5 * peak_difference(cut.peaks(Harmonics{})));
}

TEST(SpindleSpeed, DoesNotHelpWhatIsNoEccentricity) {
  const RigidCut cut(slot_with({8e-6, -8e-6, 8e-6, -8e-6}), ordinary_law());
  Harmonics sine;
  sine.c = {{0.0, -8e-6}};
  const double before = peak_difference(cut.peaks(Harmonics{}));
  EXPECT_GT(speed_modulation(cut, sine, strong, Omega).peak_difference, before);
}

/// The turn takes as long as before, and the tool is late by what the table would move.
TEST(SpindleSpeed, MakesTheToolLateByTheMotion) {
  const RigidCut cut = eccentric(6e-6, 3);
  const PeriodicMotion X = sine_for(cut);
  const SpeedModulation m = speed_modulation(cut, X, strong, Omega);
  const double step = unit::turn / static_cast<double>(m.angle.size());
  double time = 0.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < m.angle.size(); ++i) {
    const double fed = cut.feed() * Omega / unit::turn * time;
    const double along = cut.feed() * m.angle[i] / unit::turn;
    worst = std::max(
        worst, std::abs((along - fed) - (place_at(X, m.angle[i]) - place_at(X, 0.0))));
    const double next = m.speed[(i + 1) % m.speed.size()];
    time += step * (1 / m.speed[i] + 1 / next) / 2;
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_NEAR(time, unit::turn / Omega, 1e-9);
}

TEST(SpindleSpeed, AsksForTheTorqueOfTheInertiaAndTheCut) {
  const RigidCut cut = eccentric(6e-6, 3);
  const PeriodicMotion X = sine_for(cut);
  const auto torque = [&](double inertia) {
    return speed_modulation(cut, X, {inertia, 1e3}, Omega).torque_at;
  };
  const SpeedModulation m = speed_modulation(cut, X, {1e-3, 1e3}, Omega);
  const auto of_cut = torque(1e-12);
  for (std::size_t i = 1; i + 1 < m.angle.size(); i += 37) {
    const double dphi = m.angle[i + 1] - m.angle[i - 1];
    const double inertia = 1e-3 * m.speed[i] * (m.speed[i + 1] - m.speed[i - 1]) / dphi;
    EXPECT_NEAR(m.torque_at[i] - of_cut[i], inertia, 1e-3 * std::abs(m.torque));
  }
  // The work of the cut over a turn: a few tenths of a newton metre, against it.
  const double mean = std::accumulate(of_cut.begin(), of_cut.end(), 0.0) /
                      static_cast<double>(of_cut.size());
  EXPECT_GT(mean, 0.05);
  EXPECT_LT(mean, 2.0);
}

TEST(SpindleSpeed, TakesNoMoreThanTheTorqueAllows) {
  const RigidCut cut = eccentric(6e-6, 3);
  const PeriodicMotion X = sine_for(cut);
  const SpeedModulation all = speed_modulation(cut, X, strong, Omega);
  const SpeedModulation none = speed_modulation(cut, X, {5e-4, 1e-3}, Omega);
  EXPECT_NEAR(none.part, 0.0, 1e-6);
  EXPECT_NE(none.limit.find("cut alone"), std::string::npos);
  const double half = (all.torque + none.torque) / 2;
  const SpeedModulation some = speed_modulation(cut, X, {5e-4, half}, Omega);
  EXPECT_GT(some.part, 0.1);
  EXPECT_LT(some.part, 0.95);
  EXPECT_LE(some.torque, half);
  EXPECT_EQ(some.limit, "the torque of the spindle");
  EXPECT_NEAR(some.torque_wanted, all.torque, 1e-12);
  EXPECT_GT(some.peak_difference, all.peak_difference);
}

TEST(SpindleSpeed, CannotTurnBack) {
  const RigidCut cut = eccentric(40e-6, 3);  // more than the feed a turn over 2 pi
  const SpeedModulation m = speed_modulation(cut, sine_for(cut), strong, Omega);
  EXPECT_LT(m.part, 1.0);
  EXPECT_TRUE(std::isinf(m.torque_wanted));
  EXPECT_NE(m.limit.find("feed"), std::string::npos);
  EXPECT_LT(m.speed_change, 9.1);
}

}  // namespace trochoid::correction::spindle_speed_test
