#include "made_cut.h"

#include <trochoid/force/closed_form.h>
#include <trochoid/force/turn_kernel.h>
#include <trochoid/force/turn_numbers.h>
#include <trochoid/force/turn_polynomial.h>

#include <gtest/gtest.h>

namespace trochoid::force::turn_test {

TurnPolynomial turn_of(const MadeCut& setup) {
  const auto teeth = turn_teeth(setup, 1e-12);
  EXPECT_TRUE(teeth);
  return turn_polynomial(*teeth, force_weights(terms(steel())));
}

std::vector<Vector3> at(const TurnPolynomial& turn, std::span<const double> phi) {
  std::vector<Vector3> out(phi.size());
  evaluate(turn, phi, {out.front().data(), 3 * out.size()});
  return out;
}

/// A runout beyond the feed and a stock that cuts some chips short.
MadeCut lively_cut() {
  MadeCut s = slot(geometry::cylinder(8e-3), 3, 35);
  s.runout.radial_offsets = {0.0, 60e-6, -9e-6};
  s.cut.engagement = geometry::UpMilling{3e-3};
  return s;
}

TEST(Turn, HasFewSegmentsAtAnyDepth) {  // [F-11] [F-12]
  MadeCut s = slot(geometry::cylinder(8e-3), 2, 30);
  s.runout.radial_offsets = {0.0, -8e-6};
  for (const double a_p : {0.1e-3, 2e-3, 60e-3}) {
    s.cut.a_p = a_p;
    const TurnPolynomial turn = turn_of(s);
    EXPECT_LE(turn.ends.size(), 17u);
    EXPECT_EQ(turn.ends.back(), unit::turn);
    EXPECT_EQ(turn.first_panel.size(), turn.ends.size() + 1);
  }
}

TEST(Turn, NeedsNoOrder) {  // [F-12]
  const TurnPolynomial turn = turn_of(lively_cut());
  const auto phi = force::turn(1500);
  const auto sorted = at(turn, phi);
  std::vector<std::size_t> order(phi.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::mt19937 random(1);
  std::shuffle(order.begin(), order.end(), random);
  std::vector<double> mixed;
  for (const std::size_t i : order) {
    mixed.push_back(phi[i] + unit::turn * (static_cast<double>(i % 7) - 3));
  }
  const auto F = at(turn, mixed);
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t q = 0; q < 3; ++q) {
      EXPECT_NEAR(F[i][q], sorted[order[i]][q], 1e-10 * peak(sorted));
    }
  }
}

TEST(Turn, IsExactlyZeroInAir) {  // [F-11]
  MadeCut s = slot(geometry::cylinder(8e-3), 1, 30);
  s.cut.engagement = geometry::DownMilling{1e-3};
  const auto phi = force::turn(360);
  std::size_t zeros = 0;
  for (const Vector3& F : at(turn_of(s), phi)) zeros += F == Vector3{};
  EXPECT_GT(zeros, 200u);
}

TEST(Turn, OfAStraightEdgeJumpsWhereItIsToldTo) {  // [F-13]
  MadeCut s = slot(geometry::cylinder(8e-3), 2, 0);
  s.cut.engagement = geometry::UpMilling{2e-3};
  s.chip.model = chip::Model::feed;
  const TurnPolynomial turn = turn_of(s);
  const double exit = std::acos(0.5);  // y_lo = R - a_e
  const std::array<double, 6> phi = {
      0.0, 1e-9, exit - 1e-9, exit, exit + pi - 1e-9, exit + pi};
  const auto F = at(turn, phi);
  EXPECT_EQ(F[0], Vector3{});               // where cutting begins it has not begun
  EXPECT_NEAR(F[1][2], -1e3 * 2e-3, 1e-6);  // the edge force alone
  EXPECT_LT(F[2][2], -2.0);
  EXPECT_EQ(F[3], Vector3{});  // where it ends it has ended
  EXPECT_NEAR(F[4][2], F[2][2], 1e-9);
  EXPECT_EQ(F[5], Vector3{});
}

TEST(Turn, JumpsWhereAStraightEdgeComesInAndOut) {  // [F-13]
  MadeCut s = slot(geometry::cylinder(8e-3), 3, 0);
  s.chip.model = chip::Model::feed;
  s.cut.engagement = geometry::UpMilling{2e-3};
  const double exit = std::acos(0.5);
  std::vector<double> expected;
  for (int k = 0; k < 3; ++k) {
    expected.push_back(k * 2 * pi / 3);
    expected.push_back(k * 2 * pi / 3 + exit);
  }
  const auto found = jumps(turn_of(s), 1e-6);
  ASSERT_EQ(found.size(), expected.size());
  // just within what counts as in cut: sin(theta) f_z > 1e-15 m
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], 4e-11);
  }
  s.cutter.helix = 0.1;
  EXPECT_TRUE(jumps(turn_of(s), 1e-6).empty());
}

