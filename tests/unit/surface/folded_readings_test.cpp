#include "made_readings.h"

#include <trochoid/surface/folded_readings.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace trochoid::surface::folded_readings_test {

constexpr Coefficients K = {800e6, 300e6, 0.0, 0.0};

/// Readings all along a stretch of the wall, as the model of single readings has them.
std::vector<Reading> scan(const Setting& s, int along,
                          const std::vector<double>& heights, int sets = 1) {
  std::vector<Reading> readings;
  for (int set = 0; set < sets; ++set) {
    for (const double h : heights) {
      for (int i = 0; i < along; ++i) {
        const double x = 20e-3 + 10e-3 * (i + 0.3 * set) / along;
        readings.push_back(
            {.x = x, .travel = x, .height = h, .set = static_cast<std::size_t>(set)});
      }
    }
  }
  const ToothModel model(s, readings);
  const auto& runout = s.setup.runout;
  const RunoutVector r{runout.eccentricity * std::cos(runout.angle),
                       runout.eccentricity * std::sin(runout.angle)};
  const auto e = model.predict(model.forces(r), K, r, 0.0);
  for (std::size_t i = 0; i < e.size(); ++i) readings[i].error = e[i];
  return readings;
}

TEST(HeightGrid, AFewHeightsAreNodes) {  // [E-18]
  const HeightGrid grid(std::vector{2e-3, 1e-3, 2e-3, 3e-3});
  EXPECT_TRUE(grid.exact());
  ASSERT_EQ(grid.nodes().size(), 3U);
  const HeightShare share = grid.at(2e-3 - 1e-12);
  EXPECT_EQ(share.first, 1U);
  EXPECT_EQ(share.count, 1U);
  EXPECT_EQ(share.weights[0], 1.0);
}

TEST(HeightGrid, ManyAreInterpolatedByCubics) {  // [E-18]
  std::vector<double> heights;
  for (int i = 0; i <= 1000; ++i) heights.push_back(1e-3 + 2e-6 * i);
  const HeightGrid grid(heights);
  EXPECT_FALSE(grid.exact());
  EXPECT_LT(grid.nodes().size(), 100U);
  const auto cubic = [](double h) { return 1 + h * (2 + h * (-3e3 + h * 4e6)); };
  for (const double h : heights) {
    const HeightShare share = grid.at(h);
    double sum = 0.0;
    for (std::size_t k = 0; k < share.count; ++k) {
      sum += share.weights[k] * cubic(grid.nodes()[share.first + k]);
    }
    EXPECT_NEAR(sum, cubic(h), 1e-12) << h;
  }
}

TEST(HeightGrid, WhatLiesBetweenNodesIsWhatAModelSaysThere) {  // [E-18]
  // five heights of a scan of fifty, once between nodes and once as nodes
  for (const Model kind : {Model::imprint, Model::envelope}) {
    Setting s = made_setting(kind, with_runout(made_cut(), 4e-6, 1.0));
    s.probe_radius = kind == Model::envelope ? 0.5e-3 : 0.0;
    std::vector<Reading> all;
    for (int i = 0; i < 50; ++i) {
      all.push_back({.x = 30e-3,
                     .travel = 30e-3 + 0.2e-3 * (i % 3),
                     .height = 0.3e-3 + 2.4e-3 * i / 49.0,
                     .tooth = i % 3});
    }
    std::vector<Reading> some;
    for (std::size_t i = 3; i < all.size(); i += 10) some.push_back(all[i]);
    const RunoutVector runout{2e-6, 3e-6};
    const ToothModel nodes(s, all);
    const ToothModel exact(s, some);
    const auto a = nodes.predict(nodes.forces(runout), K, runout, 0.0);
    const auto b = exact.predict(exact.forces(runout), K, runout, 0.0);
    for (std::size_t i = 0; i < some.size(); ++i) {
      EXPECT_NEAR(a[3 + 10 * i], b[i], 60e-9) << name_of(kind) << some[i].height;
    }
  }
}

