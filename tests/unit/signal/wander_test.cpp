#include <trochoid/signal/wander.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trochoid::signal::wander_test {

constexpr double turn = 2.0 * std::numbers::pi;

/// Forces of two teeth over a spindle that turns at 50 Hz, but for its wander.
struct Made {
  std::array<std::vector<double>, 3> channel;
  std::vector<double> stated;  ///< angles at the mean speed
  std::vector<double> truth;

  /// @param wander  angle that is added, over the part of the record
  template <class Wander>
  Made(const Wander& wander, double noise) {
    std::mt19937 random(3);
    std::normal_distribution<double> white(0.0, noise);
    constexpr int samples = 20000;
    for (int i = 0; i < samples; ++i) {
      const double x = static_cast<double>(i) / samples;
      stated.push_back(turn * 100.0 * x);
      truth.push_back(stated.back() + wander(x));
      const double phi = truth.back();
      channel[0].push_back(200.0 * std::pow(std::sin(phi), 2) + 20.0 * std::cos(phi) +
                           white(random));
      channel[1].push_back(100.0 * std::cos(2.0 * phi + 1.0) + white(random));
      channel[2].push_back(white(random));
    }
  }

  /// Largest error of an angle, but for a common phase and speed.
  [[nodiscard]] double error(const std::vector<double>& angle) const {
    double mean = 0.0;
    for (std::size_t i = 0; i < angle.size(); ++i) {
      mean += (angle[i] - truth[i]) / static_cast<double>(angle.size());
    }
    double out = 0.0;
    for (std::size_t i = 0; i < angle.size(); ++i) {
      out = std::max(out, std::abs(angle[i] - truth[i] - mean));
    }
    return out;
  }
};

TEST(FollowSpeed, LeavesAConstantSpeedAsItIs) {
  for (const double noise : {0.1, 5.0, 40.0}) {
    const Made made([](double) { return 0.0; }, noise);
    EXPECT_TRUE(follow_speed(made.channel, made.stated).angle.empty()) << noise;
    const Made faster([](double x) { return 0.3 * x; }, noise);
    EXPECT_TRUE(follow_speed(faster.channel, faster.stated).angle.empty()) << noise;
  }
}

// [S-10]
TEST(FollowSpeed, FollowsASagAndARipple) {
  // The speed falls by 1 % from the first to the last turn.
  const Made sag([](double x) { return turn * 100.0 * 0.005 * (x - x * x); }, 5.0);
  const Wander followed = follow_speed(sag.channel, sag.stated);
  ASSERT_FALSE(followed.angle.empty());
  EXPECT_LT(sag.error(followed.angle), 0.01) << "without " << sag.error(sag.stated);
  EXPECT_NEAR(followed.fastest, 1.005, 1e-3);
  EXPECT_NEAR(followed.slowest, 0.995, 1e-3);
  const Made ripple([](double x) { return 0.1 * std::sin(turn * 4.0 * x); }, 5.0);
  const Wander other = follow_speed(ripple.channel, ripple.stated);
  ASSERT_FALSE(other.angle.empty());
  EXPECT_LT(ripple.error(other.angle), 0.02);
}

TEST(GrowthOfForce, IsThatOfAToolThatWears) {
  Made made([](double) { return 0.0; }, 5.0);
  const Growth none = growth_of_force(made.channel, made.stated);
  EXPECT_LT(std::abs(none.growth), 4.0 * none.se);
  for (auto& channel : made.channel) {
    for (std::size_t i = 0; i < channel.size(); ++i) {
      channel[i] *=
          1.0 + 0.1 * static_cast<double>(i) / static_cast<double>(channel.size());
    }
  }
  const Growth worn = growth_of_force(made.channel, made.stated);
  EXPECT_NEAR(worn.growth, 0.1 / 1.05, 4.0 * worn.se);
  EXPECT_LT(worn.se, 0.01);
}

TEST(FollowSpeed, NeedsTurnsToCompare) {
  EXPECT_TRUE(follow_speed({}, {}).angle.empty());
}

}  // namespace trochoid::signal::wander_test
