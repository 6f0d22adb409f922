#include "made_cut.h"

#include <trochoid/force/any_edges.h>
#include <trochoid/force/slice.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace trochoid::force::any_edges_test {

constexpr double mm = 1e-3;
constexpr double um = 1e-6;
constexpr double tolerance = 1e-9;

/// The same angles by the quadrature of edges that may differ.
std::vector<Vector3> any_forces(const MadeCut& setup, const Law& law,
                                const std::vector<double>& phi) {
  std::vector<SixLoads> all(phi.size());
  AnyForce(setup, law, tolerance).loads(phi, 0.0, all);
  std::vector<Vector3> out;
  for (const SixLoads& v : all) out.push_back({v[0], v[1], v[2]});
  return out;
}

std::vector<MadeCut> alike_cuts() {
  MadeCut cylinder = slot(geometry::cylinder(8 * mm), 2, 30);
  cylinder.runout.radial_offsets = {0.0, -8 * um};
  MadeCut bull = slot(geometry::bull_nose(12 * mm, 2 * mm), 4, 35);
  bull.cut.a_p = 4 * mm;
  bull.cut.engagement = geometry::DownMilling{3 * mm};
  bull.runout = {.eccentricity = 6 * um, .angle = 0.8};
  MadeCut taper = slot(geometry::taper(6 * mm, 0.05, 0.5 * mm), 3, 20);
  taper.cut.engagement = geometry::Band{-2 * mm, 2.5 * mm};
  return {cylinder, bull, taper};
}

TEST(AnyEdges, GiveAlikeTeethTheForcesOfTheClosedForms) {  // [F-30]
  for (const MadeCut& setup : alike_cuts()) {
    for (const Law& law : {Law{steel()}, Law{both()}}) {
      const auto phi = turn(17);
      const auto want = forces(setup, law, phi, tolerance);
      EXPECT_LT(difference(any_forces(setup, law, phi), want), 2e-7 * peak(want));
    }
  }
}

TEST(AnyEdges, GiveTheMatrixOfTheirForces) {  // [F-30]
  MadeCut setup = slot(geometry::taper(63 * mm, 0.26), 5, -7);
  setup.cut.a_p = 4 * mm;
  setup.cut.f_z = 0.15 * mm;
  setup.runout.axial_offsets = {0.0, -15 * um, -30 * um, -5 * um, -22 * um};
  const Law law{steel()};
  const std::vector<double> K = coefficients(law);
  const auto phi = turn(9);
  const auto F = forces(setup, law, phi, tolerance);
  const ForceMatrix matrix(setup, law, tolerance);
  std::vector<double> C(phi.size() * 18);
  matrix.evaluate(phi, C);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    for (std::size_t row = 0; row < 3; ++row) {
      double sum = 0.0;
      for (std::size_t c = 0; c < 6; ++c) sum += C[18 * i + 6 * row + c] * K[c];
      EXPECT_NEAR(sum, F[i][row], 1e-7 * peak(F));
    }
  }
}

TEST(AnyEdges, ACommonAxialOffsetIsADeeperCut) {  // [F-30] [G-21]
  MadeCut setup = slot(geometry::cylinder(10 * mm), 3, 30);
  setup.runout.axial_offsets = {0.1 * mm, 0.1 * mm, 0.1 * mm};
  MadeCut deeper = slot(geometry::cylinder(10 * mm), 3, 30);
  deeper.cut.a_p += 0.1 * mm;
  const auto phi = turn(13);
  const auto want = forces(deeper, Law{steel()}, phi, tolerance);
  // The tips reach the same height: only where the heights are counted from differs.
  const auto got = forces(setup, Law{steel()}, phi, tolerance);
  EXPECT_LT(difference(got, want), 1e-7 * peak(want));
}

