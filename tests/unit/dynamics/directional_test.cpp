#include <trochoid/dynamics/directional.h>

#include <trochoid/dynamics/engaged.h>
#include <trochoid/dynamics/nodes.h>
#include <trochoid/force/law.h>

#include "milling_cut.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::dynamics::directional_test {

constexpr force::Power power_law{300e6, 120e6, 80e6, 0.3, 0.4, 0.2};

/// Force in x and y per meridian length at a chip.
std::array<double, 2> force_at(const force::Law& law, double h, double theta,
                               double sine, double cosine) {
  const auto [form, K, K_e] = force::terms(law);
  const auto w = force::column_weights(form, h, sine, 1.0);
  const double t = K[0] * w.cutting[0] + K_e[0] * w.edge;
  const double r = K[1] * w.cutting[1] + K_e[1] * w.edge;
  const double a = K[2] * w.cutting[2] + K_e[2] * w.edge;
  const double s = std::sin(theta);
  const double c = std::cos(theta);
  return {-c * t - s * sine * r - s * cosine * a,
          s * t - c * sine * r - c * cosine * a};
}

TEST(Gradient, IsTheDifferenceQuotientOfTheForce) {  // [D-5] [D-6] [D-7]
  const force::Law linear = force::LinearEdge{600e6, 200e6, 100e6, 5e3, 4e3, 3e3};
  const force::Law both =
      force::PowerEdge{300e6, 120e6, 80e6, 0.3, 0.4, 0.2, 5e3, 4e3, 3e3};
  for (const force::Law& law : {linear, force::Law(power_law), both}) {
    for (const double kappa : {pi / 2, 0.9}) {
      const double h = 40e-6;
      const double dh = 1e-9;
      const double theta = 0.7;
      const double sine = std::sin(kappa);
      const double cosine = std::cos(kappa);
      const auto up = force_at(law, h + dh, theta, sine, cosine);
      const auto down = force_at(law, h - dh, theta, sine, cosine);
      const Matrix2 g = directional_gradient(force::terms(law), h, theta, sine, cosine);
      for (std::size_t row = 0; row < 2; ++row) {
        const double slope = (up[row] - down[row]) / (2 * dh);
        EXPECT_NEAR(g[2 * row], slope * std::sin(theta), 1e-6 * std::abs(slope));
        EXPECT_NEAR(g[2 * row + 1], slope * std::cos(theta), 1e-6 * std::abs(slope));
      }
    }
  }
}

TEST(Gradient, TurnsWithTheTooth) {  // [D-7]
  const force::Law law = benchmark_law();
  const double turn = 0.4;
  const Matrix2 a = directional_gradient(force::terms(law), 0, 1.0, 1, 0);
  const Matrix2 b = directional_gradient(force::terms(law), 0, 1.0 + turn, 1, 0);
  // Clockwise from +y towards +x: v -> Q v with Q = [c, s; -s, c].
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  const Matrix2 Qa = {c * a[0] + s * a[2], c * a[1] + s * a[3], -s * a[0] + c * a[2],
                      -s * a[1] + c * a[3]};
  const Matrix2 expected = {Qa[0] * c + Qa[1] * s, -Qa[0] * s + Qa[1] * c,
                            Qa[2] * c + Qa[3] * s, -Qa[2] * s + Qa[3] * c};
  for (std::size_t q = 0; q < 4; ++q) {
    EXPECT_NEAR(b[q], expected[q], 1e-6);
  }
}

TEST(Gradient, APushAgainstTheWorkIsResisted) {  // [D-7]
  // In front of the tool (theta = 90 deg) more chip means a force backwards.
  const Matrix2 g =
      directional_gradient(force::terms(benchmark_law()), 0, pi / 2, 1, 0);
  EXPECT_LT(g[0], 0);
}

