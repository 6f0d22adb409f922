#include <trochoid/dynamics/force_harmonics.h>
#include <trochoid/dynamics/frequency_limit.h>
#include <trochoid/dynamics/lobes.h>
#include <trochoid/dynamics/nodes.h>
#include <trochoid/dynamics/stability.h>

#include "milling_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::dynamics::process_damping_test {

constexpr force::ProcessDamping worn{80e-6, 3e13, 0.3};
constexpr double c_worn = 0.5 * 3e13 * 80e-6 * 80e-6;  // [N/m]

force::Setup worn_cut(const geometry::Engagement& engagement = geometry::Slot{}) {
  force::Setup setup = straight_cut(2, engagement);
  setup.process_damping = worn;
  return setup;
}

DirectionalModel model_of(const force::Setup& setup) {
  return {setup, benchmark_law(), 1e-6, 1e-11};
}

System stiff_system() {
  return {{mode_of(0.4, 600, 0.02, 1, 0), mode_of(0.2, 900, 0.02, 0, 1)}};
}

/// What acts on dq/dphi at an angle.
Matrix2 damping_at(const Directional& cut, double phi) {
  const double from = cut.elements.front().from;
  phi -= cut.period * std::floor((phi - from) / cut.period);
  Matrix2 out{};
  for (const DirectionalElement& e : cut.elements) {
    if (phi < e.from || phi >= e.to || e.damping.empty()) continue;
    std::vector<double> row(e.damping.size());
    lagrange_row(element_nodes(directional_degree),
                 (2 * phi - e.from - e.to) / (e.to - e.from), row);
    for (std::size_t i = 0; i < row.size(); ++i) {
      for (std::size_t q = 0; q < 4; ++q) out[q] += row[i] * e.damping[i][q];
    }
  }
  return out;
}

TEST(ProcessDamping, OfOneToothIsThatOfItsNormal) {  // [D-30] [D-31]
  const Directional cut = model_of(worn_cut()).at_depth(2e-3);
  for (const double theta : {0.3, 1.2, 2.9}) {
    const double s = std::sin(theta);
    const double c = std::cos(theta);
    const double f_r = c_worn * 2e-3 / 5e-3;  // per dq/dphi along n
    const double f_t = 0.3 * f_r;
    const Matrix2 D = damping_at(cut, theta);
    EXPECT_NEAR(D[0], -(f_t * c + f_r * s) * s, 1e-9 * f_r);
    EXPECT_NEAR(D[1], -(f_t * c + f_r * s) * c, 1e-9 * f_r);
    EXPECT_NEAR(D[2], (f_t * s - f_r * c) * s, 1e-9 * f_r);
    EXPECT_NEAR(D[3], (f_t * s - f_r * c) * c, 1e-9 * f_r);
  }
}

TEST(ProcessDamping, OfAHelixIsALinearLawOverTheRadius) {  // [D-31]
  force::Setup setup = worn_cut(geometry::DownMilling{2e-3});
  setup.cutter.helix = 30 * unit::deg;
  setup.runout.radial_offsets = {2e-6, -2e-6};
  setup.chip.model = chip::Model::radial;
  const Directional cut = model_of(setup).at_depth(3e-3);
  setup.process_damping = {};
  const DirectionalModel linear(
      setup, force::LinearEdge{.K_tc = 0.3 * c_worn, .K_rc = c_worn}, 1e-6, 1e-11);
  const Directional other = linear.at_depth(3e-3);
  ASSERT_EQ(cut.elements.size(), other.elements.size());
  double most = 0.0;
  for (std::size_t k = 0; k < cut.elements.size(); ++k) {
    const auto& D = cut.elements[k].damping;
    const auto& A = other.elements[k].matrices[0];
    ASSERT_EQ(D.empty(), A.empty());
    for (std::size_t i = 0; i < D.size(); ++i) {
      for (std::size_t q = 0; q < 4; ++q) {
        most = std::max(most, std::abs(D[i][q]));
        EXPECT_NEAR(D[i][q], A[i][q] / 5e-3, 1e-8 * c_worn);
      }
    }
  }
  EXPECT_GT(most, 0.1 * c_worn * 3e-3 / 5e-3);
}

