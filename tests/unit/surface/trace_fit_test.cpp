#include <gtest/gtest.h>
#include <trochoid/base/units.h>
#include <trochoid/surface/trace_fit.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace trochoid::surface::trace_fit_test {

force::Setup face_mill(int teeth, double f_z) {
  force::Setup setup;
  setup.cutter.profile = geometry::taper(80e-3, 45 * unit::deg);
  setup.cutter.pitch = geometry::equal_pitch(teeth);
  setup.cutter.helix = 5 * unit::deg;
  setup.cutter.lag_diameter = 80e-3;
  setup.cut = {geometry::Slot{}, 2e-3, f_z, 80};
  return setup;
}

force::Setup end_mill(int teeth, double f_z) {
  force::Setup setup;
  setup.cutter = geometry::end_mill(12e-3, teeth, 30 * unit::deg);
  setup.cut = {geometry::DownMilling{1e-3}, 5e-3, f_z, 100};
  return setup;
}

constexpr FloorTrace centre_line{{.dish = 0.5 * unit::deg, .lead = 0.03 * unit::deg},
                                 0.0};

/// A trace of a cut with runout: it starts anywhere, on a slope, with noise.
Trace traced(const force::Setup& setup, const decltype(Trace::line)& line, double turns,
             double noise, std::uint32_t seed) {
  const auto* const floor = std::get_if<FloorTrace>(&line);
  const PeriodicProfile profile =
      floor != nullptr ? floor_profile(setup, floor->bottom, floor->y)
                       : wall_profile(setup, std::get<WallTrace>(line).height);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, noise);
  const double start = std::uniform_real_distribution<double>(0, 1)(random);
  Trace out{.line = line};
  const double step = profile.period / 300;
  for (int i = 0; i < static_cast<int>(300 * turns); ++i) {
    const double x = i * step;
    const double place = x + start * profile.period;
    const double u = place - profile.period * std::floor(place / profile.period);
    out.x.push_back(5e-3 + x);
    out.z.push_back(2e-6 + 1e-3 * x + profile_at(profile, u).height + normal(random));
  }
  return out;
}

/// Offsets against the largest one, in the order of passage from it on.
std::vector<double> from_deepest(const std::vector<double>& a) {
  std::vector<double> out = a;
  std::ranges::rotate(out, std::ranges::max_element(out));
  const double most = out.front();
  for (double& x : out) x -= most;
  return out;
}

TEST(TraceFit, FindsTheInsertsOfAFaceMill) {  // [W-7]
  force::Setup setup = face_mill(7, 0.2e-3);
  setup.runout.axial_offsets = {0.0, 0.9e-6, -0.4e-6, 0.5e-6, 1.0e-6, -0.5e-6, 0.3e-6};
  const Trace trace = traced(setup, centre_line, 6, 0.05e-6, 1);
  const TraceFit fit = fit_trace(setup, trace);
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_FALSE(fit.numbered);
  const std::vector<double> expected = from_deepest(setup.runout.axial_offsets);
  for (std::size_t j = 0; j < 7; ++j) {
    ASSERT_TRUE(fit.teeth[j].writes) << j;
    EXPECT_NEAR(fit.teeth[j].offset.value, expected[j],
                4 * fit.teeth[j].offset.se + 1e-9)
        << j;
    EXPECT_LT(fit.teeth[j].offset.se, 0.05e-6);
  }
  EXPECT_NEAR(fit.feed.value, 1.4e-3, 4 * fit.feed.se);
  EXPECT_NEAR(fit.rms, 0.05e-6, 0.005e-6);
  const auto feeds = roughness_at_feeds(setup, trace, fit);
  ASSERT_EQ(feeds.size(), 11u);
  EXPECT_NEAR(feeds[5].Ra, fit.Ra, 1e-3 * fit.Ra);
  setup.cut.f_z *= 0.5;
  const double half = roughness(floor_profile(setup, centre_line.bottom, 0.0)).Ra;
  EXPECT_NEAR(feeds[0].Ra, half, 0.02 * half);
  EXPECT_LT(feeds[0].Ra_alike, feeds[0].Ra);
}

