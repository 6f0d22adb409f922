#include <trochoid/signal/foreign_line.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trochoid::signal::foreign_line_test {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double rate = 1e4;
constexpr double spindle = 47.3;  // [Hz]

/// Two teeth and a vibration.
std::array<std::vector<double>, 3> made(double frequency, double amplitude) {
  std::mt19937 random(7);
  std::normal_distribution<double> white(0.0, 5.0);
  std::array<std::vector<double>, 3> out;
  for (int i = 0; i < 12000; ++i) {
    const double t = i / rate;
    const double phi = turn * spindle * t;
    out[0].push_back(300.0 + 200.0 * std::abs(std::sin(phi)) + white(random));
    out[1].push_back(100.0 * std::cos(2.0 * phi) + 10.0 * std::cos(phi) +
                     white(random) + amplitude * std::cos(turn * frequency * t));
    out[2].push_back(white(random));
  }
  return out;
}

// [S-11]
TEST(ForeignLine, IsToldByItsFrequency) {
  const auto chatter = foreign_line(made(812.0, 30.0), rate, turn * spindle);
  ASSERT_TRUE(chatter);
  EXPECT_EQ(chatter->channel, 1u);
  EXPECT_NEAR(chatter->frequency, 812.0, 0.5);
  EXPECT_NEAR(chatter->share, 30.0 / std::sqrt(2.0) / 96.0, 0.03);
}

TEST(ForeignLine, IsNoneOfACutThatOnlyTurns) {
  EXPECT_FALSE(foreign_line(made(812.0, 0.0), rate, turn * spindle));
  EXPECT_FALSE(foreign_line(made(812.0, 2.0), rate, turn * spindle)) << "of 3 %";
  EXPECT_FALSE(foreign_line(made(10.0 * spindle, 30.0), rate, turn * spindle));
  EXPECT_FALSE(foreign_line({}, rate, turn * spindle));
}

}  // namespace trochoid::signal::foreign_line_test
