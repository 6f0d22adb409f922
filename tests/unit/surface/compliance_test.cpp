#include "made_wall.h"

#include <gtest/gtest.h>

namespace trochoid::surface::compliance_test {

constexpr Coefficients K = {800e6, 300e6, 9e3, 4e3};

double largest(const std::function<double(double)>& f) {
  double out = 0.0;
  for (const double phi : angles(60)) out = std::max(out, std::abs(f(phi)));
  return out;
}

/// u at a height and an angle of the rooms' own sums.
double bent(const Compliance& compliance, const MadeCut& s, double h, double phi) {
  const EdgeMoments edges(s, law(0, 0), compliance.basis());
  std::vector<double> unit(columns * edges.values());
  edges.at(phi, nullptr, unit);
  const auto row = compliance.rows(std::array{h});
  double u = 0.0;
  for (std::size_t c = 0; c < columns; ++c) {
    for (std::size_t q = 0; q < row.size(); ++q) {
      u += K[c] * row[q] * unit[c * edges.values() + q];
    }
  }
  return u;
}

TEST(Compliance, ADistributedLoadIsTheSumOfItsPointLoads) {  // [E-5] [E-4]
  for (const bool down : {true, false}) {
    const MadeCut s = made_cut(down);
    const Compliance compliance(cutter_only()(0.0), 3e-3, 0.0, Load::distributed);
    for (const double h : {0.0, 0.4e-3, 1.7e-3, 3e-3}) {
      const auto by_hand = [&](double phi) {
        return weighted_force(s, K, phi, [&](double z) {
          return structure::compliance(made_cutter(), h, z);
        });
      };
      const double size = largest(by_hand);
      ASSERT_GT(size, 10e-6);
      for (const double phi : angles(40)) {
        EXPECT_NEAR(bent(compliance, s, h, phi), by_hand(phi), 1e-8 * size);
      }
    }
  }
}

TEST(Compliance, AWallAddsItsOwnDeflection) {  // [E-5]
  const MadeCut s = made_cut();
  const double x = 20e-3;
  const Bodies bodies = with_wall()(x);
  const Compliance compliance(bodies, 3e-3, x, Load::distributed);
  const double tip = 27e-3;
  for (const double h : {0.3e-3, 2.2e-3}) {
    // the influence of the wall at many heights, interpolated between by a parabola
    std::vector<double> z;
    for (int i = 0; i <= 60; ++i) z.push_back(tip + 3e-3 * i / 60);
    const auto G = bodies.wall->plate->influence(x, std::array{tip + h}, x, z);
    const auto wall = [&](double at) {
      const auto i = std::min<std::size_t>(
          58, static_cast<std::size_t>(std::max(0.0, at / 3e-3 * 60)));
      const double t = at / 3e-3 * 60 - static_cast<double>(i);
      return G[i] * (1 - t) * (2 - t) / 2 + G[i + 1] * t * (2 - t) -
             G[i + 2] * t * (1 - t) / 2;
    };
    const auto by_hand = [&](double phi) {
      return weighted_force(s, K, phi, [&](double at) {
        return structure::compliance(made_cutter(), h, at) + wall(at);
      });
    };
    const double size = largest(by_hand);
    for (const double phi : angles(25)) {
      EXPECT_NEAR(bent(compliance, s, h, phi), by_hand(phi), 2e-5 * size);
    }
  }
}

TEST(Compliance, AConcentratedLoadIsTheWholeForceInTheMiddle) {  // [E-6]
  const MadeCut s = made_cut();
  const double x = 30e-3;
  const Bodies bodies = with_wall()(x);
  const Compliance compliance(bodies, 3e-3, x, Load::concentrated);
  for (const double h : {0.0, 1.1e-3, 3e-3}) {
    const double line =
        bodies.wall->plate->line_load(x, std::array{27e-3 + h}, x, 27e-3, 30e-3)[0];
    const double c = structure::compliance(made_cutter(), h, 1.5e-3) + line;
    for (const double phi : angles(25)) {
      const double F = weighted_force(s, K, phi, [](double) { return 1.0; });
      EXPECT_NEAR(bent(compliance, s, h, phi), c * F, 1e-12);
    }
  }
}

TEST(Compliance, OfThePaperIsKnown) {  // [E-6] [wang2015]: 1.0715 um/N at 0.5 mm
  const Compliance compliance(cutter_only()(0.0), 3e-3, 0.0, Load::concentrated);
  EXPECT_NEAR(compliance.rows(std::array{0.5e-3})[0], 1.071531835513634e-6, 1e-15);
}

TEST(Compliance, RigidBodiesDoNotMove) {  // [E-4]
  for (const Load load : {Load::distributed, Load::concentrated}) {
    const Compliance compliance(Bodies{}, 3e-3, 0.0, load);
    for (const double g : compliance.rows(std::array{0.0, 1e-3, 3e-3})) {
      EXPECT_EQ(g, 0.0);
    }
  }
  const HeightCut cut =
      height_cut(made_setting(Model::imprint, made_cut(), rigid()), K, 1e-3);
  for (const double phi : angles(50)) EXPECT_EQ(value_at(cut.deflection, phi), 0.0);
}

TEST(Compliance, CutterAndWallAddUp) {  // [E-5]
  const double x = 12e-3;
  const Compliance both(with_wall()(x), 3e-3, x, Load::distributed);
  const std::array h = {0.0, 0.7e-3, 3e-3};
  const auto cutter = both.of_cutter(h, both.basis().points());
  const auto wall = both.of_wall(h, both.basis().points());
  const auto rows = both.rows(h);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_DOUBLE_EQ(rows[i], cutter[i] + wall[i]);
    EXPECT_GT(wall[i], 0.0);
    EXPECT_GT(cutter[i], 0.0);
  }
}

