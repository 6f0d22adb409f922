#include <trochoid/dynamics/frequency_limit.h>

#include <trochoid/dynamics/lobes.h>
#include <trochoid/dynamics/tool_point.h>

#include "milling_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace trochoid::dynamics::frequency_limit_test {

using Complex = std::complex<double>;

std::vector<double> steps(double first, double last, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(first + (last - first) * i / (count - 1));
  }
  return values;
}

/// What a hammer would read of a system, without noise.
PointResponse tapped(const System& system, double from_Hz, double to_Hz, int lines) {
  PointResponse point;
  for (std::size_t motion = 0; motion < 2; ++motion) {
    for (std::size_t force = 0; force < 2; ++force) {
      MeasuredReceptance part{motion, force, {}, {}};
      bool moves = false;
      for (const double f : steps(from_Hz, to_Hz, lines)) {
        const double omega = 2 * pi * f;
        Complex H;
        for (const ChipMode& m : system.modes) {
          const double shape = (motion == 0 ? m.x : m.y) * (force == 0 ? m.x : m.y);
          H += shape * Complex(m.in_phase, m.lead * omega) /
               Complex(m.stiffness - m.mass * omega * omega, m.damping * omega);
          moves = moves || shape != 0;
        }
        part.omega.push_back(omega);
        part.H.push_back(H);
      }
      if (moves) {
        point.parts.push_back(part);
      }
    }
  }
  return point;
}

PointResponse benchmark_point() {
  return tapped(benchmark_system(), 100, 4000, 3901);
}

TEST(PointResponse, IsThatOfTheModesBetweenTheLines) {  // [D-20]
  const System system{{mode_of(0.03993, 922, 0.011, 0.8, 0.6)}};
  const PointResponse point = tapped(system, 100, 4000, 3901);
  const ChipMode& m = system.modes[0];
  for (const double f : {100.0, 515.3, 921.7, 3999.6}) {
    const double omega = 2 * pi * f;
    const Complex H =
        1.0 / Complex(m.stiffness - m.mass * omega * omega, m.damping * omega);
    const ComplexMatrix2 G = receptance(point, omega);
    // lines 1 Hz apart under a peak 20 Hz wide
    EXPECT_LT(std::abs(G[0] - 0.64 * H), 1e-4 * std::abs(H));
    EXPECT_LT(std::abs(G[1] - 0.48 * H), 1e-4 * std::abs(H));
    EXPECT_LT(std::abs(G[3] - 0.36 * H), 1e-4 * std::abs(H));
    EXPECT_EQ(receptance(point, -omega)[1], std::conj(G[1]));
  }
  EXPECT_EQ(receptance(point, 2 * pi * 4001)[0], Complex(0, 0));
  EXPECT_EQ(receptance(point, 2 * pi * 20)[0].imag(), 0);
  EXPECT_NEAR(receptance(point, 2 * pi * 20)[0].real(), 0.64 / m.stiffness,
              0.02 / m.stiffness);
}

TEST(PointResponse, ToolAndWorkAddUp) {  // [D-20]
  PointResponse both = benchmark_point();
  const Complex alone = receptance(both, 5000)[0];
  both.parts.push_back(both.parts.front());
  EXPECT_EQ(receptance(both, 5000)[0], 2.0 * alone);
}

