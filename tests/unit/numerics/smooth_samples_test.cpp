#include <trochoid/numerics/smooth_samples.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace trochoid::numerics::smooth_samples_test {

namespace {

using Value = std::array<double, 2>;

std::vector<double> places(std::size_t n, double from, double to) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = from + (to - from) * static_cast<double>(i) / static_cast<double>(n);
  }
  return x;
}

/// @return how often f was asked; the values agree with it
template <class Function>
int asked(const std::vector<double>& x, double allowed, const Function& f,
          double widest = 10.0) {
  int count = 0;
  std::vector<Value> out(x.size(), Value{7, 7});
  const auto counted = [&](double at) {
    ++count;
    return f(at);
  };
  sample_smooth(std::span<const double>(x), widest, Value{allowed, 1.0}, counted,
                std::span(out));
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(out[i][0], f(x[i])[0], 2 * allowed) << x[i];
  }
  return count;
}

}  // namespace

TEST(SmoothSamples, AFewDoWhereAFunctionIsSmooth) {
  const auto wave = [](double x) { return Value{std::sin(3 * x), x}; };
  EXPECT_EQ(asked(places(2000, 0, 1), 1e-4, wave), 13);
  EXPECT_LT(asked(places(2000, 0, 1), 1e-12, wave), 300);
  EXPECT_EQ(asked(places(20, 0, 1), 1e-4, wave), 20);
  EXPECT_EQ(asked({}, 1e-4, wave), 0);
}

TEST(SmoothSamples, MoreAroundKinksAndJumps) {
  const auto kink = [](double x) {
    return Value{std::abs(x - 0.312) + (x > 0.7 ? 3.0 : 0.0), 0.0};
  };
  const int count = asked(places(5000, 0, 1), 1e-6, kink);
  EXPECT_GT(count, 50);
  EXPECT_LT(count, 500);
}

TEST(SmoothSamples, NoPartIsWiderThanItMayBe) {
  const auto spike = [](double x) { return Value{std::exp(-1e4 * x * x), 0.0}; };
  EXPECT_GT(asked(places(4000, -1.1, 1), 1e-6, spike, 0.05), 13 * 40);
}

TEST(SmoothSamples, UnevenPlaces) {
  std::vector<double> x = places(500, 0, 1);
  for (double& place : x) place = place * place * place;
  x.erase(x.begin() + 200, x.begin() + 300);
  const auto wave = [](double t) { return Value{std::exp(-t) * std::cos(t), t}; };
  EXPECT_LT(asked(x, 1e-8, wave), 120);
}

TEST(SmoothSamples, EachWhereTheyDoNotAscend) {
  std::vector<double> x = places(100, 0, 1);
  x.push_back(0.5);
  const auto wave = [](double t) { return Value{t * t, t}; };
  EXPECT_EQ(asked(x, 1e-4, wave), 101);
}

}  // namespace trochoid::numerics::smooth_samples_test
