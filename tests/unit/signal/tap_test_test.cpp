#include "made_taps.h"

#include <gtest/gtest.h>
#include <trochoid/signal/tap_test.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace trochoid::signal::tap_test_test {

using Complex = std::complex<double>;
using made::TapMode;

const TapMode tool{.frequency = 800, .zeta = 0.03, .mass = 0.5};

/// The receptance at s = i omega + a.
Complex receptance(const TapMode& m, double omega, double a) {
  const double w = 2 * std::numbers::pi * m.frequency;
  const Complex s(a, omega);
  return 1.0 / (m.mass * (s * s + 2 * m.zeta * w * s + w * w));
}

/// Largest difference between 300 and 1500 Hz, over the largest |H| there.
double worst(const TapResponse& r, const TapMode& m) {
  double most = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < r.omega.size(); ++i) {
    const double f = r.omega[i] / (2 * std::numbers::pi);
    if (f < 300 || f > 1500) continue;
    const Complex H = receptance(m, r.omega[i], r.decay);
    most = std::max(most, std::abs(r.H[i] - H));
    size = std::max(size, std::abs(H));
  }
  return most / size;
}

TEST(TapTest, GivesTheReceptanceOfAMode) {  // [M-20]
  const auto record = made::taps({tool}, {.at = {0.1, 0.5, 0.9}, .length = 1.4});
  for (const auto estimator : {FrfEstimator::H1, FrfEstimator::H2}) {
    const auto r = frequency_response(record, {.estimator = estimator});
    ASSERT_EQ(r.fault, "");
    ASSERT_EQ(r.hits.size(), 3U);
    EXPECT_NEAR(r.hits[1].time, 0.5, 1e-4);
    EXPECT_NEAR(r.hits[1].peak, 500, 2);
    EXPECT_EQ(r.window_end, 1.0) << "it has died out";
    // Impulses in the place of a smooth force: half a sample, 800 Hz of 51200.
    EXPECT_LT(worst(r, tool), 0.01);
    EXPECT_GT(r.excited, 2 * std::numbers::pi * 3000);
    for (const double c : r.coherence) EXPECT_NEAR(c, 1.0, 1e-4);
  }
}

TEST(TapTest, TheExponentialWindowShiftsTheResponse) {  // [M-21]
  const TapMode slow{.frequency = 400, .zeta = 0.004, .mass = 0.5};
  const auto record = made::taps({slow}, {.at = {0.01}, .length = 0.25});
  const auto r = frequency_response(record, {});
  EXPECT_EQ(r.window_end, 0.01);
  EXPECT_NEAR(r.decay, std::log(100) / r.block, 1e-9);
  EXPECT_LT(worst(r, slow), 0.015);
  const auto bare = frequency_response(record, {.window_end = 1.0});
  EXPECT_GT(worst(bare, slow), 0.05) << "cut off while it rings";
  EXPECT_TRUE(r.coherence.empty()) << "one hit agrees with itself";
}

TEST(TapTest, NoiseOfEitherChannelAveragesOut) {  // [M-20]
  made::Taps how{.at = {}, .length = 8.4};
  for (int k = 0; k < 20; ++k) how.at.push_back(0.1 + 0.4 * k);
  auto noisy = made::taps({tool}, how);
  double largest = 0.0;
  for (const double x : noisy.response) largest = std::max(largest, std::abs(x));
  made::add_noise(noisy.response, 0.05 * largest, 3);
  const auto r = frequency_response(noisy, {});
  const auto one = frequency_response(noisy, {.estimator = FrfEstimator::H2});
  const auto near =
      static_cast<std::size_t>(std::lower_bound(r.omega.begin(), r.omega.end(),
                                                2 * std::numbers::pi * tool.frequency) -
                               r.omega.begin());
  EXPECT_GT(r.coherence[near], 0.99);
  EXPECT_LT(r.coherence.back(), 0.7) << "where the tool hardly moves";
  EXPECT_GT(std::abs(one.H.back()), std::abs(r.H.back()))
      << "H2 takes noise for motion";
  EXPECT_LT(worst(r, tool), 0.05);
}

TEST(TapTest, DoubleHitsAndOverloadsAreNamedAndLeftOut) {
  auto record = made::taps({tool}, {.at = {0.1, 0.5, 0.9, 1.3}, .length = 1.8});
  made::strike(record, 0.52, 120, 2e-4);
  made::strike(record, 0.9, 600, 2e-4);  // together with the other more than twice
  made::respond(record, {tool});
  const double limit =
      0.6 * *std::max_element(record.response.begin(), record.response.end());
  for (double& x : record.response) x = std::clamp(x, -limit, limit);
  const auto r = frequency_response(record, {});
  ASSERT_EQ(r.hits.size(), 4U);
  EXPECT_EQ(r.hits[0].fault, "");
  EXPECT_NE(r.hits[1].fault.find("strikes again 20.1 ms later, with 120 N"),
            std::string::npos)
      << r.hits[1].fault;
  EXPECT_NE(r.hits[2].fault.find("response stands at the limit"), std::string::npos);
  EXPECT_EQ(r.hits[3].fault, "");
  EXPECT_LT(worst(r, tool), 0.01) << "two are left";
}

TEST(TapTest, SaysWhyThereIsNoResponse) {
  TapRecord silent{.sample_rate = 1000, .force = std::vector<double>(100)};
  silent.response = silent.force;
  EXPECT_NE(frequency_response(silent, {}).fault.find("no hit"), std::string::npos);
  auto twice = made::taps({tool}, {.at = {0.1}, .length = 0.5});
  made::strike(twice, 0.13, 200, 2e-4);
  EXPECT_NE(frequency_response(twice, {}).fault.find("double hit"), std::string::npos);
  auto exchanged = made::taps({tool}, {.at = {0.1, 0.5}, .length = 1.0});
  std::swap(exchanged.force, exchanged.response);
  EXPECT_NE(frequency_response(exchanged, {}).fault.find("exchanged"),
            std::string::npos);
}

}  // namespace trochoid::signal::tap_test_test
