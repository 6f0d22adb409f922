#include "made_cut.h"

#include <trochoid/force/columns.h>

#include <gtest/gtest.h>

namespace trochoid::force {
namespace {

TEST(Law, CoefficientsGoOutAndComeBack) {
  for (const Law& law : {Law(steel()), Law(aluminium())}) {
    const auto K = coefficients(law);
    EXPECT_EQ(static_cast<std::size_t>(coefficient_count(law)), K.size());
    std::vector<double> other(K);
    for (double& k : other) k *= 3;
    EXPECT_EQ(coefficients(with_coefficients(law, other)), other);
    EXPECT_EQ(coefficients(with_coefficients(law, K)), K);
  }
  const Law kept = with_coefficients(aluminium(), std::vector{1.0, 2.0, 3.0});
  EXPECT_EQ(std::get<Power>(kept).m_r, aluminium().m_r);
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
    return column_weights(aluminium(), h, 1.0, 1.0).cutting[0];
  };
  EXPECT_NEAR(at(h_0), h_0, 1e-18);
  EXPECT_NEAR(at(0.1 * h_0) / h_0, std::pow(0.1, 0.75), 1e-12);
  EXPECT_EQ(column_weights(aluminium(), 1e-5, 1.0, 1.0).edge, 0.0);
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

}  // namespace
}  // namespace trochoid::force
