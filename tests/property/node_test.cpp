#include <trochoid/base/units.h>
#include <trochoid/force/edge_curve.h>
#include <trochoid/force/forces.h>
#include <trochoid/numerics/gauss_kronrod.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace trochoid::force {
namespace {

constexpr double pi = std::numbers::pi;
constexpr LinearEdge K{2600e6, 1500e6, 330e6, 7e3, 3e3, 1e3};

using Random = std::mt19937;
using Cut = Setup;  // gtest has a Setup of its own

double between(Random& random, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(random);
}
int one_of(Random& random, int n) {
  return std::uniform_int_distribution<int>(0, n - 1)(random);
}

geometry::Engagement random_engagement(Random& random, double D) {
  switch (one_of(random, 4)) {
    case 0:
      return geometry::Slot{};
    case 1:
      return geometry::UpMilling{between(random, 0.02, 1) * D};
    case 2:
      return geometry::DownMilling{between(random, 0.02, 1) * D};
    default: {
      const double y = between(random, -0.45, 0.3) * D;
      return geometry::Band{y, y + between(random, 0.05, 0.7) * D};
    }
  }
}

geometry::Profile random_profile(Random& random, double D) {
  switch (one_of(random, 4)) {
    case 0:
      return geometry::cylinder(D);
    case 1:
      return geometry::bull_nose(D, between(random, 0.02, 0.3) * D);
    case 2:
      return geometry::taper(D, between(random, -3, 10) * unit::deg);
    default:
      return geometry::taper(D, between(random, 0, 10) * unit::deg,
                             between(random, 0.02, 0.2) * D);
  }
}

/// Any shape that stays away from the axis; 1 to 8 teeth, offsets and eccentricity up to
/// three feeds.
Cut random_cut(Random& random) {
  Cut cut;
  const double D = between(random, 6e-3, 30e-3);
  cut.cutter.profile = random_profile(random, D);
  cut.cutter.pitch.resize(static_cast<std::size_t>(1 + one_of(random, 8)));
  cut.cutter.helix = one_of(random, 6) == 0 ? between(random, 0.001, 1) * unit::deg
                                            : between(random, 1, 60) * unit::deg;
  cut.cutter.lag_law = one_of(random, 2) == 0 ? geometry::LagLaw::constant_lead
                                              : geometry::LagLaw::constant_helix;
  cut.cutter.lag_diameter = D;
  cut.cut = {.engagement = random_engagement(random, D),
             .a_p = between(random, 0.05, 1.5) * D,
             .f_z = between(random, 5e-6, 60e-6),
             .Omega = 90.0};
  constexpr std::array<double, 4> feeds = {0.0, 0.3, 1.0, 3.0};
  const double offset =
      feeds[static_cast<std::size_t>(one_of(random, 4))] * cut.cut.f_z;
  double sum = 0.0;
  const bool unequal = one_of(random, 2) == 0;
  for (double& p : cut.cutter.pitch) sum += p = unequal ? between(random, 0.6, 1.4) : 1;
  for (double& p : cut.cutter.pitch) {
    p *= 2 * pi / sum;
    cut.runout.radial_offsets.push_back(offset * between(random, -1, 1));
  }
  cut.runout.eccentricity =
      feeds[static_cast<std::size_t>(one_of(random, 4))] * cut.cut.f_z;
  cut.runout.angle = between(random, -pi, pi);
  cut.runout.order = one_of(random, 3) == 0 ? geometry::EccentricityOrder::first
                                            : geometry::EccentricityOrder::exact;
  cut.chip.model = one_of(random, 3) == 0 ? static_cast<chip::Model>(one_of(random, 4))
                                          : chip::Model::trochoidal;
  cut.chip.lookback =
      one_of(random, 4) == 0 ? chip::Lookback::previous : chip::Lookback::all;
  cut.edge_length =
      one_of(random, 2) == 0 ? EdgeLength::true_length : EdgeLength::axial;
  return cut;
}

/// Ends, and many points between them, most of them near the tip: no short cut hides.
std::vector<double> close_grid(const Edges& edges) {
  constexpr int parts = 60;
  constexpr int parts_at_tip = 400;
  std::vector<double> grid = {edges.ends.front()};
  for (std::size_t i = 0; i + 1 < edges.ends.size(); ++i) {
    const bool tip = i == 0 && edges.point(0.0).meridian.r == 0;
    const int count = tip ? parts_at_tip : parts;
    for (int k = 1; k <= count; ++k) {
      const double t = k / static_cast<double>(count);
      grid.push_back(edges.ends[i] +
                     (edges.ends[i + 1] - edges.ends[i]) * (tip ? t * t * t * t : t));
    }
  }
  return grid;
}

/// F-4 by the chip alone, its changes found by looking closely.
Vector3 plain_force(const Edges& edges, double phi) {
  EdgeCurve curve(edges);
  numerics::PieceFinder<EdgeCurve> finder(curve, 1e-13 * edges.ends.back());
  std::vector<numerics::Piece<EdgeState>> pieces;
  Vector3 sum{};
  const auto add = [&](double s, double weight, Vector3& out) {
    const EdgePoint p = edges.point(s);
    const EdgeState state = curve.state(p);
    const double h = state.chip.h * p.meridian.sin_kappa;
    const double t = weight * (K.K_tc * h + K.K_te * p.dS);
    const double r = weight * (K.K_rc * h + K.K_re * p.dS);
    const double a = weight * (K.K_ac * h + K.K_ae * p.dS);
    const double inward = r * p.meridian.sin_kappa + a * p.meridian.cos_kappa;
    out[0] += -t * std::cos(state.theta) - inward * std::sin(state.theta);
    out[1] += t * std::sin(state.theta) - inward * std::cos(state.theta);
    out[2] += r * p.meridian.cos_kappa - a * p.meridian.sin_kappa;
  };
  const double allowed = 1e-11 * edges.ends.back() * K.K_te;
  for (std::size_t j = 0; j < edges.psi.size(); ++j) {
    curve.stand_at(phi, j);
    std::vector<double> grid = close_grid(edges);
    curve.add_seeds(grid);
    finder.find(grid, pieces);
    for (const auto& piece : pieces) {
      double from = piece.from;
      for (const double end : edges.ends) {
        const double to = std::min(end, piece.to);
        if (to > from) {
          numerics::add_integral(from, to, add, {allowed, allowed, allowed},
                                 1e-9 * edges.ends.back(), sum);
          from = to;
        }
      }
    }
  }
  return sum;
}

double size(const Vector3& F) {
  return std::max({std::abs(F[0]), std::abs(F[1]), std::abs(F[2])});
}

TEST(Nodes, GiveTheForceOfTheChipAlone) {  // [F-15]
  Random random(7);
  for (int n = 0; n < 2500; ++n) {
    const Cut cut = random_cut(random);
    const Edges edges(cut);
    std::vector<double> phi;
    for (int i = 0; i < 8; ++i) phi.push_back(between(random, 0, 2 * pi));
    std::vector<Vector3> expected;
    double peak = 0.0;
    for (const double angle : phi) {
      expected.push_back(plain_force(edges, angle));
      peak = std::max(peak, size(expected.back()));
    }
    // Angles at random may all lie in the air, or nearly.
    const double least = K.K_te * 1e-2 * cut.cut.a_p;
    for (const double tolerance : {1e-6, 1e-9}) {
      const auto F = forces(cut, K, phi, tolerance);
      for (std::size_t i = 0; i < phi.size(); ++i) {
        const Vector3 off{F[i][0] - expected[i][0], F[i][1] - expected[i][1],
                          F[i][2] - expected[i][2]};
        EXPECT_LE(size(off), std::max(1e-8, 0.1 * tolerance) * std::max(peak, least))
            << n << " at " << phi[i] << ", tolerance " << tolerance << ", model "
            << static_cast<int>(cut.chip.model) << ", peak " << peak << ", teeth "
            << cut.cutter.teeth();
      }
    }
  }
}

TEST(Nodes, OfABallMeetTheQuadratureNearTheAxis) {  // [F-15]
  Random random(9);
  for (int n = 0; n < 30; ++n) {
    Cut cut = random_cut(random);
    const double D = cut.cutter.profile.D;
    cut.cutter.profile = geometry::ball(D);
    cut.cutter.pitch = geometry::equal_pitch(1 + one_of(random, 4));
    cut.runout.radial_offsets = {};
    cut.runout.eccentricity = 0.3 * cut.cut.f_z;
    cut.cut.a_p = between(random, 0.1, 0.8) * D;
    const Edges edges(cut);
    std::vector<double> phi;
    for (int i = 0; i < 12; ++i) phi.push_back(2 * pi * (i + 0.3) / 12);
    const auto F = forces(cut, K, phi, 1e-6);
    double peak = K.K_te * 1e-2 * cut.cut.a_p;
    double error = 0.0;
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const Vector3 expected = plain_force(edges, phi[i]);
      peak = std::max(peak, size(expected));
      error = std::max(error, size({F[i][0] - expected[0], F[i][1] - expected[1],
                                    F[i][2] - expected[2]}));
    }
    // What is left to the quadrature near the axis has the tolerance of forces().
    EXPECT_LE(error, 5e-8 * peak) << n;
  }
}

TEST(Nodes, MatricesTimesCoefficientsAreTheForce) {  // [F-4] [F-15]
  Random random(8);
  const std::array<double, 6> k = {K.K_tc, K.K_rc, K.K_ac, K.K_te, K.K_re, K.K_ae};
  for (int n = 0; n < 20; ++n) {
    const Cut cut = random_cut(random);
    std::vector<double> phi;
    for (int i = 0; i < 300; ++i) phi.push_back(4 * pi * (i + 0.3) / 300);
    const auto F = forces(cut, K, phi, 1e-9);
    std::vector<double> C(phi.size() * 18);
    ForceMatrix(cut, K, 1e-9).evaluate(phi, C);
    double peak = 1.0;
    for (const auto& f : F) peak = std::max(peak, size(f));
    for (std::size_t i = 0; i < 3 * phi.size(); ++i) {
      double sum = 0.0;
      for (std::size_t q = 0; q < 6; ++q) sum += C[6 * i + q] * k[q];
      ASSERT_NEAR(sum, F[i / 3][i % 3], 1e-9 * peak) << n;
    }
  }
}

}  // namespace
}  // namespace trochoid::force
