#include "made_slice.h"

#include <trochoid/chip/intervals.h>

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::chip::intervals_test {

TEST(Intervals, OfThePaperAreThoseOfTheTheoryPage) {  // [C-5] [C-6]
  const MadeSlice s = paper_slice(Lookback::all);
  const auto one = engaged_arcs(s.passage(), s.slice(), 0);
  const auto two = engaged_arcs(s.passage(), s.slice(), 1);
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(two.size(), 1U);
  EXPECT_NEAR(one[0].from / unit::deg, -0.570, 5e-4);
  EXPECT_NEAR(one[0].to / unit::deg, 180.574, 5e-4);
  EXPECT_NEAR(two[0].from / unit::deg, 11.294, 5e-4);
  EXPECT_NEAR(two[0].to / unit::deg, 168.781, 5e-4);
}

TEST(Intervals, LookingBackAtOneToothWidensThem) {
  const MadeSlice s = paper_slice(Lookback::previous);
  const auto one = engaged_arcs(s.passage(), s.slice(), 0);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_NEAR(one[0].from / unit::deg, -11.85, 5e-3);
  EXPECT_NEAR(one[0].to / unit::deg, 191.78, 5e-3);
}

TEST(ToothArc, IsThatOfTheRadiusOfTheTooth) {
  const Arc slot = tooth_arc(geometry::Slot{}, 8e-3, 4e-3);
  EXPECT_EQ(slot.from, 0.0);
  EXPECT_NEAR(slot.to, pi, 1e-15);
  const Arc up = tooth_arc(geometry::UpMilling{2e-3}, 8e-3, 4e-3);  // y from 2 mm on
  EXPECT_EQ(up.from, 0.0);
  EXPECT_NEAR(up.to, pi / 3, 1e-15);
  const Arc longer = tooth_arc(geometry::DownMilling{2e-3}, 8e-3, 5e-3);
  EXPECT_NEAR(longer.from, std::acos(-2.0 / 5.0), 1e-15);
  EXPECT_NEAR(longer.to, pi, 1e-15);
}

TEST(Intervals, HoldAllThatCutsAndNothingElse) {
  std::mt19937 random(11);
  for (int n = 0; n < 40; ++n) {
    MadeSlice s = random_slice(random, 60e-6);
    if (n % 2 == 1) s.cut.engagement = geometry::Band{-0.2e-3, 1e-3};
    for (int j = 0; j < s.cutter.teeth(); ++j) {
      const auto arcs = engaged_arcs(s.passage(), s.slice(), j);
      for (const double theta : steps(-pi / 2, 1.5 * pi, 0.011)) {
        bool inside = false;
        double distance = 1.0;
        for (const Arc& arc : arcs) {
          for (const double turn : {-2 * pi, 0.0, 2 * pi}) {
            inside |= theta + turn > arc.from && theta + turn < arc.to;
            distance = std::min({distance, std::abs(theta + turn - arc.from),
                                 std::abs(theta + turn - arc.to)});
          }
        }
        if (distance > 1e-6) {
          EXPECT_EQ(s.h(j, theta) > h_threshold, inside)
              << n << " " << j << " " << theta;
        }
      }
    }
  }
}

}  // namespace trochoid::chip::intervals_test
