#include <trochoid/identification/clocking.h>

#include <trochoid/base/units.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

namespace trochoid::identification::clocking_test {

using Complex = std::complex<double>;

Offset exactly(const Complex& e) {
  return {{e.real(), e.imag()}, {}};
}

/// What is measured in both clampings, from tooth 1 each time.
struct Clampings {
  Complex holder = std::polar(10e-6, 50 * unit::deg);
  Complex tool = std::polar(6e-6, -20 * unit::deg);
  double turned = 120 * unit::deg;

  [[nodiscard]] Complex before() const { return holder + tool; }
  [[nodiscard]] Complex now() const {
    return holder * std::polar(1.0, -turned) + tool;  // the holder turns back from it
  }
};

TEST(Clocking, TwoClampingsTellToolAndHolderApart) {  // [I-22]
  const Clampings made;
  const Separation found =
      separate(exactly(made.before()), exactly(made.now()), made.turned);
  EXPECT_NEAR(found.tool.amount(), 6e-6, 1e-15);
  EXPECT_NEAR(found.tool.angle(), -20 * unit::deg, 1e-9);
  EXPECT_NEAR(found.holder.amount(), 10e-6, 1e-15);
  EXPECT_NEAR(found.holder.angle(), 50 * unit::deg, 1e-9);
}

/// From where it stands now, turned once more by what is advised.
TEST(Clocking, TheBestTurnLeavesTheLeast) {  // [I-22]
  Clampings made;
  const Separation found =
      separate(exactly(made.before()), exactly(made.now()), made.turned);
  EXPECT_NEAR(found.best_turn, 130 * unit::deg, 1e-9);
  EXPECT_NEAR(found.least, 4e-6, 1e-15);
  made.turned += found.best_turn;
  EXPECT_NEAR(std::abs(made.now()), found.least, 1e-15);
  made.turned += 5 * unit::deg;
  EXPECT_GT(std::abs(made.now()), found.least + 0.01e-6);
}

TEST(Clocking, CovarianceIsThatOfRepetitions) {  // [I-22]
  const Clampings made;
  Offset before = exactly(made.before());
  Offset now = exactly(made.now());
  before.covariance = {4e-14, 1e-14, 1e-14};
  now.covariance = {1e-14, -0.5e-14, 2e-14};
  const Separation promised = separate(before, now, made.turned);
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 1.0);
  const auto drawn = [&](const Offset& of) {
    const double a = normal(random);
    const double b = normal(random);
    const double l11 = std::sqrt(of.covariance[0]);
    const double l21 = of.covariance[1] / l11;
    const double l22 = std::sqrt(of.covariance[2] - l21 * l21);
    return Offset{{of.e[0] + l11 * a, of.e[1] + l21 * a + l22 * b}, of.covariance};
  };
  constexpr int draws = 4000;
  std::array<double, 6> sums{};
  for (int i = 0; i < draws; ++i) {
    const Separation one = separate(drawn(before), drawn(now), made.turned);
    const auto add = [&](std::size_t at, const Offset& found, const Offset& mean) {
      const double x = found.e[0] - mean.e[0];
      const double y = found.e[1] - mean.e[1];
      sums[at] += x * x / draws;
      sums[at + 1] += x * y / draws;
      sums[at + 2] += y * y / draws;
    };
    add(0, one.tool, promised.tool);
    add(3, one.holder, promised.holder);
  }
  // 4000 draws know a variance to 2.2 %; three times that, of the larger variance.
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(sums[i], promised.tool.covariance[i],
                0.07 * promised.tool.covariance[i == 2 ? 2 : 0])
        << i;
    EXPECT_NEAR(sums[3 + i], promised.holder.covariance[i],
                0.07 * promised.holder.covariance[i == 2 ? 2 : 0])
        << i;
  }
}

TEST(Clocking, AnOffsetByAmountAndAngleKeepsItsErrors) {
  const Offset one = offset_of(12e-6, 0.7, 0.3e-6, 0.02);
  EXPECT_NEAR(one.amount(), 12e-6, 1e-18);
  EXPECT_NEAR(one.angle(), 0.7, 1e-12);
  EXPECT_NEAR(one.amount_se(), 0.3e-6, 1e-15);
  EXPECT_NEAR(one.angle_se(), 0.02, 1e-9);
  EXPECT_TRUE(std::isinf(Offset{}.angle_se()));
}

TEST(Clocking, AToolThatWasNotTurnedTellsNothing) {
  EXPECT_THROW(static_cast<void>(separate({}, {}, 0.0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(separate({}, {}, unit::turn)), std::invalid_argument);
}

TEST(Clocking, TheLongestToothChangesAlongTheHelix) {  // [G-9]
  geometry::Cutter cutter;
  cutter.profile = geometry::cylinder(8 * unit::mm);
  cutter.pitch = geometry::equal_pitch(4);
  cutter.helix = 45 * unit::deg;
  cutter.lag_diameter = 8 * unit::mm;
  geometry::Runout runout{{}, 5 * unit::um, 80 * unit::deg};
  EXPECT_EQ(longest_tooth(cutter, runout, 0.0), 2) << "80 deg on is tooth 2 at 90";
  // A quarter turn of lag higher up, the tooth before stands there.
  const double quarter = unit::turn / 4 * 8 * unit::mm / 2;
  EXPECT_EQ(longest_tooth(cutter, runout, quarter), 1);
  runout.radial_offsets = {0.0, 0.0, 20 * unit::um, 0.0};
  EXPECT_EQ(longest_tooth(cutter, runout, 0.0), 3);
}

}  // namespace trochoid::identification::clocking_test
