#include <trochoid/numerics/student.h>
#include <trochoid/sweep/distribution.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace trochoid::sweep::distribution_test {

using results::Joint;
using Values = std::vector<double>;

constexpr std::size_t draws = 20000;

/// Two numbers with standard deviations of 30 and 2 and a correlation.
Joint two(double correlation, double factor = 1.96) {
  const double both = correlation * 30 * 2;
  return {.names = {"force.K_tc_MPa", "force.K_te_N_per_mm"},
          .values = {800, 10},
          .factors = {factor, factor},
          .covariance = {900, both, both, 4}};
}

/// Columns of many draws, shape (numbers, draws).
std::vector<Values> many(const Joint& joint, bool stratified = false) {
  const Distribution d = distribution_of(joint).value();
  std::mt19937_64 random(3);
  const Values chance = chances(random, d.chances(), draws, stratified);
  std::vector<Values> columns(d.size());
  for (std::size_t i = 0; i < draws; ++i) {
    Values own;
    for (std::size_t c = 0; c < d.chances(); ++c) {
      own.push_back(chance[c * draws + i]);
    }
    const Values x = drawn(d, own);
    for (std::size_t k = 0; k < x.size(); ++k) {
      columns[k].push_back(x[k]);
    }
  }
  return columns;
}

double mean(const Values& x) {
  double sum = 0.0;
  for (const double v : x) {
    sum += v;
  }
  return sum / static_cast<double>(x.size());
}

double covariance(const Values& x, const Values& y) {
  const double mx = mean(x);
  const double my = mean(y);
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += (x[i] - mx) * (y[i] - my);
  }
  return sum / static_cast<double>(x.size() - 1);
}

double part_within(const Values& x, double low, double high) {
  return static_cast<double>(
             std::ranges::count_if(x, [&](double v) { return low < v && v < high; })) /
         static_cast<double>(x.size());
}

TEST(Draws, HaveTheCovarianceThatIsStated) {  // [U-1] [U-4]
  for (const bool stratified : {false, true}) {
    const auto x = many(two(-0.9), stratified);
    EXPECT_NEAR(mean(x[0]), 800, 0.7);
    EXPECT_NEAR(mean(x[1]), 10, 0.05);
    EXPECT_NEAR(covariance(x[0], x[0]), 900, 30);
    EXPECT_NEAR(covariance(x[1], x[1]), 4, 0.13);
    EXPECT_NEAR(covariance(x[0], x[1]), -54, 2);
  }
}

// The numbers are those of tests/reference/uncertainty.py.
TEST(Draws, AreThoseOfTheFormulaForGivenChances) {  // [U-2] [U-3] [U-4] [U-5]
  Joint joint = two(-0.9);
  joint.factors = {numerics::student_t(0.975, 8), 1.96};
  const Values x = drawn(distribution_of(joint).value(), Values{0.3, 0.8, 0.6});
  EXPECT_NEAR(x[0], 784.6017114590874, 1e-6);
  EXPECT_NEAR(x[1], 11.67762930405095, 1e-8);
  const Joint of_mode{.names = {"mode[1].frequency_Hz", "mode[1].mass_kg"},
                      .values = {900, 0.04},
                      .factors = {1.96, 1.96},
                      .covariance = {81, 0.018, 0.018, 1.6e-5}};
  const Distribution d = distribution_of(of_mode).value();
  const Values y = drawn(d, Values{0.9, 0.2, 0.5});
  EXPECT_NEAR(y[0], 911.6081876708294, 1e-9);
  EXPECT_NEAR(y[1], 0.039649189064544836, 1e-14);
}

TEST(Draws, FollowTheCorrelation) {
  // 0.08 mm of chip: what the record knows is the sum.
  const auto spread_of_sum = [](double correlation) {
    const auto x = many(two(correlation));
    Values sum;
    for (std::size_t i = 0; i < draws; ++i) {
      sum.push_back(0.08 * x[0][i] + x[1][i]);
    }
    return std::sqrt(covariance(sum, sum));
  };
  EXPECT_NEAR(spread_of_sum(-0.95), std::sqrt(5.76 + 4 - 2 * 0.95 * 4.8), 0.03);
  EXPECT_NEAR(spread_of_sum(0), std::sqrt(9.76), 0.06);
}

TEST(Draws, LieInTheIntervalOfEachAsOftenAsItSays) {  // [U-3]
  for (const double nu : {2.5, 8.0, 1e9}) {
    const double w = std::max(1.96, numerics::student_t(0.975, nu));
    const auto x = many(two(0.7, w));
    EXPECT_NEAR(part_within(x[0], 800 - w * 30, 800 + w * 30), 0.95, 0.006) << nu;
    EXPECT_NEAR(part_within(x[1], 10 - w * 2, 10 + w * 2), 0.95, 0.006) << nu;
  }
}

TEST(Draws, WithFactorsOfTheirOwnKeepTheIntervalOfEach) {
  Joint joint = two(0.7);
  joint.factors = {numerics::student_t(0.975, 3), numerics::student_t(0.975, 30)};
  const auto x = many(joint);
  for (std::size_t k = 0; k < 2; ++k) {
    const double half = joint.factors[k] * (k == 0 ? 30 : 2);
    const double at = joint.values[k];
    EXPECT_NEAR(part_within(x[k], at - half, at + half), 0.95, 0.006);
  }
}

TEST(FreedomOf, IsTheInverseOfStudentsQuantile) {
  for (const double nu : {1.0, 3.7, 20.0, 400.0}) {
    EXPECT_NEAR(freedom_of(numerics::student_t(0.975, nu)) / nu, 1, 1e-6);
  }
  EXPECT_EQ(freedom_of(1.96), 0);
  EXPECT_EQ(freedom_of(1.9599), 0);
}

Joint mode(double part) {
  const Values at = {900, 0.02, 0.04};
  Joint joint{
      .names = {"mode[1].frequency_Hz", "mode[1].damping_ratio", "mode[1].mass_kg"},
      .values = at,
      .factors = {1.96, 1.96, 1.96},
      .covariance = Values(9, 0.0)};
  for (std::size_t i = 0; i < 3; ++i) {
    joint.covariance[4 * i] = part * part * at[i] * at[i];
  }
  return joint;
}

TEST(DrawsOfAMode, AreNeverBelowZeroHoweverWide) {  // [U-5]
  const auto x = many(mode(0.6));
  for (const Values& column : x) {
    EXPECT_GT(*std::ranges::min_element(column), 0);
  }
  // Drawn as they are, one in twenty were: the interval reaches to -0.18 of the value.
  EXPECT_NEAR(
      part_within(x[1], 0.02 * std::exp(-1.96 * 0.6), 0.02 * std::exp(1.96 * 0.6)),
      0.95, 0.006);
}

TEST(DrawsOfAMode, AreNormalWithinANarrowInterval) {
  const auto x = many(mode(0.01));
  for (std::size_t k = 0; k < 3; ++k) {
    const double at = mode(0.01).values[k];
    EXPECT_NEAR(mean(x[k]) / at, 1, 3e-4);
    EXPECT_NEAR(std::sqrt(covariance(x[k], x[k])) / at, 0.01, 2e-4);
  }
}

TEST(Distribution, IsNoneOfWhatIsNoCovariance) {
  EXPECT_FALSE(distribution_of(two(1.2)));
  Joint joint = mode(0.1);
  joint.values[2] = -0.04;
  EXPECT_FALSE(distribution_of(joint));
}

}  // namespace trochoid::sweep::distribution_test