/// Matrix of a channel at a spindle angle, from its element.
Matrix2 matrix_at(const Directional& d, std::size_t channel, double phi) {
  for (const DirectionalElement& e : d.elements) {
    const double turns = d.period * std::floor((phi - d.elements[0].from) / d.period);
    const double at = phi - turns;
    if (at < e.from || at > e.to || e.matrices[channel].empty()) {
      continue;
    }
    const ElementNodes& nodes = element_nodes(directional_degree);
    std::vector<double> row(nodes.t.size());
    lagrange_row(nodes, (2 * at - e.from - e.to) / (e.to - e.from), row);
    Matrix2 m{};
    for (std::size_t i = 0; i < row.size(); ++i) {
      for (std::size_t q = 0; q < 4; ++q) {
        m[q] += row[i] * e.matrices[channel][i][q];
      }
    }
    return m;
  }
  return {};
}

/// D-9 summed over thin slices: the teeth and the arc given.
Matrix2 by_slices(const force::Setup& setup, double phi, double from, double to) {
  Matrix2 sum{};
  const int slices = 20000;
  const auto psi = geometry::tooth_angles(setup.cutter);
  for (int i = 0; i < slices; ++i) {
    const double z = setup.cut.a_p * (i + 0.5) / slices;
    const double lag = 2 * z * std::tan(setup.cutter.helix) / setup.cutter.lag_diameter;
    for (const double angle : psi) {
      double theta = phi - angle - lag;
      theta -= 2 * pi * std::floor(theta / (2 * pi));
      if (theta > from && theta < to) {
        const Matrix2 g =
            directional_gradient(force::terms(benchmark_law()), 0, theta, 1, 0);
        for (std::size_t q = 0; q < 4; ++q) {
          sum[q] += g[q] * setup.cut.a_p / slices;
        }
      }
    }
  }
  return sum;
}

TEST(Directional, IsTheSumOverTeethAndSlices) {  // [D-8] [D-9]
  force::Setup setup = straight_cut(3, geometry::DownMilling{2 * unit::mm});
  setup.cutter.pitch = {1.9, 2.2, 2 * pi - 4.1};
  setup.cutter.helix = 0.6;
  setup.cut.a_p = 4 * unit::mm;
  const double entry = pi - std::acos(0.6);
  const Directional d =
      DirectionalModel(setup, benchmark_law(), 1e-6, 1e-10).at_depth(setup.cut.a_p);
  EXPECT_NEAR(d.period, 2 * pi, 1e-12);
  for (const double phi : {0.3, 1.4, 2.6, 3.9, 5.0, 6.1}) {
    const Matrix2 expected = by_slices(setup, phi, entry, pi);
    const Matrix2 own = matrix_at(d, 0, phi);
    Matrix2 delayed{};
    for (std::size_t channel = 1; channel <= d.delays.size(); ++channel) {
      const Matrix2 m = matrix_at(d, channel, phi);
      for (std::size_t q = 0; q < 4; ++q) {
        delayed[q] += m[q];
      }
    }
    for (std::size_t q = 0; q < 4; ++q) {
      EXPECT_NEAR(own[q], expected[q], 300.0)
          << phi;  // of 2.4e6 N/m: one slice of edge
      EXPECT_NEAR(delayed[q], own[q], 1e-3) << phi;
    }
  }
}

TEST(Directional, IsTheSameWithoutHelixAndWithHardlyAny) {  // [D-9]
  force::Setup setup = straight_cut(2, geometry::UpMilling{3 * unit::mm});
  const Directional none =
      DirectionalModel(setup, power_law, 2e-6, 1e-10).at_depth(1 * unit::mm);
  setup.cutter.helix = 1e-5;
  const Directional little =
      DirectionalModel(setup, power_law, 2e-6, 1e-10).at_depth(1 * unit::mm);
  for (const double phi : {0.2, 0.5, 0.9}) {
    const Matrix2 a = matrix_at(none, 1, phi);
    const Matrix2 b = matrix_at(little, 1, phi);
    EXPECT_GT(largest_entry(a), 1e4);
    for (std::size_t q = 0; q < 4; ++q) {
      EXPECT_NEAR(a[q], b[q], 1e-5 * largest_entry(a));
    }
  }
}

