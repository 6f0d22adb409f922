#include "made_cut.h"

#include <trochoid/force/axial.h>
#include <trochoid/force/closed_form.h>
#include <trochoid/force/cumulative.h>

#include <gtest/gtest.h>

namespace trochoid::force::methods_test {

/// A cylinder in any cut with any chip.
MadeCut random_setup(std::mt19937& random) {
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  const auto one_of = [&](int n) {
    return std::uniform_int_distribution<int>(0, n - 1)(random);
  };
  MadeCut s =
      slot(geometry::cylinder(between(4e-3, 25e-3)), 1 + one_of(5), between(5, 55));
  double sum = 0.0;
  for (double& p : s.cutter.pitch) sum += p = between(0.7, 1.3);
  for (double& p : s.cutter.pitch) {
    p *= 2 * pi / sum;
    s.runout.radial_offsets.push_back(between(-60e-6, 60e-6));
  }
  const double D = s.cutter.profile.D;
  const std::array<geometry::Engagement, 4> cuts{
      geometry::Slot{}, geometry::UpMilling{between(0.05, 1) * D},
      geometry::DownMilling{between(0.05, 1) * D},
      geometry::Band{between(-0.5, 0) * D, between(0.05, 0.4) * D}};
  s.cut.engagement = cuts[static_cast<std::size_t>(one_of(4))];
  s.cut.a_p = between(0.1e-3, 1.5 * D);
  s.cut.f_z = between(5e-6, 150e-6);
  s.chip.model = static_cast<chip::Model>(one_of(4));
  s.edge_length = one_of(2) == 0 ? EdgeLength::true_length : EdgeLength::axial;
  return s;
}

std::vector<Vector3> along_the_edge(const MadeCut& setup, const Law& law,
                                    std::span<const double> phi) {
  std::vector<SixLoads> loads(phi.size());
  AxialForce(setup, law, 1e-11).loads(phi, 0.0, loads);
  std::vector<Vector3> out;
  for (const SixLoads& v : loads) {
    out.push_back({v[0], v[1], v[2]});
  }
  return out;
}

TEST(Methods, SummingOverAnglesIsSummingAlongTheEdge) {  // [F-4] [F-5]
  std::mt19937 random(5);
  for (int n = 0; n < 40; ++n) {
    const MadeCut setup = random_setup(random);
    const Law law = n % 3 == 0 ? Law(aluminium()) : Law(steel());
    ASSERT_TRUE(keeps_radius(setup));
    const auto phi = turn(48);
    const auto F = forces(setup, law, phi, 1e-10);
    EXPECT_LE(difference(F, along_the_edge(setup, law, phi)), 1e-8 * peak(F)) << n;
  }
}

TEST(Methods, AnglesCloseTogetherAreFollowedByPolynomials) {  // [F-4]
  MadeCut ball = slot(geometry::ball(10e-3), 2, 30);
  ball.runout.eccentricity = 10e-6;
  ball.cut.a_p = 2e-3;
  ball.cut.f_z = 80e-6;
  const Law law = LinearEdge{.K_tc = 1.8e9, .K_rc = 8e8, .K_ac = 4e8, .K_te = 12e3};
  constexpr double tolerance = 1e-5;
  const AxialForce force(ball, law, tolerance);
  for (const double from : {0.2, 4.5, 5.3}) {
    std::vector<double> phi;
    for (int i = 0; i < 400; ++i) phi.push_back(from + 1e-4 * i);
    std::vector<SixLoads> together(phi.size());
    force.loads(phi, 0.0, together);
    double peak = 0.0;
    for (const SixLoads& F : together) peak = std::max(peak, std::abs(F[0]));
    int same = 0;
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const SixLoads alone = force.loads(phi[i], 0.0);
      same += together[i] == alone ? 1 : 0;
      for (std::size_t q = 0; q < 3; ++q) {
        ASSERT_NEAR(together[i][q], alone[q], tolerance * peak) << phi[i];
      }
    }
    EXPECT_LT(same, 300) << from;
  }
}