TEST(Compliance, AboveTheCutThereIsNoWall) {
  const Compliance both(with_wall()(12e-3), 3e-3, 12e-3, Load::distributed);
  const auto G = both.of_wall(std::array{1e-3, 3.5e-3}, std::array{2e-3, 4e-3});
  EXPECT_GT(G[0], 0.0);
  EXPECT_EQ(G[1], 0.0);
  EXPECT_EQ(G[2], 0.0);
  EXPECT_EQ(G[3], 0.0);
}

TEST(Compliance, TheTopOfTheCutIsOnTheWallWhateverTheRounding) {
  // 30 - a_p + a_p need not be 30
  for (const double a_p : {0.7e-3, 1.1e-3, 2.3e-3, 3.3e-3, 4.7e-3, 6.1e-3, 7.9e-3}) {
    for (const Load load : {Load::distributed, Load::concentrated}) {
      const Compliance both(with_wall()(30e-3), a_p, 30e-3, load);
      EXPECT_NO_THROW((void)both.rows(std::array{0.0, a_p})) << a_p;
    }
  }
}

TEST(Turn, DeflectionIsTheRowTimesTheMoments) {  // [E-4]
  for (const bool down : {true, false}) {
    const MadeCut s = with_runout(made_cut(down), 10e-6, 0.4);
    const Compliance compliance(cutter_only()(0.0), 3e-3, 0.0, Load::distributed);
    const EdgeMoments edges(s, law(0, 0), compliance.basis());
    const auto unit = unit_moments(edges, 1e-7);
    const auto row = compliance.rows(std::array{0.8e-3});
    const double sigma = down ? 1.0 : -1.0;
    const auto one = deflection(with_coefficients(unit, K), row, sigma);
    const auto each = deflection(unit, row, sigma);
    ASSERT_EQ(one.functions(), 1U);
    ASSERT_EQ(each.functions(), columns);
    for (const double phi : angles(50)) {
      const double want = sigma * bent(compliance, s, 0.8e-3, phi);
      EXPECT_NEAR(value_at(one, phi), want, 1e-10);
      double sum = 0.0;
      for (std::size_t c = 0; c < columns; ++c) sum += K[c] * value_at(each, phi, c);
      EXPECT_NEAR(sum, value_at(one, phi), 1e-16);
    }
  }
}

TEST(Turn, DownMillingLeavesMaterialUpMillingMayDigIn) {  // [E-1] [E-4]
  const HeightCut down = height_cut(made_setting(Model::imprint), {800e6, 300e6}, 1e-3);
  const HeightCut up =
      height_cut(made_setting(Model::imprint, made_cut(false)), {800e6, 300e6}, 1e-3);
  double least = 1.0;
  double lowest = 0.0;
  for (const double phi : angles(100)) {
    least = std::min(least, value_at(down.deflection, phi));
    lowest = std::min(lowest, value_at(up.deflection, phi));
  }
  EXPECT_GT(least, -1e-9);
  EXPECT_LT(lowest, -1e-6);  // -K_t sin + K_r cos
}

}  // namespace trochoid::surface::compliance_test
