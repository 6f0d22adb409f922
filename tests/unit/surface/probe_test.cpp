#include "made_wall.h"

#include <trochoid/surface/probe.h>

#include <gtest/gtest.h>

#include <numeric>

namespace trochoid::surface::probe_test {

constexpr double R_e = 4.4e-3;
constexpr double f = 0.2e-3;
constexpr int n = 400;

/// Distance from the lowest point between two cusps [m].
double from_valley(int i) {
  return f * (static_cast<double>(i) / n - 0.5);
}

std::vector<double> scallops() {
  std::vector<double> profile;
  for (int i = 0; i < n; ++i) {
    profile.push_back(from_valley(i) * from_valley(i) / (2 * R_e));
  }
  return profile;
}

double mean(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

TEST(Probe, ASmallTipSinksBetweenTheCusps) {  // [E-13]
  const double r = 0.5e-3;
  const auto reading = probe_reading(scallops(), f / n, r);
  for (int i = 0; i < n; ++i) {
    // it rolls on a circle of R_e - r until it leans on a cusp
    const double x = std::abs(from_valley(i));
    const double to_cusp = f / 2 - x;
    const double want = x < f / 2 * (1 - r / R_e)
                            ? x * x / (2 * (R_e - r))
                            : f * f / (8 * R_e) - to_cusp * to_cusp / (2 * r);
    EXPECT_NEAR(reading[static_cast<std::size_t>(i)], want, 1e-10) << i;
  }
}

TEST(Probe, AFlatTipReadsTheCusps) {  // [E-13] cusps of f^2/8R_e, mean f^2/24 R_e
  const auto profile = scallops();
  EXPECT_NEAR(mean(profile), f * f / (24 * R_e), 1e-5 * f * f / R_e);
  const auto reading = probe_reading(profile, f / n, 1.0);
  for (const double e : reading) {
    EXPECT_NEAR(e, f * f / (8 * R_e), 0.01 * f * f / (8 * R_e));
  }
}

TEST(Probe, ReadsNeverLessThanTheWallAndNeverMoreThanItsTop) {  // [E-13]
  std::vector<double> profile;
  for (int i = 0; i < 300; ++i) {
    profile.push_back(5e-6 * std::sin(0.7 * i) * std::cos(0.11 * i * i));
  }
  const double top = *std::max_element(profile.begin(), profile.end());
  double before = -1.0;
  for (const double r : {1e-5, 1e-4, 1e-3}) {  // a larger tip reads no less
    const auto reading = probe_reading(profile, 2e-6, r);
    for (std::size_t i = 0; i < profile.size(); ++i) {
      EXPECT_GE(reading[i], profile[i]);
      EXPECT_LE(reading[i], top);
    }
    EXPECT_GE(mean(reading), before);
    before = mean(reading);
  }
}

TEST(Probe, APeakReachesAroundTheEndOfThePeriod) {  // [E-13]
  std::vector<double> profile(50, 0.0);
  profile[0] = 3e-6;
  const double step = 10e-6;
  const double r = 0.5e-3;
  const auto reading = probe_reading(profile, step, r);
  for (const std::size_t k : {1U, 3U, 5U}) {
    const double d = static_cast<double>(k) * step;
    const double want = std::max(0.0, 3e-6 - (r - std::sqrt(r * r - d * d)));
    EXPECT_NEAR(reading[k], want, 1e-15);
    EXPECT_NEAR(reading[50 - k], want, 1e-15);
  }
  EXPECT_EQ(reading[25], 0.0);
}

TEST(Probe, AFlatWallIsReadAsItIs) {  // [E-13]
  for (const double e : probe_reading(std::vector<double>(20, 7e-6), 1e-5, 0.5e-3)) {
    EXPECT_EQ(e, 7e-6);
  }
}

TEST(Probe, APeriodShorterThanTheTipIsNoTrouble) {  // [E-13]
  std::vector<double> profile(6, 0.0);
  profile[2] = 1e-6;
  const auto reading = probe_reading(profile, 1e-6, 0.5e-3);
  for (const double e : reading) EXPECT_NEAR(e, 1e-6, 1e-8);
}

TEST(Probe, OnALeaningWallASphereStandsOff) {  // [E-14]
  const double r = 0.5e-3;
  for (const double s : {-0.4, -0.02, 0.0, 0.003, 0.02, 0.4, 2.0}) {
    // the sphere stops at the first point of the plane e = s h that it meets
    double highest = -1.0;
    for (int i = -20000; i <= 20000; ++i) {
      const double h = r * i / 20000;
      highest = std::max(highest, s * h - (r - std::sqrt(r * r - h * h)));
    }
    EXPECT_NEAR(reading_on_slope(r, s), highest, 1e-8 * r) << s;
  }
  EXPECT_NEAR(reading_on_slope(r, 1e-9), 0.5 * r * 1e-18, 1e-6 * r * 1e-18);
}

}  // namespace trochoid::surface::probe_test