/// Along a ball the speed grows with the radius: integrals of dz/R and of sin(kappa) dz/R.
TEST(ProcessDamping, OfABallIsThatOfItsRadii) {  // [D-31]
  force::Setup setup = worn_cut();
  setup.cutter.profile = geometry::ball(10e-3);
  setup.cut.f_z = 1e-6;
  setup.cut.a_p = 2e-3;
  const Directional cut = model_of(setup).at_depth(2e-3);
  const double theta = 1.0;
  const double s = std::sin(theta);
  const double c = std::cos(theta);
  const double f_t = 0.3 * c_worn * std::acos(1 - 2e-3 / 5e-3);
  const double f_r = c_worn * 2e-3 / 5e-3;
  const Matrix2 D = damping_at(cut, theta);
  // Within a feed of the axis R is not below it: f_z/D of the first integral
  EXPECT_NEAR(D[0], -(f_t * c + f_r * s) * s, 2e-4 * f_r);
  EXPECT_NEAR(D[1], -(f_t * c + f_r * s) * c, 2e-4 * f_r);
  EXPECT_NEAR(D[2], (f_t * s - f_r * c) * s, 2e-4 * f_r);
  EXPECT_NEAR(D[3], (f_t * s - f_r * c) * c, 2e-4 * f_r);
}

TEST(Nodes, SlopesAreThoseOfThePolynomial) {  // [D-32]
  for (const int n : {6, 40, 160}) {
    const ElementNodes& nodes = element_nodes(n);
    const std::vector<double> E = slopes_at_nodes(nodes);
    const double w = n < 10 ? 0.3 : 0.3 * n;
    for (std::size_t i = 0; i < nodes.t.size(); ++i) {
      double slope = 0.0;
      for (std::size_t j = 0; j < nodes.t.size(); ++j) {
        slope += E[i * nodes.t.size() + j] * std::sin(w * nodes.t[j]);
      }
      const double scale = n < 10 ? 1e-5 : 1e-11 * n * n;  // what degree 6 leaves
      EXPECT_NEAR(slope, w * std::cos(w * nodes.t[i]), scale) << n;
    }
  }
}

/// Turning: m x'' + (c + beta) x' + k x = - alpha (x - x(t - tau)) has
/// x = e^(i omega t) where m omega^2 - k = alpha (1 - cos(omega tau)) and
/// omega (c + beta) = - alpha sin(omega tau).
TEST(ProcessDamping, OfATurnedBarMeetsItsCharacteristicEquation) {  // [D-30]
  const ChipMode m = mode_of(0.4, 600, 0.02, 1, 0);
  for (const double beta : {0.0, 30.0, 100.0}) {
    const double phase = 4.2;  // omega tau but for whole turns
    const double s = std::sin(phase);
    const double B = (m.damping + beta) * (1 - std::cos(phase));
    const double omega =
        (-B - std::sqrt(B * B + 4 * m.mass * m.stiffness * s * s)) / (2 * m.mass * s);
    const double alpha = (m.mass * omega * omega - m.stiffness) / (1 - std::cos(phase));
    const double tau = (phase + 5 * 2 * pi) / omega;
    const double Omega = 2 * pi / tau;
    const std::size_t n = directional_degree + 1;
    DirectionalElement turn{.from = 0, .to = 2 * pi, .matrices = {}, .damping = {}};
    turn.matrices.assign(2, std::vector<Matrix2>(n, Matrix2{-alpha, 0, 0, 0}));
    if (beta > 0) {
      turn.damping.assign(n, Matrix2{-beta * Omega, 0, 0, 0});
    }
    const Directional cut{.period = 2 * pi, .delays = {2 * pi}, .elements = {turn}};
    const auto mu = multiplier(cut, {{m}}, Omega, 1e-9).value;
    EXPECT_NEAR(std::abs(mu), 1, 1e-8) << beta;
    EXPECT_NEAR(std::arg(mu), 2 * pi - phase, 1e-7) << beta;
  }
}

/// The least limit of a lobe and what is around it.
double least_limit(const force::Setup& setup, double rpm) {
  const DirectionalModel model = model_of(setup);
  std::vector<double> depth;
  for (int i = 1; i <= 40; ++i) depth.push_back(i * 1e-3);
  double least = 1.0;
  for (int i = 0; i < 12; ++i) {
    const double Omega = rpm * std::pow(1.3, i / 12.0) * unit::rpm;
    const auto limit = limit_depth(model, stiff_system(), Omega, depth, 1e-4);
    least = std::min(least, limit ? limit->depth : 1.0);
  }
  return least;
}

TEST(ProcessDamping, RaisesTheLimitOfSlowCutsAndNotOfFastOnes) {  // [D-30] [F-16]
  const force::Setup sharp = straight_cut(2, geometry::Slot{});
  const double slow = least_limit(worn_cut(), 900) / least_limit(sharp, 900);
  const double medium = least_limit(worn_cut(), 4000) / least_limit(sharp, 4000);
  const double fast = least_limit(worn_cut(), 100000) / least_limit(sharp, 100000);
  EXPECT_GT(slow, 1.5);
  EXPECT_GT(slow, medium);
  EXPECT_GT(medium, fast);
  EXPECT_LT(fast, 1.03);
  EXPECT_GT(fast, 0.999);
}