TEST(Turn, OfAShortLagGrowsByDegrees) {  // [F-13]
  MadeCut s = slot(geometry::cylinder(8e-3), 1, 0);
  s.cut.engagement = geometry::DownMilling{2e-3};
  s.cutter.helix = 1e-6;
  s.chip.model = chip::Model::feed;
  const double lag = 2 * std::tan(s.cutter.helix) * s.cut.a_p / 8e-3;
  ASSERT_LT(lag, 1e-6);
  const TurnPolynomial turn = turn_of(s);
  // out of the cut at the end of down milling, but for the share that lags
  const double before = at(turn, std::vector{pi - 2 * lag}).front()[2];
  for (const double share : {0.0, 0.3, 0.9}) {
    const double F = at(turn, std::vector{pi + share * lag}).front()[2];
    EXPECT_NEAR(F, before * (1 - share), 1e-3 * std::abs(before));  // h = 0 there
  }
  // long and short lags meet
  const auto phi = force::turn(97);
  s.cut.engagement = geometry::Slot{};
  s.cutter.helix = 0.99e-6 * 8e-3 / (2 * s.cut.a_p);
  const auto shorter = at(turn_of(s), phi);
  s.cutter.helix = 1.01e-6 * 8e-3 / (2 * s.cut.a_p);
  EXPECT_LE(difference(at(turn_of(s), phi), shorter), 3e-8 * peak(shorter));
}

TEST(Turn, MeanIsTheFormula) {  // [F-8] [F-14]
  MadeCut s = slot(geometry::cylinder(8e-3), 3, 30);
  s.chip.model = chip::Model::none;
  const auto formula = closed_form_mean(s, steel());
  ASSERT_TRUE(formula);
  const auto found = mean(turn_of(s));
  for (std::size_t q = 0; q < 3; ++q) {
    EXPECT_NEAR(found[q], (*formula)[q], 1e-12 * std::abs((*formula)[0]));
  }
}

TEST(Turn, HarmonicsAreThoseOfManySamples) {  // [F-14]
  for (const double helix : {35 * unit::deg, 0.0}) {
    MadeCut s = lively_cut();
    s.cutter.helix = helix;
    const TurnPolynomial turn = turn_of(s);
    const auto phi = force::turn(100000);
    const auto F = at(turn, phi);
    // Kinks cost the sum (2 pi/n)^2, jumps 2 pi/n.
    const double allowed = (helix > 0 ? 1e-8 : 3e-4) * peak(F);
    for (const int n : {0, 1, 2, 3, 17}) {
      const auto c = harmonic(turn, n);
      std::array<std::complex<double>, 3> sum{};
      for (std::size_t i = 0; i < phi.size(); ++i) {
        for (std::size_t q = 0; q < 3; ++q)
          sum[q] += F[i][q] * std::polar(1e-5, -n * phi[i]);
      }
      for (std::size_t q = 0; q < 3; ++q)
        EXPECT_LE(std::abs(c[q] - sum[q]), allowed) << n;
    }
  }
}

TEST(Turn, SlopeIsTheDifferenceQuotient) {  // [F-12]
  const TurnPolynomial turn = turn_of(lively_cut());
  const auto phi = force::turn(2000);
  const auto slope = at(derivative(turn), phi);
  constexpr double step = 1e-6;
  std::vector<double> before(phi);
  std::vector<double> after(phi);
  for (double& x : before) x -= step;
  for (double& x : after) x += step;
  const auto lower = at(turn, before);
  const auto upper = at(turn, after);
  int compared = 0;
  for (std::size_t i = 0; i < phi.size(); ++i) {
    const bool near_an_end =
        std::any_of(turn.ends.begin(), turn.ends.end(),
                    [&](double end) { return std::abs(end - phi[i]) < 2 * step; });
    if (near_an_end) continue;
    ++compared;
    for (std::size_t q = 0; q < 3; ++q) {
      EXPECT_NEAR(slope[i][q], (upper[i][q] - lower[i][q]) / (2 * step),
                  1e-5 * peak(slope));
    }
  }
  EXPECT_GT(compared, 1900);
}

TEST(Turn, ExtremesAreNotBelowAnySample) {  // [F-12]
  for (const double helix : {35 * unit::deg, 0.0}) {
    MadeCut s = lively_cut();
    s.cutter.helix = helix;
    const TurnPolynomial turn = turn_of(s);
    const auto F = at(turn, force::turn(100000));
    const auto found = extremes(turn);
    for (std::size_t q = 0; q < 3; ++q) {
      double min = 0.0;
      double max = 0.0;
      for (const Vector3& f : F) {
        min = std::min(min, f[q]);
        max = std::max(max, f[q]);
      }
      const double near = 1e-3 * peak(F);  // of a jump or a sharp top
      EXPECT_GE(found[q].max.value, max - 1e-9);
      EXPECT_LE(found[q].max.value, max + near);
      EXPECT_LE(found[q].min.value, min + 1e-9);
      EXPECT_GE(found[q].min.value, min - near);
      EXPECT_NEAR(at(turn, std::vector{found[q].max.phi}).front()[q],
                  found[q].max.value, 1e-9);
    }
  }
}

TEST(Turn, IsForCylindersOfConstantLeadOnly) {  // [F-10]
  EXPECT_FALSE(turn_teeth(slot(geometry::ball(8e-3), 2, 30), 1e-9));
  MadeCut s = slot(geometry::cylinder(8e-3), 2, 30);
  EXPECT_TRUE(turn_teeth(s, 1e-9));
  s.runout.eccentricity = 5e-6;
  EXPECT_FALSE(turn_teeth(s, 1e-9));
  s.runout = {};
  s.cut.f_z = 2e-3;  // the feed is half of the radius: too many harmonics
  EXPECT_FALSE(turn_teeth(s, 1e-9));
}

}  // namespace trochoid::force::turn_test
