#include <trochoid/dynamics/layers.h>

#include <trochoid/chip/teeth_at_height.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "milling_cut.h"

namespace trochoid::dynamics {
namespace {

TEST(DelayNodes, CarryAVibrationBetweenThem) {  // [D-36]
  const double cycle = 0.07;
  const DelayNodes nodes({{1.4, 1.55}, {1.5, 1.6}, {pi, pi}, {4.6, 4.8}}, cycle);
  EXPECT_TRUE(std::ranges::is_sorted(nodes.delays()));
  for (const double delay : {1.4, 1.43, 1.501, 1.6, pi, 4.77}) {
    double sum = 0.0;
    double wave = 0.0;
    std::vector<double> weights(nodes.delays().size());
    const auto [first, count] = nodes.weights(delay, weights);
    for (std::size_t k = 0; k < count; ++k) {
      sum += weights[k];
      wave += weights[k] * std::cos(2 * pi * nodes.delays()[first + k] / cycle);
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_NEAR(wave, std::cos(2 * pi * delay / cycle), 1e-6) << delay;
  }
}

TEST(DelayNodes, AreOneWhereADelayStays) {  // [D-36]
  EXPECT_EQ(DelayNodes({{pi, pi}, {pi, pi}, {2 * pi, 2 * pi}}, 0.1).delays().size(),
            2U);
}

/// The cut of a cylinder whose teeth hardly differ.
force::Setup hardly_variable(const geometry::Engagement& engagement) {
  force::Setup setup = straight_cut(3, engagement);
  setup.chip = {chip::Model::trochoidal, chip::Lookback::all};
  setup.runout.radial_offsets = {12e-6, 0.0, -5e-6};
  setup.cut.a_p = 4 * unit::mm;
  setup.cutter.helix = 0.6;
  return setup;
}

TEST(Layers, OfAlikeTeethAreTheClosedForm) {  // [D-37]
  const System system{
      {mode_of(0.03993, 922, 0.011, 1, 0), mode_of(0.04, 1010, 0.02, 0, 1)}};
  for (const geometry::Engagement& engagement :
       {geometry::Engagement(geometry::DownMilling{2 * unit::mm}),
        geometry::Engagement(geometry::UpMilling{1 * unit::mm})}) {
    force::Setup setup = hardly_variable(engagement);
    const double closed = growth(setup, benchmark_law(), system);
    setup.cutter.helices = {0.6, 0.6 + 1e-9, 0.6};
    EXPECT_NEAR(growth(setup, benchmark_law(), system) / closed, 1.0, 1e-5);
  }
}

/// D-9 by many thin slices: what acts on q(phi).
Matrix2 in_slices(const force::Setup& setup, double phi, int slices) {
  const geometry::ToothEdges edges(setup.cutter, setup.runout);
  chip::TeethAtHeight teeth(edges, chip::passage(setup.cutter, setup.cut, setup.chip));
  const double bottom = edges.breaks(setup.cut.a_p).front();
  const double thick = (setup.cut.a_p - bottom) / slices;
  Matrix2 sum{};
  for (int i = 0; i < slices; ++i) {
    teeth.stand_at(bottom + (i + 0.5) * thick);
    for (std::size_t j = 0; j < edges.teeth(); ++j) {
      const geometry::EdgeAt& at = teeth.edge(j);
      const double theta = phi - at.omega;
      if (!teeth.there(j) || !teeth.chip(j, theta).in_cut) continue;
      const Matrix2 g =
          directional_gradient(force::terms(benchmark_law()), 0,
                               theta + at.position.epsilon, at.sin_kappa, at.cos_kappa);
      for (std::size_t q = 0; q < g.size(); ++q) {
        sum[q] += g[q] * thick / at.sin_kappa;
      }
    }
  }
  return sum;
}

void expect_many_slices(const force::Setup& setup, double allowed, const char* what) {
  SCOPED_TRACE(what);
  const Layers layers =
      layers_of(setup, force::terms(benchmark_law()), 1e-6, setup.cut.a_p, 0.3);
  for (const double phi : {0.4, 1.3, 2.2, 3.4, 4.5, 5.9}) {
    std::vector<Matrix2> sum(1 + layers.delays.delays().size());
    layers.add(setup.cut.a_p, phi, phi, sum);
    const Matrix2 expected = in_slices(setup, phi, 20000);
    Matrix2 delayed{};
    for (std::size_t d = 1; d < sum.size(); ++d) {
      for (std::size_t q = 0; q < 4; ++q) delayed[q] += sum[d][q];
    }
    const double size = largest_entry(expected);
    EXPECT_GT(size, 1e4) << phi;
    for (std::size_t q = 0; q < 4; ++q) {
      EXPECT_NEAR(sum[0][q], expected[q], allowed * size) << phi;
      EXPECT_NEAR(delayed[q], sum[0][q], allowed * size) << phi;
    }
  }
}

TEST(Layers, AreManySlicesOfAnyEdge) {  // [D-9] [D-37]
  force::Setup setup = hardly_variable(geometry::Slot{});
  setup.cutter.helices = {0.5, 0.65, 0.6};
  expect_many_slices(setup, 2e-4, "helices");
  setup.runout.axial_offsets = {0.0, 20e-6, -0.1e-3};
  setup.runout.tilt = 0.2 * unit::deg;
  expect_many_slices(setup, 2e-4, "level");
  setup.cutter.serration = {.amplitude = 0.2e-3, .wavelength = 1.5e-3};
  expect_many_slices(setup, 1e-3, "serration");
  setup.cutter.profile = geometry::ball(10e-3);
  setup.cutter.serration.reset();
  expect_many_slices(setup, 3e-3, "ball");  // near the axis the stock bounds the chips
}

TEST(Layers, OfLessThanTheDeepestAreCutThere) {  // [D-37]
  force::Setup setup = hardly_variable(geometry::Slot{});
  setup.cutter.helices = {0.5, 0.65, 0.6};
  const force::Terms law = force::terms(benchmark_law());
  const Layers deep = layers_of(setup, law, 1e-6, 7e-3, 0.3);
  const Layers shallow = layers_of(setup, law, 1e-6, 4e-3, 0.3);
  for (const double phi : {0.4, 2.2, 4.5}) {
    std::vector<Matrix2> a(1 + deep.delays.delays().size());
    std::vector<Matrix2> b(1 + shallow.delays.delays().size());
    deep.add(4e-3, phi, phi, a);
    shallow.add(4e-3, phi, phi, b);
    for (std::size_t q = 0; q < 4; ++q) {
      EXPECT_NEAR(a[0][q], b[0][q], 1e-5 * largest_entry(b[0])) << phi;
    }
  }
}

TEST(DirectionalModel, IsNotAskedBeyondItsReach) {
  force::Setup setup = hardly_variable(geometry::Slot{});
  setup.cutter.helices = {0.5, 0.65, 0.6};
  const DirectionalModel model(setup, benchmark_law(), 1e-6, 1e-10, {6e-3, 0.3});
  EXPECT_EQ(model.at_depth(6e-3).delays, model.at_depth(1e-3).delays);
  EXPECT_THROW((void)model.at_depth(6.1e-3), std::invalid_argument);
}

}  // namespace
}  // namespace trochoid::dynamics