TEST(ForceHarmonics, AddUpToTheMatrices) {  // [D-21]
  const DirectionalModel model(straight_cut(2, geometry::Slot{}), benchmark_law(), 1e-6,
                               1e-11);
  const ForceHarmonics f = force_harmonics(model.at_depth(1e-3), 200);
  ASSERT_EQ(f.coefficients.size(), 2U);
  // A slot of one tooth at a time: g is that of the tooth, at every angle.
  const double phi = 1.1;
  Complex sum;
  for (int n = -f.most; n <= f.most; ++n) {
    sum += f.coefficients[0][static_cast<std::size_t>(n + f.most)][0] *
           std::polar(1.0, n * 2 * pi * phi / f.period);
  }
  const double expected =
      1e-3 * (-std::cos(phi) * 600e6 - std::sin(phi) * 200e6) * std::sin(phi);
  // What is cut off falls with the first power of the number of waves: g has kinks.
  EXPECT_NEAR(sum.real(), expected, 5e-3 * std::abs(expected));
  EXPECT_NEAR(sum.imag(), 0, 1e-9 * std::abs(expected));
  // The mean: - (1/pi) integral of K_r sin^2 over a pitch, which is half of K_r.
  const ComplexMatrix2& mean = f.coefficients[0][static_cast<std::size_t>(f.most)];
  EXPECT_NEAR(mean[0].real(), -1e-3 * 0.5 * 200e6, 1e-6 * 200e6 * 1e-3);
}

/// The zeroth order solution along its lobes: for a frequency the depth is
/// 1 / (2 A Re G), and the speed follows from the phase.
double least_on_lobes(double mean, double Omega, double teeth) {
  const ChipMode m = benchmark_system().modes[0];
  double least = 1e9;
  double before = 0.0;
  double depth_before = 0.0;
  const double tau = 2 * pi / (teeth * Omega);
  for (double f = 300; f < 3000; f += 0.01) {
    const double omega = 2 * pi * f;
    const Complex G =
        1.0 / Complex(m.stiffness - m.mass * omega * omega, m.damping * omega);
    const Complex loop = mean * G * (1.0 - std::polar(1.0, -omega * tau));
    const double depth = 1 / loop.real();
    if (before != 0 && (loop.imag() > 0) != (before > 0) && depth > 0 &&
        depth_before > 0) {
      least = std::min(least, depth);
    }
    before = loop.imag();
    depth_before = depth;
  }
  return least;
}

TEST(FrequencyLimit, OfTheMeanForceIsThatOfTheLobes) {  // [D-22] [D-23]
  const DirectionalModel model(straight_cut(2, geometry::Slot{}), benchmark_law(), 1e-6,
                               1e-11);
  const auto depth = steps(0.1e-3, 20e-3, 40);
  for (const double rpm : {5000.0, 9000.0, 20300.0}) {
    const auto limit = frequency_limit(model, benchmark_point(), rpm * unit::rpm, depth,
                                       FrequencyOptions{});
    ASSERT_TRUE(limit.has_value());
    const double expected = least_on_lobes(-0.5 * 200e6, rpm * unit::rpm, 2);
    EXPECT_NEAR(limit->depth, expected, 2e-3 * expected) << rpm;
    EXPECT_GT(limit->chatter_frequency, 922);
    EXPECT_LT(limit->chatter_frequency, 1300);
  }
}

double spectral(const DirectionalModel& model, const System& system, double Omega) {
  const auto limit =
      limit_depth(model, system, Omega, steps(0.05e-3, 10e-3, 200), 1e-6);
  return limit ? limit->depth : 0.0;
}

TEST(FrequencyLimit, WithHarmonicsComesToThatOfTheMultiplier) {  // [D-22]
  const DirectionalModel model(straight_cut(2, geometry::Slot{}), benchmark_law(), 1e-6,
                               1e-11);
  const auto depth = steps(0.05e-3, 10e-3, 200);
  for (const double rpm : {5000.0, 12000.0, 20300.0}) {
    const double exact = spectral(model, benchmark_system(), rpm * unit::rpm);
    const auto error = [&](int harmonics) {
      const auto limit = frequency_limit(model, benchmark_point(), rpm * unit::rpm,
                                         depth, {.harmonics = harmonics});
      return limit ? std::abs(limit->depth / exact - 1) : 1.0;
    };
    EXPECT_LT(error(8), 0.01) << rpm;
    EXPECT_LT(error(8), error(0)) << rpm;
  }
}