/// Chips are differences of radii: no panel follows them below their rounding.
TEST(Methods, AFeedNextToNothingIsFollowedInFewPanels) {  // [F-15]
  MadeCut cut = slot(geometry::cylinder(12e-3), 4, 30);
  cut.runout.eccentricity = 2.65e-10;
  cut.cut.a_p = 4e-3;
  cut.cut.f_z = 50e-6;
  const double usual = ForceMatrix(cut, steel(), 1e-10).work(100);
  EXPECT_GT(usual, 0);
  cut.cut.f_z = 1e-9;
  EXPECT_LT(ForceMatrix(cut, steel(), 1e-10).work(100), 10 * usual);
}

TEST(Methods, OneServesOnlyWhereRadiiStayTheSameAlongTheEdge) {  // [F-5]
  MadeCut s = slot(geometry::cylinder(8e-3), 2, 30);
  EXPECT_TRUE(keeps_radius(s));
  s.runout.eccentricity = 5e-6;
  EXPECT_FALSE(keeps_radius(s));
  s.cutter.helix = 0.0;
  EXPECT_TRUE(keeps_radius(s));
  EXPECT_FALSE(keeps_radius(slot(geometry::ball(8e-3), 2, 30)));
}

TEST(Methods, AHelixThatVanishesGivesTheForceOfAStraightEdge) {  // [F-5]
  MadeCut s = slot(geometry::cylinder(8e-3), 2, 0);
  s.runout.radial_offsets = {0.0, -8e-6};
  s.cut.engagement = geometry::UpMilling{3e-3};
  const auto phi = turn(31);
  const auto straight = forces(s, steel(), phi, 1e-11);
  for (const double helix : {1e-3, 1e-5, 1e-7, 1e-9}) {
    s.cutter.helix = helix;
    // what an edge meets changes by its lag of 2 a_p helix / D
    EXPECT_LE(difference(forces(s, steel(), phi, 1e-11), straight),
              (helix + 1e-9) * peak(straight))
        << helix;
  }
}

TEST(Methods, TheMatrixTimesTheCoefficientsIsTheForce) {  // [F-4]
  MadeCut cylinder = slot(geometry::cylinder(8e-3), 3, 30);
  cylinder.runout.radial_offsets = {0.0, 5e-6, -9e-6};
  MadeCut ball = slot(geometry::ball(8e-3), 2, 30);
  ball.runout.eccentricity = 6e-6;
  for (const MadeCut& setup : {cylinder, ball}) {
    for (const Law& law : {Law(steel()), Law(aluminium())}) {
      const auto phi = turn(20);
      const ForceMatrix matrix(setup, law, 1e-11);
      const auto K = coefficients(law);
      ASSERT_EQ(static_cast<std::size_t>(matrix.columns()), K.size());
      std::vector<double> C(phi.size() * 3 * K.size());
      matrix.evaluate(phi, C);
      std::vector<Vector3> product(phi.size());
      for (std::size_t i = 0; i < 3 * phi.size(); ++i) {
        for (std::size_t c = 0; c < K.size(); ++c) {
          product[i / 3][i % 3] += C[i * K.size() + c] * K[c];
        }
      }
      const auto F = forces(setup, law, phi, 1e-11);
      EXPECT_LE(difference(product, F), 1e-9 * peak(F));
    }
  }
}

