#include <trochoid/dynamics/multiplier.h>

#include "milling_cut.h"

#include <gtest/gtest.h>
#include <trochoid/numerics/dominant_eigenvalue.h>

#include <cmath>

namespace trochoid::dynamics::multiplier_test {

TEST(Multiplier, OfTheBenchmark) {  // [D-11]
  struct Point {
    double rpm, depth_mm, expected;
  };
  // Converged by an independent collocation with 56 and 64 nodes.
  const Point points[] = {{5000, 0.2, 0.8197427843},  {5000, 0.5, 1.0739755867},
                          {5000, 0.7, 1.2215561357},  {5000, 1.0, 1.4064735254},
                          {5000, 2.0, 1.7606359579},  {5000, 4.0, 1.7969530089},
                          {10000, 0.2, 0.9408467238}, {10000, 0.5, 1.0746080461},
                          {10000, 1.0, 1.2324692190}, {10000, 4.0, 1.4736617576}};
  for (const Point& point : points) {
    force::Setup setup = straight_cut(2, geometry::Slot{});
    setup.cut.a_p = point.depth_mm * unit::mm;
    setup.cut.Omega = point.rpm * unit::rpm;
    EXPECT_NEAR(growth(setup, benchmark_law(), benchmark_system()), point.expected,
                2e-10)
        << point.rpm << ' ' << point.depth_mm;
    EXPECT_NEAR(growth(setup, benchmark_law(), benchmark_system(), 1e-6),
                point.expected, 1e-6);
  }
}

TEST(Multiplier, OfAToolThatHardlyCutsIsItsDecay) {  // [D-3] [D-11]
  force::Setup setup = straight_cut(2, geometry::UpMilling{1 * unit::mm});
  setup.cut.a_p = 1e-12;
  const double tau = pi / setup.cut.Omega;
  EXPECT_NEAR(growth(setup, benchmark_law(), benchmark_system()),
              std::exp(-0.011 * 2 * pi * 922 * tau), 1e-9);
}

TEST(Multiplier, DoesNotDependOnWhereTheToolIsRotated) {  // [D-11]
  // A tool that is alike in all directions: an arc at entry equals one at exit.
  System system{{mode_of(0.04, 900, 0.02, 1, 0), mode_of(0.04, 900, 0.02, 0, 1)}};
  for (const double helix : {0.0, 0.5}) {
    force::Setup up = straight_cut(3, geometry::UpMilling{2 * unit::mm});
    up.cutter.helix = helix;
    force::Setup down = up;
    down.cut.engagement = geometry::DownMilling{2 * unit::mm};
    const double a = growth(up, benchmark_law(), system);
    EXPECT_NEAR(a, growth(down, benchmark_law(), system), 1e-8);
    EXPECT_GT(a, 1.05);
    // The same with its modes along other axes.
    system.modes = {mode_of(0.04, 900, 0.02, 0.6, 0.8),
                    mode_of(0.04, 900, 0.02, -0.8, 0.6)};
    EXPECT_NEAR(a, growth(up, benchmark_law(), system), 1e-8);
  }
}

TEST(Multiplier, OfATableIsThatOfATool) {  // [D-2]
  force::Setup setup = straight_cut(2, geometry::Slot{});
  System table = benchmark_system();
  table.modes[0].x = -1;
  EXPECT_NEAR(growth(setup, benchmark_law(), table),
              growth(setup, benchmark_law(), benchmark_system()), 1e-12);
}

TEST(Multiplier, OfTwoHalfModesIsThatOfOne) {  // [D-2]
  // Two equal modes, each twice as stiff, move like one.
  const ChipMode whole = mode_of(0.03993, 922, 0.011, 1, 0);
  ChipMode half = whole;
  half.mass *= 2;
  half.damping *= 2;
  half.stiffness *= 2;
  const force::Setup setup = straight_cut(2, geometry::Slot{});
  EXPECT_NEAR(growth(setup, benchmark_law(), {{whole}}),
              growth(setup, benchmark_law(), {{half, half}}), 1e-9);
}

TEST(Multiplier, OfARevolutionIsThePowerOfThatOfAPitch) {  // [D-8] [D-11]
  // A pitch that is nearly equal has the whole turn as its period.
  force::Setup setup = straight_cut(3, geometry::DownMilling{3 * unit::mm});
  setup.cutter.helix = 0.4;
  const double equal = growth(setup, benchmark_law(), benchmark_system());
  const double third = 2 * pi / 3;
  setup.cutter.pitch = {third + 1e-7, third - 1e-7, third};
  const double turn = growth(setup, benchmark_law(), benchmark_system());
  EXPECT_NEAR(turn, std::pow(equal, 3), 1e-5);
}

TEST(Multiplier, FollowsTheNormalsOfAnOnlyTooth) {  // [D-15]
  // Straight edges, two teeth, a slot: one cuts at a time. What is kept of the whole
  // period has both components all the same.
  force::Setup setup = straight_cut(2, geometry::Slot{});
  setup.chip = {chip::Model::radial, chip::Lookback::all};
  setup.runout.radial_offsets = {10e-6, -10e-6};
  const force::Power law{.K_t1 = 600e6, .K_r1 = 250e6, .m_t = 0.3, .m_r = 0.4};
  const System system{
      {mode_of(0.03993, 922, 0.011, 1, 0), mode_of(0.03, 700, 0.02, 0.6, 0.8)}};
  const auto largest = [&](const Resolution& resolution, std::size_t components) {
    const Directional d =
        DirectionalModel(setup, law, 1e-6, 1e-11).at_depth(setup.cut.a_p);
    PeriodMap map(d, system, setup.cut.Omega, resolution);
    EXPECT_EQ(map.components(), components);
    return numerics::dominant_eigenvalue([&](auto in, auto out) { map.apply(in, out); },
                                         map.size(), 1e-10)
        .value;
  };
  const auto along = largest({.factor = 1.5}, 1);
  const auto plane = largest({.factor = 1.5, .whole_period = true}, 2);
  EXPECT_NEAR(std::abs(along - plane), 0.0, 1e-7 * std::abs(plane));
  setup.cutter.helix = 0.3;  // the edge has many normals at a time
  largest({}, 2);
}

TEST(Multiplier, SaysHowGoodItIs) {
  const force::Setup setup = straight_cut(2, geometry::Slot{});
  const Directional d =
      DirectionalModel(setup, benchmark_law(), 1e-6, 1e-11).at_depth(1 * unit::mm);
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const Multiplier mu = multiplier(d, benchmark_system(), setup.cut.Omega, tolerance);
    EXPECT_LE(mu.error, tolerance);
    EXPECT_NEAR(std::abs(mu.value), 1.4064735254, tolerance);
  }
}

