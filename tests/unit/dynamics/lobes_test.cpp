#include <trochoid/dynamics/lobes.h>

#include <trochoid/dynamics/chatter.h>

#include "milling_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics::lobes_test {

std::vector<double> steps(double first, double last, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(first + (last - first) * i / (count - 1));
  }
  return values;
}

TEST(Lobes, TheLimitLiesWhereTheMultiplierPassesOne) {  // [D-13]
  const force::Setup setup = straight_cut(2, geometry::Slot{});
  const DirectionalModel model(setup, benchmark_law(), 1e-6, 1e-11);
  const auto depth = steps(0.1e-3, 4e-3, 40);
  for (const double rpm : {5000.0, 12000.0, 20300.0}) {
    const double Omega = rpm * unit::rpm;
    const auto limit = limit_depth(model, benchmark_system(), Omega, depth, 1e-7);
    ASSERT_TRUE(limit.has_value());
    const auto at = [&](double factor) {
      const auto cut = model.at_depth(limit->depth * factor);
      return std::abs(multiplier(cut, benchmark_system(), Omega, 1e-9).value);
    };
    EXPECT_NEAR(at(1), 1, 1e-6);
    EXPECT_LT(at(0.999), 1);
    EXPECT_GT(at(1.001), 1);
  }
  EXPECT_FALSE(limit_depth(model, benchmark_system(), 5000 * unit::rpm,
                           steps(0.01e-3, 0.3e-3, 5), 1e-6)
                   .has_value());
}

TEST(Lobes, TheGridHoldsTheMultipliersWhateverTheThreads) {  // [D-13]
  const force::Setup setup = straight_cut(2, geometry::DownMilling{0.5e-3});
  const DirectionalModel model(setup, benchmark_law(), 1e-6, 1e-11);
  const auto Omega = steps(10000 * unit::rpm, 20000 * unit::rpm, 12);
  const auto depth = steps(0.5e-3, 4e-3, 8);
  double told = 0.0;
  const LobeGrid grid = lobe_grid(model, benchmark_system(), Omega, depth, {1e-7, 1e-7},
                                  {[&told](double share) { told = share; }});
  EXPECT_EQ(grid.Omega, Omega);
  EXPECT_NEAR(told, 1.0, 1e-12);
  for (const std::size_t i : {0U, 5U, 11U}) {
    for (const std::size_t k : {0U, 4U, 7U}) {
      const auto mu =
          multiplier(model.at_depth(depth[k]), benchmark_system(), Omega[i], 1e-9);
      EXPECT_NEAR(std::abs(grid.multiplier[i * depth.size() + k]), std::abs(mu.value),
                  1e-7);
    }
  }
  const auto curve = limit_curve(model, benchmark_system(), grid, 1e-6, {});
  EXPECT_TRUE(
      std::is_sorted(curve.begin(), curve.end(),
                     [](const Limit& a, const Limit& b) { return a.Omega < b.Omega; }));
  ASSERT_GT(curve.size(), 4U);
  for (const Limit& limit : curve) {
    EXPECT_NEAR(std::abs(limit.multiplier), 1.0, 1e-5);
  }
}

/// Speeds up to eight are one thread's, one after the other.
TEST(Lobes, EndWithWhatTheyHaveSpreadOverTheSpeeds) {  // [D-13]
  const force::Setup setup = straight_cut(2, geometry::DownMilling{0.5e-3});
  const DirectionalModel model(setup, benchmark_law(), 1e-6, 1e-11);
  const auto Omega = steps(10000 * unit::rpm, 20000 * unit::rpm, 8);
  const auto depth = steps(0.5e-3, 4e-3, 3);
  LobeWatch watch;
  int told = 0;
  watch.progress = [&](double) {
    if (++told == 2) watch.stop.at = base::Stop::Clock::now();
  };
  const LobeGrid part =
      lobe_grid(model, benchmark_system(), Omega, depth, {1e-5, 1e-5}, watch);
  EXPECT_EQ(part.Omega, (std::vector<double>{Omega[0], Omega[4]}));
  const LobeGrid all =
      lobe_grid(model, benchmark_system(), Omega, depth, {1e-5, 1e-5}, {});
  ASSERT_EQ(part.multiplier.size(), 2 * depth.size());
  for (std::size_t k = 0; k < depth.size(); ++k) {
    EXPECT_EQ(part.multiplier[k], all.multiplier[k]);
    EXPECT_EQ(part.multiplier[depth.size() + k], all.multiplier[4 * depth.size() + k]);
  }
  EXPECT_TRUE(limit_curve(model, benchmark_system(), all, 1e-6, watch).empty());
  const LobeGrid none =
      lobe_grid(model, benchmark_system(), Omega, depth, {1e-5, 1e-5}, watch);
  EXPECT_TRUE(none.Omega.empty());
  EXPECT_TRUE(limit_curve(model, benchmark_system(), none, 1e-6, {}).empty());
}