TEST(FrequencyLimit, SeesAFlipThatTheMeanForceDoesNot) {  // [D-22]
  // A twentieth of the diameter: teeth touch briefly, and every second one hits alike.
  const DirectionalModel model(straight_cut(2, geometry::DownMilling{0.5e-3}),
                               benchmark_law(), 1e-6, 1e-11);
  const double Omega = 18000 * unit::rpm;
  const auto limit =
      limit_depth(model, benchmark_system(), Omega, steps(0.05e-3, 30e-3, 300), 1e-6);
  ASSERT_TRUE(limit.has_value());
  const auto with = [&](int harmonics) {
    const auto found =
        frequency_limit(model, benchmark_point(), Omega, steps(0.05e-3, 30e-3, 300),
                        {.harmonics = harmonics});
    return found ? found->depth : 30e-3;
  };
  EXPECT_NEAR(with(8), limit->depth, 0.03 * limit->depth);
  EXPECT_GT(with(0), 1.5 * limit->depth);
}

TEST(FrequencyLimit, OfAHelixIsFoundByADepthSearch) {  // [D-24]
  force::Setup setup = straight_cut(2, geometry::Slot{});
  setup.cutter.helix = 30 * unit::deg;
  const DirectionalModel model(setup, benchmark_law(), 1e-6, 1e-11);
  ASSERT_FALSE(model.proportional());
  const double Omega = 12000 * unit::rpm;
  const double exact = spectral(model, benchmark_system(), Omega);
  const auto limit =
      frequency_limit(model, benchmark_point(), Omega, steps(0.05e-3, 10e-3, 200),
                      {.harmonics = 6, .tolerance = 1e-5});
  ASSERT_TRUE(limit.has_value());
  EXPECT_NEAR(limit->depth, exact, 0.01 * exact);
}

TEST(FrequencyLimit, WithRunoutHasTheTurnForAPeriod) {  // [D-22]
  force::Setup setup = straight_cut(2, geometry::Slot{});
  setup.chip = {chip::Model::radial, chip::Lookback::all};
  setup.runout.radial_offsets = {25e-6, 0.0};
  const DirectionalModel model(setup, benchmark_law(), 1e-6, 1e-11);
  const double Omega = 12000 * unit::rpm;
  const double exact = spectral(model, benchmark_system(), Omega);
  const auto limit = frequency_limit(model, benchmark_point(), Omega,
                                     steps(0.05e-3, 10e-3, 200), {.harmonics = 6});
  ASSERT_TRUE(limit.has_value());
  EXPECT_NEAR(limit->depth, exact, 0.02 * exact);
}

/// Two modes, the same along x and y, the sharp one with two lines between its half-power
/// points where lines are 3.3 Hz apart.
System two_modes_each_way() {
  System system;
  for (const double x : {1.0, 0.0}) {
    const auto add = [&](double stiffness, double frequency_Hz, double ratio) {
      const double mass = stiffness / std::pow(2 * pi * frequency_Hz, 2);
      system.modes.push_back(mode_of(mass, frequency_Hz, ratio, x, 1 - x));
    };
    add(1.2e8, 292, 0.0115);
    add(1.6e8, 1290, 0.03);
  }
  return system;
}

force::Setup half_immersion() {
  force::Setup setup = straight_cut(4, geometry::DownMilling{8 * unit::mm});
  setup.cutter.profile = geometry::cylinder(16 * unit::mm);
  setup.cutter.lag_diameter = 16 * unit::mm;
  return setup;
}

TEST(FrequencyLimit, FollowsEveryBranchBetweenCoarseLines) {  // [D-23] [D-34]
  const DirectionalModel model(
      half_immersion(), force::LinearEdge{.K_tc = 800e6, .K_rc = 250e6}, 1e-6, 1e-11);
  const System system = two_modes_each_way();
  const PointResponse point = tapped(system, 49.5, 2999.7, 895);
  for (const double rpm : {7000.0, 8000.0, 9000.0, 11000.0, 14000.0}) {
    const auto exact =
        limit_depth(model, system, rpm * unit::rpm, steps(0.2e-3, 40e-3, 200), 1e-6);
    const auto limit = frequency_limit(model, point, rpm * unit::rpm,
                                       steps(0.4e-3, 40e-3, 100), {.harmonics = 4});
    ASSERT_TRUE(exact.has_value());
    ASSERT_TRUE(limit.has_value());
    EXPECT_NEAR(limit->depth, exact->depth, 0.03 * exact->depth) << rpm;
  }
}