TEST(Multiplier, KnowsItsErrorWithoutMoreNodes) {  // [D-14]
  force::Setup setup = straight_cut(2, geometry::Slot{});
  for (const double rpm : {2500.0, 5000.0, 12000.0}) {
    setup.cut.Omega = rpm * unit::rpm;
    const Directional d =
        DirectionalModel(setup, benchmark_law(), 1e-6, 1e-11).at_depth(1 * unit::mm);
    const auto with = [&](double factor) {
      return multiplier_with(d, benchmark_system(), setup.cut.Omega, factor, 1e-12);
    };
    const double exact = std::abs(with(2.2).value);
    for (const double factor : {0.64, 0.8, 1.0}) {
      const Multiplier mu = with(factor);
      const double error = std::abs(std::abs(mu.value) - exact);
      EXPECT_GT(mu.error, error) << rpm << ' ' << factor;
      EXPECT_LT(mu.error, 1e5 * error + 1e-9) << rpm << ' ' << factor;
    }
  }
}

TEST(Multiplier, KnowsItsErrorWithRunout) {  // [D-14]
  // Kinks of one tooth come back one or two pitches later, where all pitches are cut up
  // alike: at ends of elements.
  force::Setup setup = straight_cut(3, geometry::UpMilling{4 * unit::mm});
  setup.cutter.helix = 0.5;
  setup.chip = {chip::Model::radial, chip::Lookback::all};
  setup.runout.radial_offsets = {10e-6, -20e-6, 5e-6};
  const System system{
      {mode_of(0.03993, 922, 0.011, 1, 0), mode_of(0.03, 700, 0.02, 0, 1)}};
  for (const double rpm : {800.0, 2500.0, 5000.0}) {
    setup.cut.Omega = rpm * unit::rpm;
    const Directional d =
        DirectionalModel(setup, benchmark_law(), 1e-6, 1e-11).at_depth(1 * unit::mm);
    const auto with = [&](double factor) {
      return multiplier_with(d, system, setup.cut.Omega, factor, 1e-11);
    };
    const double exact = std::abs(with(2.2).value);
    for (const double factor : {0.5, 0.64, 0.8, 1.0}) {
      const Multiplier mu = with(factor);
      const double error = std::abs(std::abs(mu.value) - exact);
      EXPECT_GT(mu.error, 0.0);
      EXPECT_GT(mu.error, error - 1e-9 * exact) << rpm << ' ' << factor;
    }
  }
}

TEST(Multiplier, OfManyCyclesATooth) {  // [D-11]
  // 55 cycles between two teeth, in elements of at most seven: more nodes agree.
  force::Setup setup = straight_cut(2, geometry::Slot{});
  setup.cut.Omega = 500 * unit::rpm;
  const Directional d =
      DirectionalModel(setup, benchmark_law(), 1e-6, 1e-11).at_depth(0.1 * unit::mm);
  const Multiplier coarse = multiplier(d, benchmark_system(), setup.cut.Omega, 1e-8);
  const Multiplier fine =
      multiplier_with(d, benchmark_system(), setup.cut.Omega, 2.5, 1e-11);
  EXPECT_NEAR(std::abs(coarse.value), std::abs(fine.value), 1e-8);
}

TEST(Multiplier, OfManyCyclesATurnWithRunout) {  // [D-11]
  // A kink of one tooth comes back half a turn later: without a cut there twice the nodes
  // do not settle the eighth digit.
  force::Setup setup = straight_cut(2, geometry::Slot{});
  setup.chip = {chip::Model::radial, chip::Lookback::all};
  setup.runout.radial_offsets = {13.9e-6, -13.9e-6};
  setup.cut.Omega = 1200 * unit::rpm;
  const force::Power law{.K_t1 = 166.7e6, .K_r1 = 58.4e6, .m_t = 0.598, .m_r = 0.598};
  const double mass = 5e5 / std::pow(2 * pi * 2500, 2);
  const System system{
      {mode_of(mass, 2500, 0.025, 1, 0), mode_of(mass, 2500, 0.025, 0, 1)}};
  const Directional d =
      DirectionalModel(setup, law, 1e-6, 1e-11).at_depth(0.5 * unit::mm);
  const Multiplier mu = multiplier(d, system, setup.cut.Omega, 1e-8);
  EXPECT_LE(mu.factor, 1.3);
  const Multiplier fine = multiplier_with(d, system, setup.cut.Omega, 2.0, 1e-10);
  EXPECT_NEAR(std::abs(mu.value), std::abs(fine.value), 2e-8 * std::abs(fine.value));
}

}  // namespace trochoid::dynamics::multiplier_test
