#include <gtest/gtest.h>
#include <trochoid/base/units.h>
#include <trochoid/signal/pulse.h>

#include <cmath>
#include <numbers>

namespace trochoid::signal::pulse_test {

struct Made {
  std::vector<double> time;
  std::vector<double> angle;  ///< true
  std::vector<double> pulse;
};

/// 2 s at 20 kHz of a spindle that sags from 50 to 45 turns a second, with a pulse of
/// 20 degrees that rises at 0.
Made made(double lost_from = -1, double lost_to = -1) {
  Made m;
  for (int i = 0; i < 40000; ++i) {
    const double t = 2.0 + i / 20000.0;
    const double s = t - 2.0;
    const double turns = 0.37 + 50 * s - 1.25 * s * s;
    m.time.push_back(t);
    m.angle.push_back(unit::turn * turns);
    const bool lost = turns > lost_from && turns < lost_to;
    const double noise = 0.1 * std::sin(1000.0 * i);
    m.pulse.push_back((!lost && turns - std::floor(turns) < 20.0 / 360 ? 5.0 : 0.0) +
                      noise);
  }
  return m;
}

/// Largest difference from the true angle, whole turns apart.
double error(const Made& m, const PulseAngle& found) {
  double worst = 0.0;
  const double first =
      std::round((found.angle[0] - m.angle[0]) / unit::turn) * unit::turn;
  for (std::size_t i = 0; i < m.angle.size(); ++i) {
    worst = std::max(worst, std::abs(found.angle[i] - m.angle[i] - first));
  }
  return worst;
}

// A sample is 0.9 degrees, and an edge is known to one; over a turn the sag bends the
// angle by less than 0.1 degrees.
constexpr double sample = 1.0 * unit::deg;

TEST(Pulse, GivesTheAngleOfASpindleThatSags) {  // [S-7]
  const auto m = made();
  const auto found = angle_of_pulses(m.pulse, m.time);
  ASSERT_EQ(found.why, "");
  EXPECT_EQ(found.found, 95u);
  EXPECT_EQ(found.filled, 0u);
  EXPECT_LT(error(m, found), sample);
  EXPECT_NEAR(found.fastest / unit::turn, 50.0, 0.2);
  EXPECT_NEAR(found.slowest / unit::turn, 45.0, 0.2);
  // 0 at the first pulse; the sign before it.
  EXPECT_LT(found.angle.front(), 0.0);
}

TEST(Pulse, IsFilledInWhereItIsMissing) {
  const auto m = made(30.5, 33.5);
  const auto found = angle_of_pulses(m.pulse, m.time);
  ASSERT_EQ(found.why, "");
  EXPECT_EQ(found.found, 92u);
  EXPECT_EQ(found.filled, 3u);
  EXPECT_LT(error(m, found), sample);
}

TEST(Pulse, IsOneWhereNoiseCrossesTheMiddleSeveralTimes) {
  auto m = made();
  for (std::size_t i = 0; i < m.time.size(); ++i) {
    const double part = m.angle[i] / unit::turn - std::floor(m.angle[i] / unit::turn);
    const double rise = part < 0.05 ? part / 0.05 : part < 0.1 ? 1.0 : 0.0;
    m.pulse[i] = 5.0 * rise + (i % 2 == 0 ? 0.4 : -0.4);
  }
  const auto found = angle_of_pulses(m.pulse, m.time);
  ASSERT_EQ(found.why, "");
  EXPECT_EQ(found.found, 95u);
}

TEST(Pulse, IsRefusedWhereItIsNotOneATurn) {
  auto m = made();
  for (std::size_t i = 0; i < m.time.size(); ++i) {
    const double turns = m.angle[i] / unit::turn;
    if (turns > 40 && turns - std::floor(turns) > 0.3 &&
        turns - std::floor(turns) < 0.4) {
      m.pulse[i] = 5.0;  // a second pulse in each turn, not halfway
    }
  }
  EXPECT_NE(angle_of_pulses(m.pulse, m.time).why.find("they are not one a turn"),
            std::string::npos);
  // Far more turns than may be missing, however whole their number.
  std::vector<double> time = {0, 1e-9, 2e-9, 3e-9, 4e-9, 5e-9, 6e-9, 7e-9, 1e9};
  const std::vector<double> few = {0, 1, 0, 1, 0, 1, 0, 0, 1};
  EXPECT_NE(angle_of_pulses(few, time).why.find("the spindle started or stopped"),
            std::string::npos);
  // A gap of 3.5 turns is no whole number of them.
  auto gap = made(30.5, 33.5);
  for (std::size_t i = 0; i < gap.time.size(); ++i) {
    if (gap.angle[i] > 33.5 * unit::turn) gap.time[i] += 0.01;
  }
  EXPECT_NE(angle_of_pulses(gap.pulse, gap.time).why, "");
  const std::vector<double> constant(m.time.size(), 1.0);
  EXPECT_EQ(angle_of_pulses(constant, m.time).why,
            "it has 0 rising edges: at least 3 pulses are needed");
  EXPECT_THROW(angle_of_pulses(constant, std::span(m.time).first(3)),
               std::invalid_argument);
}

}  // namespace trochoid::signal::pulse_test
