#include <trochoid/numerics/parallel.h>
#include <trochoid/numerics/periodic_pieces.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace trochoid::numerics::periodic_pieces_test {

constexpr double pi = std::numbers::pi;

double value_at(const PeriodicPieces& f, double x, std::size_t which = 0) {
  std::vector<double> out(f.functions());
  f.value(x, out);
  return out[which];
}

/// A sine, and one whose negative half is cut off: kinks at 0 and pi.
void sines(double x, std::span<double> out) {
  out[0] = std::sin(x);
  out[1] = std::max(0.0, std::sin(x));
}

PeriodicPieces::Options two(std::vector<double> breaks) {
  return {.start = 0.0,
          .period = 2 * pi,
          .breaks = std::move(breaks),
          .longest = 0.5,
          .shortest = 1e-9,
          .allowed = {1e-10, 1e-10}};
}

TEST(PeriodicPieces, MeetsTheFunctionsEverywhereAndAgainAPeriodLater) {
  const PeriodicPieces f(sines, two({pi}));
  for (double x = -20.0; x < 20.0; x += 0.0773) {
    EXPECT_NEAR(value_at(f, x, 0), std::sin(x), 2e-10) << x;
    EXPECT_NEAR(value_at(f, x, 1), std::max(0.0, std::sin(x)), 2e-10) << x;
  }
}

TEST(PeriodicPieces, AKnownKinkCostsNothing) {
  const PeriodicPieces known(sines, two({pi}));
  EXPECT_EQ(known.panels(), 14U);  // two halves of 3.14 in panels of at most 0.5
  EXPECT_NEAR(value_at(known, pi - 1e-7, 1), 1e-7, 1e-10);
  EXPECT_NEAR(value_at(known, pi + 1e-7, 1), 0.0, 1e-10);
}

TEST(PeriodicPieces, AKinkAPeriodAwayIsTheSameKink) {
  const PeriodicPieces known(sines, two({pi - 6 * pi, 2 * pi, -2 * pi}));
  EXPECT_EQ(known.panels(), 14U);
}

TEST(PeriodicPieces, AnUnknownKinkIsFoundByHalving) {
  PeriodicPieces::Options options = two({});
  options.start = 0.1;  // or the first halving would meet the kink
  const PeriodicPieces f(sines, options);
  EXPECT_GT(f.panels(), 30U);
  double worst = 0.0;
  for (double x = pi - 1e-3; x < pi + 1e-3; x += 1.3e-6) {
    worst = std::max(worst, std::abs(value_at(f, x, 1) - std::max(0.0, std::sin(x))));
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(PeriodicPieces, HalvingStopsAtAJump) {
  PeriodicPieces::Options options = two({});
  options.allowed = {1e-6};
  options.shortest = 1e-4;
  const PeriodicPieces f(
      [](double x, std::span<double> out) { out[0] = x < 1.0 ? 0.0 : 1.0; }, options);
  EXPECT_LT(f.panels(), 60U);
  EXPECT_NEAR(value_at(f, 0.9998), 0.0, 1e-12);
  EXPECT_NEAR(value_at(f, 1.0002), 1.0, 1e-12);
}

TEST(PeriodicPieces, PanelsCoverThePeriodInOrder) {
  PeriodicPieces::Options options = two({1.0, 1.0 + 1e-12, 2.0});
  options.start = 0.7;
  const PeriodicPieces f(sines, options);
  double before = f.start();
  EXPECT_EQ(before, 0.7);
  for (const double end : f.ends()) {
    EXPECT_GT(end, before);
    EXPECT_LE(end - before, 0.5 + 1e-12);
    before = end;
  }
  EXPECT_EQ(before, 0.7 + 2 * pi);
}

TEST(PeriodicPieces, CombinationsAreSumsOfTheFunctions) {
  const PeriodicPieces f(sines, two({pi}));
  const PeriodicPieces g = f.combined(std::array{2.0, 0.0, 1.0, -3.0, 0.0, 1.0});
  ASSERT_EQ(g.functions(), 3U);
  for (double x = -7.0; x < 7.0; x += 0.217) {
    EXPECT_NEAR(value_at(g, x, 0), 2 * value_at(f, x, 0), 1e-14);
    EXPECT_NEAR(value_at(g, x, 1), value_at(f, x, 0) - 3 * value_at(f, x, 1), 1e-14);
    EXPECT_NEAR(value_at(g, x, 2), value_at(f, x, 1), 1e-14);
  }
}

TEST(PeriodicPieces, TheLowerBoundIsBelowEverythingAndNotFar) {
  const PeriodicPieces f(sines, two({pi}));
  EXPECT_LE(f.lower_bound(0), -1.0);
  EXPECT_GT(f.lower_bound(0), -1.2);
  EXPECT_LE(f.lower_bound(1), 1e-10);
  EXPECT_GT(f.lower_bound(1), -0.1);
  const PeriodicPieces g = f.combined(std::array{-2.0, 0.0});
  EXPECT_LE(g.lower_bound(0), -2.0);
  EXPECT_GT(g.lower_bound(0), -2.4);
}

TEST(PeriodicPieces, TheNumberOfThreadsChangesNoBit) {
  PeriodicPieces::Options options = two({});
  options.start = 0.1;
  const PeriodicPieces many(sines, options);
  const ThreadLimit one(1);
  const PeriodicPieces single(sines, options);
  ASSERT_EQ(many.panels(), single.panels());
  for (double x = 0.0; x < 6.3; x += 0.0191) {
    EXPECT_EQ(value_at(many, x, 1), value_at(single, x, 1));
  }
}

TEST(PeriodicPieces, EachFunctionHasItsOwnAccuracy) {
  PeriodicPieces::Options fine = two({});
  fine.start = 0.1;
  PeriodicPieces::Options rough = fine;
  rough.allowed = {1e-10, 1e-2};
  EXPECT_LT(PeriodicPieces(sines, rough).panels(),
            PeriodicPieces(sines, fine).panels());
}

}  // namespace trochoid::numerics::periodic_pieces_test
