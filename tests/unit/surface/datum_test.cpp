#include <trochoid/surface/datum.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace trochoid::surface::datum_test {

/// Column of a datum parameter.
std::vector<double> column(const DatumColumns& columns, std::size_t k) {
  std::vector<double> out;
  for (std::size_t i = k; i < columns.values.size(); i += columns.count) {
    out.push_back(columns.values[i]);
  }
  return out;
}

using Values = std::vector<double>;

TEST(Datum, NothingIsAskedNothingIsAdded) {  // [E-15]
  const std::array spots = {Spot{0.0, 1e-3, 0}, Spot{1e-3, 2e-3, 0}};
  EXPECT_EQ(datum_columns(spots, std::array{Datum{}}).count, 0U);
  EXPECT_EQ(datum_columns(spots, std::span<const Datum>{}).count, 0U);
}

TEST(Datum, EachMeasurementHasItsOwn) {  // [E-15]
  const std::array spots = {Spot{0.0, 1e-3, 0}, Spot{4e-3, 3e-3, 0},
                            Spot{9e-3, 1e-3, 1}, Spot{9e-3, 2e-3, 1}};
  const auto c =
      datum_columns(spots, std::array{Datum{true, true}, Datum{true, false}});
  ASSERT_EQ(c.count, 4U);
  EXPECT_EQ(column(c, 0), (Values{1, 1, 0, 0}));
  EXPECT_EQ(column(c, 1), (Values{-2e-3, 2e-3, 0, 0}));  // along, about the middle
  EXPECT_EQ(column(c, 2), (Values{-1e-3, 1e-3, 0, 0}));  // over the height
  EXPECT_EQ(column(c, 3), (Values{0, 0, 1, 1}));
}

TEST(Datum, AtOnePlaceThereIsNoSlopeAlongTheFeed) {  // [E-15]
  const std::array spots = {Spot{5e-3, 1e-3, 0}, Spot{5e-3, 3e-3, 0}};
  const auto c = datum_columns(spots, std::array{Datum{true, true}});
  ASSERT_EQ(c.count, 2U);
  EXPECT_EQ(column(c, 1), (Values{-1e-3, 1e-3}));
}

TEST(Datum, RoundingIsNoMoveAlongTheFeed) {  // [E-15]
  // means of the same places in another order differ in their last bits
  const double x = 30.2e-3;
  const std::array spots = {Spot{x, 1e-3, 0}, Spot{std::nextafter(x, 1.0), 3e-3, 0},
                            Spot{x, 2e-3, 0}};
  EXPECT_EQ(datum_columns(spots, std::array{Datum{true, true}}).count, 2U);
}

TEST(Datum, AnEstimateHasTheIntervalOfStudent) {  // [E-15]
  const Estimate e = estimate(5.0, 4.0, 10);      // t of 97.5 % with 10: 2.228139
  EXPECT_EQ(e.value, 5.0);
  EXPECT_DOUBLE_EQ(e.se, 2.0);
  EXPECT_NEAR(e.low, 5.0 - 2 * 2.228139, 1e-5);
  EXPECT_NEAR(e.high, 5.0 + 2 * 2.228139, 1e-5);
}

TEST(Datum, WithoutDegreesOfFreedomNothingIsKnownOfTheError) {  // [E-15]
  const Estimate e = estimate(5.0, 4.0, 0);
  EXPECT_EQ(e.value, 5.0);
  EXPECT_TRUE(std::isnan(e.se));
  EXPECT_TRUE(std::isnan(e.low));
}

}  // namespace trochoid::surface::datum_test