/// A mode of 800 Hz along y with a residue that is turned.
System turned_mode(double turned) {
  const double omega = 2 * pi * 800;
  structure::FittedMode mode;
  mode.omega.value = omega;
  mode.zeta.value = 0.03;
  mode.phi = {std::polar(std::sqrt(omega * omega / 2e7), 0.5 * turned)};
  return {{complex_mode(mode, 0.0, 1.0)}};
}

TEST(ComplexMode, HasItsLimitWhereAnIndependentProgramFindsIt) {  // [D-35]
  force::Setup setup = straight_cut(2, geometry::DownMilling{6 * unit::mm});
  setup.cutter.profile = geometry::cylinder(12 * unit::mm);
  setup.cutter.lag_diameter = 12 * unit::mm;
  const DirectionalModel model(setup, force::LinearEdge{.K_tc = 700e6, .K_rc = 200e6},
                               1e-6, 1e-11);
  const double Omega = 9000 * unit::rpm;
  const std::array<std::pair<double, double>, 4> known{
      {{-20, 5.851e-3}, {-10, 6.729e-3}, {0, 8.01e-3}, {10, 9.91e-3}}};
  for (const auto& [turned, expected] : known) {
    const System system = turned_mode(turned * unit::deg);
    const auto limit =
        limit_depth(model, system, Omega, steps(0.1e-3, 12e-3, 120), 1e-6);
    ASSERT_TRUE(limit.has_value());
    EXPECT_NEAR(limit->depth, expected, 0.005 * expected) << turned;
    const auto measured = frequency_limit(model, tapped(system, 300, 3000, 2701), Omega,
                                          steps(0.1e-3, 12e-3, 120), {.harmonics = 6});
    ASSERT_TRUE(measured.has_value());
    EXPECT_NEAR(measured->depth, limit->depth, 0.01 * limit->depth) << turned;
  }
}

TEST(PointResponse, FollowsAPeakWithTwoLines) {  // [D-34]
  const System system{{mode_of(1.0, 292, 0.0115, 1, 0)}};
  const PointResponse point = tapped(system, 49.5, 2999.7, 895);
  const ChipMode& m = system.modes[0];
  for (double f = 270; f < 320; f += 0.1) {
    const double omega = 2 * pi * f;
    const Complex H =
        1.0 / Complex(m.stiffness - m.mass * omega * omega, m.damping * omega);
    EXPECT_LT(std::abs(receptance(point, omega)[0] - H), 0.01 / (0.023 * m.stiffness))
        << f;
  }
}

TEST(PointResponse, HasAllPeaksThatStandOut) {
  const PointResponse point = tapped(two_modes_each_way(), 49.5, 2999.7, 895);
  const std::vector<Peak> found = peaks(point.parts.front());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].omega, 2 * pi * 292, 2 * pi * 3.3);
  EXPECT_LE(found[0].lines, 3U);
  EXPECT_NEAR(found[1].omega, 2 * pi * 1290, 2 * pi * 3.3);
  EXPECT_NEAR(found[1].width, 2 * pi * 77, 2 * pi * 8);
}

TEST(FrequencyLimit, IsAbsentWhereAllDepthsAreStable) {  // [D-23]
  const DirectionalModel model(straight_cut(2, geometry::Slot{}), benchmark_law(), 1e-6,
                               1e-11);
  EXPECT_FALSE(frequency_limit(model, benchmark_point(), 5000 * unit::rpm,
                               steps(0.01e-3, 0.1e-3, 5), {.harmonics = 2})
                   .has_value());
}

}  // namespace trochoid::dynamics::frequency_limit_test
