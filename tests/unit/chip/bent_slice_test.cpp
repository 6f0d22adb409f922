#include "made_slice.h"

#include <gtest/gtest.h>

#include <array>

namespace trochoid::chip::bent_slice_test {

constexpr std::array models = {Model::none, Model::feed, Model::radial,
                               Model::trochoidal};

MadeSlice in_stock(geometry::Engagement engagement, Model model) {
  MadeSlice made = made_slice(12e-3, 3, 80e-6, {.eccentricity = 9e-6, .angle = 0.7});
  made.cut.engagement = engagement;
  made.model.model = model;
  return made;
}

TEST(BentSlice, MovingTheAxisIsMovingTheStockTheOtherWay) {  // [E-10]
  const double s = 0.2e-3;
  for (const Model model : models) {
    const MadeSlice here = in_stock(geometry::Band{-5e-3, 2e-3}, model);
    const MadeSlice there = in_stock(geometry::Band{-5e-3 - s, 2e-3 - s}, model);
    Slice bent = here.slice();
    bent.shift = s;
    int cutting = 0;
    for (const double theta : steps(-1.0, 4.0, 0.0137)) {
      const Chip a = chip_at(here.passage(), bent, 1, theta);
      const Chip b = chip_at(there.passage(), there.slice(), 1, theta);
      EXPECT_EQ(a.in_cut, b.in_cut) << theta;
      EXPECT_NEAR(a.h, b.h, 1e-15) << theta;
      cutting += a.in_cut ? 1 : 0;
    }
    EXPECT_GT(cutting, 20);
  }
}

TEST(BentSlice, ACutterPushedAwayMeetsTheStockLater) {  // [E-10]
  // down: y <= -5 mm; the axis stands 0.1 mm away from it
  const MadeSlice made = in_stock(geometry::DownMilling{1e-3}, Model::radial);
  Slice bent = made.slice();
  bent.shift = 0.1e-3;
  const double entry = std::acos(-5.1 / 6.0);
  EXPECT_FALSE(chip_at(made.passage(), bent, 0, entry - 1e-6).in_cut);
  EXPECT_TRUE(chip_at(made.passage(), bent, 0, entry + 1e-6).in_cut);
  EXPECT_TRUE(chip_at(made.passage(), made.slice(), 0, entry - 1e-6).in_cut);
}

TEST(BentSlice, TheSmallestGainOverAMarkCounts) {  // [E-10]
  // equal teeth: h over the mark of the m-th tooth before is m f_z sin(theta) + gain
  MadeSlice made = made_slice(12e-3, 3, 80e-6);
  made.model.model = Model::radial;
  const double f = 80e-6 * std::sin(1.1);
  const auto h = [&](std::array<double, 3> gain) {
    Slice bent = made.slice();
    bent.advance = gain;
    return chip_at(made.passage(), bent, 2, 1.1).h;
  };
  EXPECT_NEAR(h({0, 0, 0}), f, 1e-15);
  EXPECT_NEAR(h({5e-6, 0, 0}), f + 5e-6, 1e-15);
  EXPECT_NEAR(h({-5e-6, 0, 0}), f - 5e-6, 1e-15);
  EXPECT_NEAR(h({0, -1.5 * f, 0}), 0.5 * f, 1e-15);
  EXPECT_NEAR(h({3 * f, 3 * f, 0}), 3 * f, 1e-15);
  EXPECT_EQ(h({0, 0, -4 * f}), 0.0);
}

TEST(BentSlice, TheExactChipGrowsByTheGainAsWell) {  // [E-10]
  MadeSlice made = made_slice(12e-3, 3, 80e-6);
  made.model.model = Model::trochoidal;
  Slice bent = made.slice();
  const std::array gain = {3e-6, 0.0, 0.0};
  bent.advance = gain;
  for (const double theta : steps(0.3, 2.8, 0.1)) {
    EXPECT_NEAR(chip_at(made.passage(), bent, 0, theta).h, made.h(0, theta) + 3e-6,
                1e-15);
  }
}

TEST(BentSlice, TheBoundaryIsWhereTheBentChipBegins) {  // [E-10]
  const MadeSlice made = in_stock(geometry::DownMilling{1e-3}, Model::radial);
  Slice bent = made.slice();
  bent.shift = -0.15e-3;
  const Passage p = made.passage();
  const double entry = std::acos(-4.85 / 6.0);
  const Chip air = chip_at(p, bent, 0, entry - 0.02);
  const Chip cut = chip_at(p, bent, 0, entry + 0.02);
  ASSERT_FALSE(air.in_cut);
  ASSERT_TRUE(cut.in_cut);
  const double before = boundary(p, bent, 0, entry - 1e-7, air, cut);
  const double after = boundary(p, bent, 0, entry + 1e-7, air, cut);
  EXPECT_LT(before * after, 0.0);
}

}  // namespace trochoid::chip::bent_slice_test