TEST(Directional, OfStraightEdgesIsProportionalToTheDepth) {  // [D-9]
  force::Setup setup = straight_cut(2, geometry::Slot{});
  const DirectionalModel straight(setup, benchmark_law(), 1e-6, 1e-11);
  EXPECT_TRUE(straight.proportional());
  const Directional once = straight.at_depth(0.5e-3);
  const Directional twice = straight.at_depth(1e-3);
  const double one = once.elements[0].matrices[0][5][0];
  EXPECT_NE(one, 0);
  EXPECT_NEAR(twice.elements[0].matrices[0][5][0], 2 * one, 1e-12 * std::abs(one));
  setup.cutter.helix = 0.01;
  EXPECT_FALSE(DirectionalModel(setup, benchmark_law(), 1e-6, 1e-11).proportional());
}

TEST(Directional, AlongTheEdgeAsOverTheAngle) {  // [D-9]
  // An eccentricity of nothing makes the cutter go through layers.
  force::Setup setup = straight_cut(2, geometry::DownMilling{3 * unit::mm});
  setup.cutter.helix = 0.5;
  setup.cut.a_p = 2 * unit::mm;
  setup.chip = {chip::Model::radial, chip::Lookback::all};
  const Directional closed =
      DirectionalModel(setup, benchmark_law(), 1e-6, 1e-9).at_depth(2 * unit::mm);
  setup.runout.eccentricity = 1e-15;
  const Directional along =
      DirectionalModel(setup, benchmark_law(), 1e-6, 1e-9).at_depth(2 * unit::mm);
  EXPECT_NEAR(along.period, 2 * closed.period, 1e-12);
  for (const double phi : {2.3, 2.7, 3.0, 3.2, 4.5}) {
    const Matrix2 a = matrix_at(closed, 0, phi);
    const Matrix2 b = matrix_at(along, 0, phi);
    for (std::size_t q = 0; q < 4; ++q) {
      EXPECT_NEAR(a[q], b[q], 1.0) << phi;  // of 1.2e6 N/m
    }
  }
}

TEST(Directional, RunoutSendsATwoToothCutterToItsOwnMarkAtEntry) {  // [D-8]
  // C-4 with all marks: offset d between the teeth, the long one meets its own where
  // f sin(theta) < d, the short one starts only there.
  force::Setup setup = straight_cut(2, geometry::Slot{});
  setup.chip = {chip::Model::radial, chip::Lookback::all};
  setup.runout.radial_offsets = {26e-6, 0.0};
  const double beta = std::asin(26.0 / 50.0);
  const Directional d =
      DirectionalModel(setup, benchmark_law(), 1e-6, 1e-9).at_depth(1 * unit::mm);
  ASSERT_EQ(d.delays.size(), 2U);
  EXPECT_NEAR(d.delays[0], pi, 1e-12);
  EXPECT_NEAR(d.delays[1], 2 * pi, 1e-12);
  const auto cuts = [&](std::size_t channel, double phi) {
    return largest_entry(matrix_at(d, channel, phi)) > 1.0;
  };
  EXPECT_TRUE(cuts(2, 0.9 * beta));
  EXPECT_FALSE(cuts(1, 0.9 * beta));
  EXPECT_TRUE(cuts(1, 1.1 * beta));
  EXPECT_FALSE(cuts(2, 1.1 * beta));
  EXPECT_TRUE(cuts(2, pi - 0.9 * beta));
  EXPECT_FALSE(cuts(0, pi + 0.9 * beta));  // the short tooth, in air
  EXPECT_TRUE(cuts(1, pi + 1.1 * beta));
}

}  // namespace trochoid::dynamics::directional_test