TEST(FoldReadings, FewStayAsTheyAre) {  // [E-19]
  const Setting s = made_setting(Model::envelope);
  const auto readings = profiles(s, K, {.heights = made_heights(3)});
  const auto folded = fold_readings(s, readings, ToothModel(s, readings));
  ASSERT_EQ(folded.means.size(), readings.size());
  EXPECT_EQ(folded.means[5].travel, readings[5].travel);
  EXPECT_EQ(folded.count[5], 1.0);
}

TEST(FoldReadings, MeansHoldAllReadings) {  // [E-19]
  const Setting s = made_setting(Model::envelope, with_runout(made_cut(), 4e-6, 1.0));
  auto readings = scan(s, 6000, {1e-3, 2e-3}, 2);
  add_noise(readings, 1e-6, 3);
  const auto folded = fold_readings(s, readings, ToothModel(s, readings));
  EXPECT_LT(folded.means.size(), readings.size() / 2);
  double count = 0.0;
  double sum = 0.0;
  for (std::size_t b = 0; b < folded.means.size(); ++b) {
    count += folded.count[b];
    sum += folded.count[b] * folded.means[b].error;
  }
  EXPECT_EQ(count, static_cast<double>(readings.size()));
  double all = 0.0;
  for (const Reading& r : readings) all += r.error;
  EXPECT_NEAR(sum, all, 1e-9 * std::abs(all));
  const double feed = 3 * s.setup.cut.f_z;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Reading& mean = folded.means[folded.of[i]];
    EXPECT_EQ(mean.height, readings[i].height);
    EXPECT_EQ(mean.set, readings[i].set);
    EXPECT_LT(std::abs(std::remainder(mean.travel - readings[i].travel, feed)),
              s.setup.cut.f_z / 32);
    EXPECT_LT(std::abs(mean.x - readings[i].x), 10e-3 / 24);
  }
}

TEST(FoldReadings, TheAnswerIsThatOfEveryReadingByItself) {  // [E-17] [E-19]
  // twice the same readings are folded, once they are not: the minimum is the same
  for (const Model kind : {Model::envelope, Model::quasi_static}) {
    const Setting s = made_setting(kind, with_runout(made_cut(), 4e-6, 1.0));
    auto once = kind == Model::envelope
                    ? scan(s, 990, {0.5e-3, 1.2e-3, 2e-3, 2.6e-3})
                    : pulses(s, K, {.heights = made_heights(4), .per_tooth = 320});
    add_noise(once, 1.5e-6, 11);
    auto twice = once;
    twice.insert(twice.end(), once.begin(), once.end());
    Setting blind = s;
    blind.setup.runout = {};
    constexpr Datum datum{.offset = true};
    const ModelFits means = fitted(blind, once, datum);
    const RunoutFit a = find_runout(blind, once, std::array{datum}, means);
    const RunoutFit b =
        find_runout(blind, twice, std::array{datum}, fitted(blind, twice, datum));
    ASSERT_TRUE(a.ok && b.ok) << a.message << b.message;
    EXPECT_LT(fold_readings(blind, twice, ToothModel(blind, twice)).means.size(),
              once.size() + 1);
    // a kink within a bin is met to a tenth of a standard error
    const auto same = [&](const Estimate& x, const Estimate& y) {
      EXPECT_NEAR(x.value, y.value, 0.15 * y.se) << name_of(kind);
      EXPECT_NEAR(x.se / y.se, std::sqrt(2.0), 0.05) << name_of(kind);
    };
    same(a.eccentricity, b.eccentricity);
    same(a.angle, b.angle);
    same(a.K_tc, b.K_tc);
    same(a.K_rc, b.K_rc);
    same(a.datum.at(0), b.datum.at(0));
    EXPECT_NEAR(a.rms, b.rms, 1e-4 * a.rms);
    EXPECT_EQ(b.predicted.size(), twice.size());
  }
}

}  // namespace trochoid::surface::folded_readings_test