TEST(Lobes, AreKnownBestNearTheLimit) {  // [D-13]
  // A turn is the period, and many cycles long: runout, two modes.
  force::Setup setup = straight_cut(2, geometry::Slot{});
  setup.chip = {chip::Model::radial, chip::Lookback::all};
  setup.runout.radial_offsets = {4e-6, -4e-6};
  const System system{{mode_of(0.04, 922, 0.03, 1, 0), mode_of(0.04, 922, 0.03, 0, 1)}};
  const DirectionalModel model(setup, benchmark_law(), 1e-6, 1e-11);
  const auto Omega = steps(2500 * unit::rpm, 3000 * unit::rpm, 3);
  const auto depth = steps(0.02e-3, 1e-3, 50);
  const LobeGrid grid = lobe_grid(model, system, Omega, depth, {1e-6, 1e-3}, {});
  int near = 0;
  for (std::size_t i = 0; i < Omega.size(); ++i) {
    for (std::size_t k = 0; k < depth.size(); ++k) {
      const auto mu = multiplier(model.at_depth(depth[k]), system, Omega[i], 1e-9);
      const double size = std::abs(mu.value);
      const double error =
          std::abs(std::abs(grid.multiplier[i * depth.size() + k]) - size);
      const bool is_near = std::abs(std::log(size)) < 0.09;
      near += is_near ? 1 : 0;
      EXPECT_LT(error, is_near ? 1e-6 : 1e-3 * std::max(1.0, size)) << i << ' ' << k;
    }
  }
  EXPECT_GT(near, 0);
}

TEST(Chatter, IsAFamilyOfFrequenciesAToothApart) {  // [D-12]
  const force::Setup setup = straight_cut(2, geometry::Slot{});
  const DirectionalModel model(setup, benchmark_law(), 1e-6, 1e-11);
  const auto cut = model.at_depth(1e-3);
  const auto mu = multiplier(cut, benchmark_system(), setup.cut.Omega, 1e-9);
  EXPECT_EQ(bifurcation_of(mu.value), Bifurcation::hopf);
  const double tooth = 5000.0 / 60 * 2;  // Hz
  const double base = std::arg(mu.value) / (2 * pi) * tooth;
  const auto lines =
      chatter_lines(cut, benchmark_system(), setup.cut.Omega, mu.factor, 0.05);
  ASSERT_GT(lines.size(), 2U);
  EXPECT_EQ(lines.front().share, 1.0);
  // The tool chatters a little above its own frequency.
  EXPECT_GT(lines.front().frequency, 922);
  EXPECT_LT(lines.front().frequency, 1.1 * 922);
  for (const ChatterLine& line : lines) {
    const double up = (line.frequency - base) / tooth;
    const double down = (line.frequency + base) / tooth;
    EXPECT_LT(
        std::min(std::abs(up - std::round(up)), std::abs(down - std::round(down))),
        1e-6);
  }
}

TEST(Chatter, OfADoubledPeriodLiesHalfwayBetweenTheTeeth) {  // [D-12]
  force::Setup setup = straight_cut(2, geometry::DownMilling{0.5e-3});
  setup.cut.Omega = 17500 * unit::rpm;
  const DirectionalModel model(setup, benchmark_law(), 1e-6, 1e-11);
  const auto cut = model.at_depth(4e-3);
  const auto mu = multiplier(cut, benchmark_system(), setup.cut.Omega, 1e-9);
  EXPECT_EQ(bifurcation_of(mu.value), Bifurcation::period_doubling);
  EXPECT_GT(std::abs(mu.value), 1.3);
  const double tooth = 17500.0 / 60 * 2;  // Hz
  const auto lines =
      chatter_lines(cut, benchmark_system(), setup.cut.Omega, mu.factor, 0.05);
  EXPECT_NEAR(lines.front().frequency, 1.5 * tooth, 1e-6 * tooth);
}

TEST(Chatter, OfNoCutIsTheModeItself) {  // [D-12]
  force::Setup setup = straight_cut(2, geometry::UpMilling{1e-3});
  const DirectionalModel model(setup, benchmark_law(), 1e-6, 1e-11);
  const auto lines = chatter_lines(model.at_depth(1e-12), benchmark_system(),
                                   setup.cut.Omega, 2.0, 0.01);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].frequency, 922 * std::sqrt(1 - 0.011 * 0.011), 1e-5);
}

}  // namespace trochoid::dynamics::lobes_test
