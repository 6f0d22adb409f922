#include <trochoid/base/rounded.h>

#include <gtest/gtest.h>

#include <string>

namespace trochoid::base::rounded_test {

TEST(Rounded, ValuesHaveTheDigitsOfTheirError) {
  EXPECT_EQ(with_error(2596.31, 57.2), "2596 +- 57");
  EXPECT_EQ(with_error(0.17729, 2.94), "0.2 +- 2.9");
  EXPECT_EQ(with_error(905.65, 1478.0), "900 +- 1500");
  EXPECT_EQ(with_error(-7.9012, 0.196), "-7.90 +- 0.20");
  EXPECT_EQ(with_error(1.23456, 0.0996), "1.23 +- 0.10");
  EXPECT_EQ(with_error(107390.0, 145000.0), "110000 +- 150000");
  EXPECT_EQ(with_error(-1e-9, 0.02), "0.000 +- 0.020");
  EXPECT_EQ(with_error(-12.0, 300.0), "-10 +- 300");
  EXPECT_EQ(with_error(-3.0, 300.0), "0 +- 300");
  EXPECT_EQ(with_error(37.123456, 0.0), "37.123");
}

TEST(Rounded, FilesHaveTwoDigitsMoreThanAreKnown) {
  EXPECT_EQ(as_known(2596.3149265, 57.2), "2596.31");
  EXPECT_EQ(as_known(-0.0079012345, 0.00019), "-0.0079012");
  EXPECT_EQ(as_known(0.25, 0.001), "0.25");
  EXPECT_EQ(as_known(1234567.89, 40000.0), "1234568");
  EXPECT_EQ(as_known(1.0 / 3, 0.0), "0.3333333333333333");
}

TEST(Rounded, AbsurdPartsAreNotKnown) {
  EXPECT_EQ(percent(0.4), "40 %");
  EXPECT_EQ(percent(0.0123), "1.2 %");
  EXPECT_EQ(percent(9.62), "not known");
  EXPECT_EQ(percent(std::stod("nan")), "not known");
}

}  // namespace trochoid::base::rounded_test