TEST(Methods, MeansOfASlotAreTheFormula) {  // [F-8]
  for (const double helix : {20.0, 45.0}) {
    for (const int teeth : {1, 2, 3, 4}) {
      MadeCut s = slot(geometry::cylinder(8e-3), teeth, helix);
      s.chip.model = chip::Model::none;
      const auto F = forces(s, steel(), turn(3600), 1e-11);
      Vector3 mean{};
      for (const auto& f : F) {
        for (std::size_t q = 0; q < 3; ++q) mean[q] += f[q] / 3600;
      }
      const auto formula = closed_form_mean(s, steel());
      ASSERT_TRUE(formula);
      for (std::size_t q = 0; q < 3; ++q) {
        // kinks where edges enter and leave: (pi / 3600)^2
        EXPECT_NEAR(mean[q], (*formula)[q], 1e-6 * peak(F)) << helix << " " << teeth;
      }
    }
  }
}

TEST(Methods, TheFormulaKnowsTheHelixOfEitherLagLaw) {  // [F-8] [G-8]
  MadeCut s = slot(geometry::cylinder(8e-3), 2, 30.0);
  s.chip.model = chip::Model::feed;
  s.cutter.lag_diameter = 4e-3;
  for (const auto law :
       {geometry::LagLaw::constant_lead, geometry::LagLaw::constant_helix}) {
    s.cutter.lag_law = law;
    const auto phi = turn(7200);
    Vector3 mean{};
    for (const Vector3& F : forces(s, steel(), phi, 1e-6)) {
      for (std::size_t q = 0; q < 3; ++q) mean[q] += F[q] / 7200.0;
    }
    const auto formula = closed_form_mean(s, steel());
    ASSERT_TRUE(formula);
    for (std::size_t q = 0; q < 3; ++q) {
      EXPECT_NEAR((*formula)[q], mean[q], 1e-3) << q;
    }
  }
}

TEST(Methods, NothingIsCutWithoutFeed) {
  MadeCut s = slot(geometry::ball(8e-3), 2, 30.0);
  s.runout.radial_offsets = {0.0, -8e-6};
  s.chip.lookback = chip::Lookback::previous;
  s.cut.f_z = 0.0;
  EXPECT_EQ(peak(forces(s, aluminium(), turn(12), 1e-6)), 0.0);
}

TEST(Methods, TheFormulaIsSilentWhereItDoesNotHold) {  // [F-8]
  MadeCut s = slot(geometry::cylinder(8e-3), 2, 30);
  s.chip.model = chip::Model::none;
  EXPECT_TRUE(closed_form_mean(s, steel()));
  EXPECT_FALSE(closed_form_mean(s, aluminium()));
  s.cut.engagement = geometry::UpMilling{2e-3};
  EXPECT_FALSE(closed_form_mean(s, steel()));
  MadeCut ball = slot(geometry::ball(8e-3), 2, 30);
  ball.chip.model = chip::Model::none;
  EXPECT_FALSE(closed_form_mean(ball, steel()));
}

TEST(Setup, TeethAreAlikeWithoutRunoutThatCounts) {
  MadeCut s = slot(geometry::cylinder(8e-3), 3, 30);
  EXPECT_TRUE(teeth_alike(s));
  s.runout.radial_offsets = {5e-6, 5e-6, 5e-6};
  EXPECT_TRUE(teeth_alike(s));
  s.runout.radial_offsets = {5e-6, 5e-6, 0.0};
  EXPECT_FALSE(teeth_alike(s));
  s.chip.model = chip::Model::none;  // it feels no runout
  EXPECT_TRUE(teeth_alike(s));
  s.cutter.pitch = {2.0, 2.0, 2 * pi - 4.0};
  EXPECT_FALSE(teeth_alike(s));
}

TEST(Methods, TurnsRepeatToTheLastBit) {
  MadeCut s = slot(geometry::ball(8e-3), 2, 30);
  s.runout.eccentricity = 6e-6;
  std::vector<double> phi = turn(24);
  const auto once = forces(s, steel(), phi, 1e-8);
  for (double& angle : phi) angle += 2 * pi;
  EXPECT_LE(difference(forces(s, steel(), phi, 1e-8), once), 1e-7 * peak(once));
}

}  // namespace trochoid::force::methods_test