TEST(ProcessDamping, NodesAreEnough) {  // [D-14] [D-32]
  for (const double rpm : {700.0, 3000.0, 12000.0}) {
    const Directional cut = model_of(worn_cut()).at_depth(1.5e-3);
    const double Omega = rpm * unit::rpm;
    const Multiplier mu = multiplier(cut, stiff_system(), Omega, 1e-8);
    const Multiplier finer = multiplier_with(cut, stiff_system(), Omega, 2.5, 1e-11);
    EXPECT_NEAR(std::abs(mu.value), std::abs(finer.value), 1e-8) << rpm;
  }
}

/// What a hammer would read of modes along x and y, without noise.
PointResponse tapped(const System& system) {
  PointResponse point;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    MeasuredReceptance part{axis, axis, {}, {}};
    for (int f = 20; f < 6000; ++f) {
      const double omega = 2 * pi * f;
      std::complex<double> H;
      for (const ChipMode& m : system.modes) {
        const double shape = axis == 0 ? m.x * m.x : m.y * m.y;
        H += shape / std::complex<double>(m.stiffness - m.mass * omega * omega,
                                          m.damping * omega);
      }
      part.omega.push_back(omega);
      part.H.push_back(H);
    }
    point.parts.push_back(part);
  }
  return point;
}

TEST(ProcessDamping, MultiFrequencyAgreesWithTheMultiplier) {  // [D-33]
  const PointResponse point = tapped(stiff_system());
  std::vector<double> depth;
  for (int i = 1; i <= 20; ++i) depth.push_back(i * 0.5e-3);
  for (const auto& [rpm, helix] : {std::pair{4000.0, 0.0}, std::pair{9000.0, 0.5}}) {
    force::Setup setup = worn_cut(geometry::UpMilling{6e-3});
    setup.cutter.helix = helix;  // depths between those given
    const DirectionalModel model = model_of(setup);
    const double Omega = rpm * unit::rpm;
    const auto limit = limit_depth(model, stiff_system(), Omega, depth, 1e-6);
    const auto found = frequency_limit(model, point, Omega, depth, {.harmonics = 6});
    ASSERT_TRUE(limit && found);
    // Harmonics beyond the sixth are left out, and so is the curve between two depths
    EXPECT_NEAR(found->depth / limit->depth, 1, 3e-3) << rpm;
  }
}

TEST(ProcessDamping, HarmonicsFollowTheDepth) {  // [D-33] [D-21]
  for (const double helix : {0.0, 0.3}) {
    force::Setup setup = worn_cut(geometry::UpMilling{6e-3});
    setup.cutter.helix = helix;
    const DirectionalModel model = model_of(setup);
    const std::vector<double> depth = {1e-3, 1.02e-3};
    const DepthHarmonics forces(model, depth, 2);
    const auto between = forces.at(1.01e-3).damping;
    const auto direct = force_harmonics(model.at_depth(1.01e-3), 120).damping;
    ASSERT_FALSE(between.empty());
    const std::size_t middle = between.size() / 2;
    for (std::size_t n = 0; n < 5; ++n) {
      for (std::size_t q = 0; q < 4; ++q) {
        EXPECT_NEAR(std::abs(between[middle + n][q] - direct[120 + n][q]), 0,
                    1e-4 * std::abs(direct[120][0]));
      }
    }
    // The mean force of D over a pitch: over the arc, c sin^2 + mu c sin cos
    if (helix == 0) {
      const double to = std::acos(1 - 2 * 6e-3 / 10e-3);
      const double ss = to / 2 - std::sin(2 * to) / 4;
      const double sc = std::sin(to) * std::sin(to) / 2;
      EXPECT_NEAR(direct[120][0].real(),
                  -c_worn * 1.01e-3 / 5e-3 * (ss + 0.3 * sc) / pi, 1e-6 * c_worn);
    }
  }
}

TEST(ProcessDamping, OfASharpEdgeIsNone) {  // [D-30]
  force::Setup setup = straight_cut(2, geometry::Slot{});
  const Directional without = model_of(setup).at_depth(1e-3);
  setup.process_damping = {.wear_land = 0.0, .indentation = 3e13, .friction = 0.3};
  const Directional with = model_of(setup).at_depth(1e-3);
  ASSERT_EQ(with.elements.size(), without.elements.size());
  for (std::size_t k = 0; k < with.elements.size(); ++k) {
    EXPECT_TRUE(with.elements[k].damping.empty());
    EXPECT_EQ(with.elements[k].matrices, without.elements[k].matrices);
  }
}

}  // namespace trochoid::dynamics::process_damping_test