TEST(TraceFit, SaysOfInsertsThatNeverWriteHowShortTheyAre) {  // [W-7]
  force::Setup setup = face_mill(5, 0.2e-3);
  setup.runout.axial_offsets = {0.0, 12e-6, -20e-6, 5e-6, 11e-6};
  const TraceFit fit = fit_trace(setup, traced(setup, centre_line, 8, 0.1e-6, 2));
  ASSERT_TRUE(fit.ok) << fit.message;
  const std::vector<double> expected = from_deepest(setup.runout.axial_offsets);
  for (std::size_t j = 0; j < 5; ++j) {
    if (fit.teeth[j].writes) {
      EXPECT_NEAR(fit.teeth[j].offset.value, expected[j],
                  4 * fit.teeth[j].offset.se + 1e-9);
    } else {
      EXPECT_LT(expected[j], fit.teeth[j].at_most) << j;
    }
  }
  EXPECT_FALSE(fit.teeth[2].writes);
  EXPECT_TRUE(fit.waves.empty());
}

TEST(TraceFit, FindsRadiiOnAWall) {  // [W-7]
  for (const bool up : {false, true}) {
    force::Setup setup = end_mill(4, 0.1e-3);
    if (up) setup.cut.engagement = geometry::UpMilling{1e-3};
    setup.runout.radial_offsets = {0.0, 0.1e-6, -0.08e-6, 0.05e-6};
    const TraceFit fit =
        fit_trace(setup, traced(setup, WallTrace{2e-3}, 10, 0.01e-6, 3));
    ASSERT_TRUE(fit.ok) << fit.message;
    const std::vector<double> expected = from_deepest(setup.runout.radial_offsets);
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_NEAR(fit.teeth[j].offset.value, expected[j],
                  4 * fit.teeth[j].offset.se + 1e-10)
          << j << up;
    }
  }
}

TEST(TraceFit, NumbersTeethByTheirPitch) {
  force::Setup setup = face_mill(4, 0.15e-3);
  setup.cutter.pitch = {85 * unit::deg, 95 * unit::deg, 80 * unit::deg,
                        100 * unit::deg};
  setup.runout.axial_offsets = {0.0, 0.4e-6, -0.5e-6, 0.2e-6};
  const TraceFit fit = fit_trace(setup, traced(setup, centre_line, 8, 0.02e-6, 4));
  ASSERT_TRUE(fit.ok) << fit.message;
  ASSERT_TRUE(fit.numbered);
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_NEAR(fit.teeth[j].offset.value, setup.runout.axial_offsets[j] - 0.4e-6,
                4 * fit.teeth[j].offset.se + 1e-9);
  }
}

TEST(TraceFit, FollowsAFeedThatIsNotTheStatedOne) {
  force::Setup setup = face_mill(7, 0.2e-3);
  setup.runout.axial_offsets = {0.0, 0.9e-6, -0.4e-6, 0.5e-6, 1.0e-6, -0.5e-6, 0.3e-6};
  const Trace trace = traced(setup, centre_line, 9, 0.05e-6, 5);
  setup.cut.f_z *= 1.017;
  const TraceFit fit = fit_trace(setup, trace);
  ASSERT_TRUE(fit.ok);
  EXPECT_NEAR(fit.feed.value, 1.4e-3, 4 * fit.feed.se);
  EXPECT_LT(fit.feed.se, 1e-6);
  EXPECT_NEAR(fit.rms, 0.05e-6, 0.005e-6);
}

TEST(TraceFit, ATiltIsOneWaveATurn) {  // [W-3]
  force::Setup setup = face_mill(6, 0.2e-3);
  setup.runout.tilt = 1e-6 / 40e-3;
  setup.runout.tilt_angle = 0.7;
  const TraceFit fit = fit_trace(setup, traced(setup, centre_line, 8, 0.03e-6, 6));
  ASSERT_TRUE(fit.ok);
  ASSERT_EQ(fit.waves.size(), 3u);
  EXPECT_NEAR(fit.waves[0].amplitude.value, 1e-6, 4 * fit.waves[0].amplitude.se);
  EXPECT_LT(fit.waves[1].amplitude.value, 4 * fit.waves[1].amplitude.se);
}

/// Noise of which neighbours have much in common.
void add_drifting_noise(Trace& trace, double sd, double memory, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, sd * std::sqrt(1 - memory * memory));
  double now = 0.0;
  for (double& z : trace.z) {
    now = memory * now + normal(random);
    z += now;
  }
}

