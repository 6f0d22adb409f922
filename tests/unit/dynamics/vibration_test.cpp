#include "milling_cut.h"

#include <trochoid/dynamics/vibration.h>

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::dynamics::vibration_test {

/// Sines of three frequencies over turns of 0.1 s, one a harmonic of the spindle.
Motion three_sines(int turns, int per_turn) {
  Motion m;
  m.mode.resize(1);
  for (int i = 0; i < turns * per_turn; ++i) {
    const double t = 0.1 * i / per_turn;
    m.time.push_back(t);
    m.mode[0].push_back(3e-6 + 5e-6 * std::sin(2 * pi * 123.4 * t) +
                        2e-6 * std::cos(2 * pi * 40 * t + 1) +
                        1e-6 * std::sin(2 * pi * 201.7 * t));
  }
  return m;
}

TEST(SpectrumOf, HasTheLinesOfTheMotion) {  // [T-13] [T-14]
  const System system{{{.x = -0.6, .y = 0.8}}};
  const auto lines = lines_of(spectrum_of(system, three_sines(16, 256)), 10.0);
  ASSERT_EQ(lines.size(), 3U);
  const double frequencies[] = {123.4, 40, 201.7};
  const double amplitudes[] = {5e-6, 2e-6, 1e-6};
  for (std::size_t i = 0; i < 3; ++i) {
    // The other lines leak a little into each.
    EXPECT_NEAR(lines[i].frequency, frequencies[i], 2e-3) << i;
    EXPECT_NEAR(lines[i].amplitude[0], 0.6 * amplitudes[i], 2e-9) << i;
    EXPECT_NEAR(lines[i].amplitude[1], 0.8 * amplitudes[i], 2e-9) << i;
  }
  EXPECT_EQ(lines[0].harmonic, 0);
  EXPECT_EQ(lines[1].harmonic, 4);
  Bounded bounded{.lines = {lines[1], lines[0]}};
  EXPECT_EQ(chatter_line(bounded), &bounded.lines[1]);
  bounded.lines.pop_back();
  EXPECT_EQ(chatter_line(bounded), nullptr);
}

TEST(SpectrumSamples, SeeTheFastestModeAndTellTheSlowest) {
  MotionProblem p;
  p.setup = straight_cut(2, geometry::Slot{});
  p.system = benchmark_system();
  for (const double rpm : {20.0, 300.0, 5000.0, 20000.0}) {
    p.setup.cut.Omega = rpm * unit::rpm;
    const SpectrumSamples s = spectrum_samples(p, 160);
    EXPECT_GE(s.turns, 4) << rpm;
    EXPECT_LE(s.turns, 80) << rpm;
    EXPECT_GE(s.per_turn * rpm / 60, 8 * 922) << rpm;
    EXPECT_EQ(s.turns & (s.turns - 1), 0);
    EXPECT_EQ(s.per_turn & (s.per_turn - 1), 0);
  }
}

}  // namespace trochoid::dynamics::vibration_test