TEST(AnyEdges, AreThoseOfSlices) {  // [F-30]
  MadeCut setup = slot(geometry::cylinder(12 * mm), 3, 25);
  setup.cut.a_p = 4 * mm;
  setup.cut.engagement = geometry::Band{-4 * mm, 5 * mm};
  setup.cutter.serration =
      geometry::Serration{.amplitude = 20 * um, .wavelength = 1.5 * mm, .shift = {}};
  setup.runout.axial_offsets = {0.0, 40 * um, -30 * um};
  setup.edge_length = EdgeLength::axial;
  LinearEdge law = steel();
  law.K_ac = law.K_ae = 0.0;
  law.K_te = law.K_re = 0.0;
  constexpr int slices = 4000;
  const double low = -40 * um;
  const double dz = (setup.cut.a_p - low) / slices;
  const auto phi = turn(5);
  std::vector<Vector3> want(phi.size(), Vector3{});
  for (int k = 0; k < slices; ++k) {
    const Slice slice(setup, low + (k + 0.5) * dz);
    for (std::size_t j = 0; j < 3; ++j) {
      const geometry::EdgeAt& at = slice.edge(j);
      if (!at.there) continue;
      for (std::size_t i = 0; i < phi.size(); ++i) {
        const double theta = phi[i] - at.omega;
        const double h = slice.chip_thickness(j, theta) * dz;
        const double eff = theta + at.position.epsilon;
        want[i][0] +=
            h * (-law.K_tc * std::cos(eff) - law.K_rc * at.sin_kappa * std::sin(eff));
        want[i][1] +=
            h * (law.K_tc * std::sin(eff) - law.K_rc * at.sin_kappa * std::cos(eff));
        want[i][2] += h * law.K_rc * at.cos_kappa;
      }
    }
  }
  const auto got = forces(setup, Law{law}, phi, tolerance);
  EXPECT_LT(difference(got, want), 1e-3 * peak(want));
}

TEST(AnyEdges, HaveTheMeanOfManySamples) {  // [F-31]
  MadeCut setup = slot(geometry::cylinder(10 * mm), 4, 0);
  setup.cut.a_p = 8 * mm;
  setup.cutter.helices = {0.66, 0.72, 0.66, 0.72};
  setup.cutter.helix = 0.66;
  const auto phi = turn(720);
  const auto all = loads(setup, Law{steel()}, phi, 0.0, tolerance);
  Loads sum;
  for (const Loads& one : all) {
    for (std::size_t q = 0; q < 3; ++q) sum.force[q] += one.force[q] / 720;
    sum.torque += one.torque / 720;
  }
  const MeanLoads mean = exact_mean(setup, Law{steel()}, tolerance);
  for (std::size_t q = 0; q < 3; ++q) {
    EXPECT_NEAR(mean.force[q], sum.force[q], 1e-3);
  }
  EXPECT_NEAR(mean.torque, sum.torque, 1e-5);
}

TEST(AnyEdges, OfAlikeTeethHaveTheirMeanToo) {  // [F-31]
  for (const MadeCut& setup : alike_cuts()) {
    const auto known = mean_force(setup, Law{steel()}, tolerance);
    if (!known) continue;
    const MeanLoads mean = exact_mean(setup, Law{steel()}, tolerance);
    for (std::size_t q = 0; q < 3; ++q) {
      EXPECT_NEAR(mean.force[q], (*known)[q], 1e-5);
    }
  }
}

/// Two ways to the height at which a tooth begins differ by rounding: no layer lies between.
TEST(AnyEdges, HaveNoLayerAsThinAsRounding) {
  MadeCut setup = slot(geometry::bull_nose(12 * mm, 2 * mm), 4, 30);
  setup.cut.a_p = 4 * mm;
  setup.runout.radial_offsets = {0.0, 7.851712751022607e-07, 9.3756475763976894e-07,
                                 4.5427964105718017e-06};
  setup.runout.axial_offsets = {0.0, -1.7702952830847407e-07, -5.7994835533317278e-06,
                                5.1814903462605228e-07};
  const geometry::ToothEdges edges(setup.cutter, setup.runout);
  const std::vector<double> breaks = edges.breaks(setup.cut.a_p);
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    EXPECT_GT(breaks[i] - breaks[i - 1], 1e-14);
  }
  EXPECT_EQ(breaks.back(), setup.cut.a_p);
  std::vector<AnyForce::Matrix> C(1);
  AnyForce(setup, steel(), 1e-7).matrices(std::vector{2.4963584722373153}, C);
  for (const double entry : C[0]) EXPECT_TRUE(std::isfinite(entry));
}

}  // namespace trochoid::force::any_edges_test