TEST(TraceFit, IntervalsHoldTheTruth) {  // [W-7] [W-8]
  int asked = 0;
  int held = 0;
  int short_ones = 0;
  int wrong = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const int teeth = 3 + static_cast<int>(seed % 5);
    force::Setup setup = face_mill(teeth, 0.2e-3);
    for (int j = 0; j < teeth; ++j) {
      setup.runout.axial_offsets.push_back(
          std::normal_distribution<double>(0.0, 0.8e-6)(random));
    }
    Trace trace = traced(setup, centre_line, 6, 0.05e-6, seed);
    if (seed % 2 == 1) add_drifting_noise(trace, 0.1e-6, 0.9, random);
    const TraceFit fit = fit_trace(setup, trace);
    ASSERT_TRUE(fit.ok) << fit.message;
    // Against the deepest one, which may be another: then the order says which.
    const std::vector<double> expected = from_deepest(setup.runout.axial_offsets);
    for (std::size_t j = 1; j < expected.size(); ++j) {
      const ToothDepth& tooth = fit.teeth[j];
      if (tooth.writes) {
        ++asked;
        held += tooth.offset.low <= expected[j] && expected[j] <= tooth.offset.high;
      } else {
        ++short_ones;
        wrong += expected[j] > tooth.at_most;
      }
    }
  }
  EXPECT_GE(asked, 120);
  EXPECT_GE(held, 0.90 * asked) << asked;
  EXPECT_LE(held, 0.99 * asked) << asked;
  EXPECT_GE(short_ones, 5);
  EXPECT_LE(wrong, 1) << short_ones;
}

TEST(TraceFit, SeesThroughTheFilterOfTheInstrument) {  // [W-2] [W-7]
  force::Setup setup = face_mill(7, 0.2e-3);
  setup.runout.axial_offsets = {0.0, 0.9e-6, -0.4e-6, 0.5e-6, 1.0e-6, -0.5e-6, 0.3e-6};
  Trace trace = traced(setup, centre_line, 6, 0.0, 7);
  // Filter a long trace that repeats: here by the sum over many turns of the kernel.
  const double cutoff = 0.8e-3;
  const std::size_t n = trace.z.size();
  const double step = trace.x[1] - trace.x[0];
  for (std::size_t i = 0; i < n; ++i) trace.z[i] -= 1e-3 * (trace.x[i] - trace.x[0]);
  std::vector<double> smooth(n);
  const double alpha = std::sqrt(std::log(2.0) / 3.14159265358979323846);
  for (std::size_t i = 0; i < 300; ++i) {
    double sum = 0.0;
    for (int k = -900; k <= 900; ++k) {
      const double t = k * step / (alpha * cutoff);
      const std::size_t at = (i + 900 + static_cast<std::size_t>(900 + k)) % 300;
      sum += std::exp(-3.14159265358979323846 * t * t) / (alpha * cutoff) * step *
             trace.z[at];
    }
    for (std::size_t turn = 0; turn < n / 300; ++turn) smooth[turn * 300 + i] = sum;
  }
  std::mt19937 random(8);
  std::normal_distribution<double> noise(0.0, 0.02e-6);
  for (std::size_t i = 0; i < n; ++i) trace.z[i] += noise(random) - smooth[i];
  trace.cutoff = cutoff;
  const TraceFit fit = fit_trace(setup, trace);
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_NEAR(fit.rms, 0.02e-6, 0.002e-6);
  const std::vector<double> expected = from_deepest(setup.runout.axial_offsets);
  for (std::size_t j = 0; j < 7; ++j) {
    EXPECT_NEAR(fit.teeth[j].offset.value, expected[j],
                4 * fit.teeth[j].offset.se + 2e-9);
  }
  trace.cutoff.reset();
  EXPECT_GT(fit_trace(setup, trace).rms, 3 * fit.rms);
}

TEST(TraceFit, RefusesAShortTrace) {
  const force::Setup setup = face_mill(7, 0.2e-3);
  const TraceFit fit = fit_trace(setup, traced(setup, centre_line, 2, 0, 1));
  EXPECT_FALSE(fit.ok);
  EXPECT_NE(fit.message.find("at least 3"), std::string::npos) << fit.message;
}

}  // namespace trochoid::surface::trace_fit_test
