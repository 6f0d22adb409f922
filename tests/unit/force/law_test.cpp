#include "made_cut.h"

#include <trochoid/force/law.h>

#include <gtest/gtest.h>

#include <array>
#include <set>

namespace trochoid::force::law_test {

TEST(Law, CoefficientsGoOutAndComeBack) {
  for (const Law& law : {Law(steel()), Law(aluminium()), Law(both())}) {
    const auto K = coefficients(law);
    EXPECT_EQ(form(law).columns(), K.size());
    EXPECT_EQ(coefficient_quantities(law).size(), K.size());
    std::vector<double> other(K);
    for (double& k : other) k *= 3;
    EXPECT_EQ(coefficients(with_coefficients(law, other)), other);
    EXPECT_EQ(coefficients(with_coefficients(law, K)), K);
  }
  const Law kept = with_coefficients(aluminium(), std::vector{1.0, 2.0, 3.0});
  EXPECT_EQ(std::get<Power>(kept).m_r, aluminium().m_r);
}

TEST(Law, EveryNumberOfEveryLawHasAKeyOfItsOwn) {
  std::set<std::string_view> names;
  for (const Law& kind : law_kinds) {
    EXPECT_TRUE(names.insert(name_of(kind)).second);
    std::set<std::string_view> keys;
    for (const Quantity& quantity : quantities(kind)) {
      EXPECT_TRUE(keys.insert(quantity.key).second) << quantity.key;
      const bool exponent = quantity.role == Role::exponent;
      const Law changed = with_number(kind, quantity.key, 0.125);
      EXPECT_EQ(coefficients(changed) == coefficients(kind), exponent) << quantity.key;
      EXPECT_EQ(form(changed).m == form(kind).m, !exponent) << quantity.key;
    }
    EXPECT_THROW(static_cast<void>(with_number(kind, "K_xc_MPa", 1.0)),
                 std::invalid_argument);
  }
}

TEST(Law, ExponentsAreReplacedAndCoefficientsStay) {
  const std::array m = {0.3, 0.2, 0.1};
  for (const Law& law : {Law(aluminium()), Law(both())}) {
    const Law changed = with_exponents(law, m);
    EXPECT_EQ(form(changed).m, m);
    EXPECT_EQ(coefficients(changed), coefficients(law));
  }
  EXPECT_EQ(coefficients(with_exponents(steel(), m)), coefficients(steel()));
}

TEST(Law, APowerLawWithEdgesIsThePowerLawAndTheEdges) {  // [F-9]
  const PowerEdge law = both();
  const Power power{law.K_t1, law.K_r1, law.K_a1, law.m_t, law.m_r, law.m_a};
  const LinearEdge edges{0, 0, 0, law.K_te, law.K_re, law.K_ae};
  for (const auto& profile :
       {geometry::cylinder(8e-3), geometry::bull_nose(8e-3, 1e-3)}) {
    MadeCut s = slot(profile, 2, 30);
    s.runout.radial_offsets = {0.0, -8e-6};
    const auto phi = turn(60);
    auto sum = forces(s, power, phi, 1e-11);
    const auto of_edges = forces(s, edges, phi, 1e-11);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      for (std::size_t q = 0; q < 3; ++q) sum[i][q] += of_edges[i][q];
    }
    EXPECT_LE(difference(forces(s, law, phi, 1e-11), sum), 1e-9 * peak(sum));
  }
}

TEST(Law, APowerOfOneIsLinearWithoutEdgeForces) {  // [F-1] [F-2]
  for (const auto& profile :
       {geometry::cylinder(8e-3), geometry::bull_nose(8e-3, 1e-3)}) {
    MadeCut s = slot(profile, 2, 30);
    s.runout.radial_offsets = {0.0, -8e-6};
    const auto phi = turn(60);
    const auto power = forces(s, Power{2600e6, 1500e6, 330e6, 0, 0, 0}, phi, 1e-11);
    const auto linear =
        forces(s, LinearEdge{2600e6, 1500e6, 330e6, 0, 0, 0}, phi, 1e-11);
    EXPECT_LE(difference(power, linear), 1e-9 * peak(linear));
  }
}

TEST(Law, AThickChipIsCheaperPerThickness) {  // [F-2]
  const auto at = [](double h) {
    return column_weights(form(aluminium()), h, 1.0, 1.0).cutting[0];
  };
  EXPECT_NEAR(at(h_0), h_0, 1e-18);
  EXPECT_NEAR(at(0.1 * h_0) / h_0, std::pow(0.1, 0.75), 1e-12);
  EXPECT_EQ(column_weights(form(aluminium()), 1e-5, 1.0, 1.0).edge, 0.0);
  EXPECT_EQ(column_weights(form(both()), 1e-5, 1.0, 1.3).edge, 1.3);
}

TEST(Law, EdgeForcesAreAsLongAsTheEdge) {  // [F-1] [G-6]
  MadeCut s = slot(geometry::cylinder(8e-3), 2, 40);
  const LinearEdge edge{0, 0, 0, 7e3, 3e3, 1e3};
  const auto phi = turn(40);
  auto with_length = forces(s, edge, phi, 1e-11);
  s.edge_length = EdgeLength::axial;
  const auto axial = forces(s, edge, phi, 1e-11);
  for (auto& F : with_length) {
    for (double& f : F) f *= std::cos(40 * unit::deg);
  }
  EXPECT_LE(difference(with_length, axial), 1e-9 * peak(axial));
}

TEST(Law, AxialForcesPullACylinderDownAndNothingElse) {  // [F-3]
  const MadeCut s = slot(geometry::cylinder(8e-3), 2, 30);
  for (const auto& F : forces(s, LinearEdge{0, 0, 330e6, 0, 0, 1e3}, turn(60), 1e-10)) {
    EXPECT_EQ(F[0], 0.0);
    EXPECT_EQ(F[1], 0.0);
    EXPECT_LE(F[2], 0.0);
  }
}

TEST(Law, AStraightToothIsPushedAgainstItsVelocityAndInwards) {  // [F-3]
  MadeCut s = slot(geometry::cylinder(8e-3), 1, 0);
  s.chip.model = chip::Model::none;
  const double theta = 1.1;
  const double h = s.cut.f_z * std::sin(theta);
  const auto F =
      forces(s, LinearEdge{1e9, 0, 0, 0, 0, 0}, std::vector{theta}, 1e-11)[0];
  EXPECT_NEAR(F[0], -1e9 * h * s.cut.a_p * std::cos(theta), 1e-7);
  EXPECT_NEAR(F[1], 1e9 * h * s.cut.a_p * std::sin(theta), 1e-7);
  const auto G =
      forces(s, LinearEdge{0, 1e9, 0, 0, 0, 0}, std::vector{theta}, 1e-11)[0];
  EXPECT_NEAR(G[0], -1e9 * h * s.cut.a_p * std::sin(theta), 1e-7);
  EXPECT_NEAR(G[1], -1e9 * h * s.cut.a_p * std::cos(theta), 1e-7);
}

}  // namespace trochoid::force::law_test
