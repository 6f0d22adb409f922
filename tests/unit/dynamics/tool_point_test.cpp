#include <trochoid/dynamics/tool_point.h>
#include <trochoid/structure/thinned.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace trochoid::dynamics::tool_point_test {

constexpr double mass = 0.04;
constexpr double stiffness = 1.5e6;
constexpr double damping = 5.0;

/// One mode, from 200 rad/s on in steps of 10.
MeasuredResponse one_mode(std::size_t motion, std::size_t force, double scale = 1.0) {
  MeasuredResponse out;
  out.motion = motion;
  out.force = force;
  for (double w = 200; w < 12000; w += 10) {
    out.response.omega.push_back(w);
    out.response.H.push_back(
        scale / std::complex<double>(stiffness - mass * w * w, damping * w));
  }
  return out;
}

TEST(ToolPoint, HasTheModesOfItsDirectResponses) {
  const std::vector<MeasuredResponse> x{one_mode(0, 0)};
  const ToolPoint point = tool_point(x, true);
  ASSERT_EQ(point.modes.modes.size(), 1U);
  EXPECT_FALSE(point.no_modes.has_value());
  EXPECT_NEAR(point.modes.modes[0].mass, mass, 1e-4 * mass);
  EXPECT_EQ(point.modes.modes[0].x, 1.0);
  EXPECT_TRUE(tool_point(x, false).modes.modes.empty());
}

TEST(ToolPoint, IsWithoutADelayOfItsChannels) {  // [M-36]
  constexpr double delay = 20e-6;
  const std::vector<MeasuredResponse> sound{one_mode(0, 0), one_mode(1, 1),
                                            one_mode(0, 1, 0.3)};
  std::vector<MeasuredResponse> late = sound;
  for (MeasuredResponse& one : late) {
    one.response = structure::without_delay(one.response, -delay);
  }
  const ToolPoint point = tool_point(late, true);
  ASSERT_EQ(point.delays.size(), 3U);
  for (const FoundDelay& found : point.delays) {
    EXPECT_NEAR(found.delay.time.value, delay, 1e-3 * delay);
  }
  const ToolPoint known = tool_point(sound, true);
  EXPECT_TRUE(known.delays.empty());
  for (std::size_t k = 0; k < known.response.parts.size(); ++k) {
    const auto& H = known.response.parts[k].H;
    for (std::size_t i = 0; i < H.size(); i += 50) {
      EXPECT_LT(std::abs(point.response.parts[k].H[i] - H[i]), 1e-3 * std::abs(H[i]));
    }
  }
}

TEST(ToolPoint, OfATableMovesAgainstTheTool) {
  MeasuredResponse y = one_mode(1, 1);
  y.of_table = true;
  const ToolPoint point = tool_point(std::vector{y}, true);
  ASSERT_EQ(point.modes.modes.size(), 1U);
  EXPECT_EQ(point.modes.modes[0].y, -1.0);
  EXPECT_TRUE(point.modes.modes[0].of_table);
}

TEST(ToolPoint, TakesACrossResponseForBothDirections) {
  const std::vector<MeasuredResponse> all{one_mode(0, 0), one_mode(1, 1),
                                          one_mode(0, 1, 0.3)};
  const ToolPoint point = tool_point(all, false);
  ASSERT_EQ(point.response.parts.size(), 4U);
  EXPECT_EQ(point.response.parts[3].motion, 1U);
  EXPECT_EQ(point.response.parts[3].force, 0U);
  EXPECT_EQ(point.response.parts[3].H, point.response.parts[2].H);
}

TEST(MeasuredResponse, OfASensorTheWrongWayRoundMovesAgainstTheForce) {
  EXPECT_FALSE(moves_against_force(receptance_of(one_mode(0, 0))));
  EXPECT_TRUE(moves_against_force(receptance_of(one_mode(0, 0, -1.0))));
  EXPECT_FALSE(moves_against_force(receptance_of(one_mode(0, 1, -1.0))));
}

TEST(MeasuredResponse, HasItsPeakAtTheResonance) {
  const std::vector<Peak> all = peaks(receptance_of(one_mode(0, 0)));
  ASSERT_EQ(all.size(), 1U);
  const Peak& peak = all.front();
  EXPECT_NEAR(peak.omega, std::sqrt(stiffness / mass), 10);
  EXPECT_NEAR(static_cast<double>(peak.lines), damping / mass / 10, 2);
  EXPECT_FALSE(peak.at_the_edge);
  EXPECT_LT(structure::scatter_of_lines(receptance_of(one_mode(0, 0)).H), 1e-9);
}

}  // namespace trochoid::dynamics::tool_point_test
