#include <trochoid/base/units.h>
#include <trochoid/force/any_edges.h>
#include <trochoid/force/axial.h>
#include <trochoid/force/edge_curve.h>
#include <trochoid/force/forces.h>
#include <trochoid/force/node_force.h>
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
std::vector<double> close_grid(const Edges& edges, int parts_at_tip) {
  constexpr int parts = 60;
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

using Six = std::array<double, 6>;

/// F-4, F-6 and F-7 by the chip alone, its changes found by looking closely.
/// @param length  of the cutter, from the tip to the section that bends [m]
Six plain_loads(const Edges& edges, double phi, double length, int parts_at_tip) {
  EdgeCurve curve(edges);
  numerics::PieceFinder<EdgeCurve> finder(curve, 1e-13 * edges.ends.back());
  std::vector<numerics::Piece<EdgeState>> pieces;
  Six sum{};
  const auto add = [&](double s, double weight, Six& out) {
    const EdgePoint p = edges.point(s);
    const EdgeState state = curve.state(p);
    const double h = state.chip.h * p.meridian.sin_kappa;
    const double t = weight * (K.K_tc * h + K.K_te * p.dS);
    const double r = weight * (K.K_rc * h + K.K_re * p.dS);
    const double a = weight * (K.K_ac * h + K.K_ae * p.dS);
    const double inward = r * p.meridian.sin_kappa + a * p.meridian.cos_kappa;
    const Vector3 F{-t * std::cos(state.theta) - inward * std::sin(state.theta),
                    t * std::sin(state.theta) - inward * std::cos(state.theta),
                    r * p.meridian.cos_kappa - a * p.meridian.sin_kappa};
    const Vector3 at{state.R * std::sin(state.theta), state.R * std::cos(state.theta),
                     p.meridian.z - length};
    for (std::size_t k = 0; k < 3; ++k) out[k] += F[k];
    out[3] += at[1] * F[0] - at[0] * F[1];  // the spindle drives against this
    out[4] += at[1] * F[2] - at[2] * F[1];
    out[5] += at[2] * F[0] - at[0] * F[2];
  };
  const double allowed = 1e-11 * edges.ends.back() * K.K_te;
  for (std::size_t j = 0; j < edges.psi.size(); ++j) {
    curve.stand_at(phi, j);
    std::vector<double> grid = close_grid(edges, parts_at_tip);
    curve.add_seeds(grid);
    finder.find(grid, pieces);
    for (const auto& piece : pieces) {
      double from = piece.from;
      for (const double end : edges.ends) {
        const double to = std::min(end, piece.to);
        if (to > from) {
          numerics::add_integral(
              from, to, add, Six{allowed, allowed, allowed, allowed, allowed, allowed},
              1e-9 * edges.ends.back(), sum);
          from = to;
        }
      }
    }
  }
  return sum;
}

Vector3 plain_force(const Edges& edges, double phi, int parts_at_tip = 400) {
  const Six all = plain_loads(edges, phi, 0.0, parts_at_tip);
  return {all[0], all[1], all[2]};
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

/// The same under a power of the chip, against a quadrature of it.
TEST(Nodes, GiveAPowerOfTheChip) {  // [F-2] [F-15]
  Random random(12);
  for (int n = 0; n < 200; ++n) {
    const Cut cut = random_cut(random);
    const PowerEdge both{900e6,
                         400e6,
                         150e6,
                         between(random, -0.5, 0.9),
                         between(random, -0.5, 0.9),
                         between(random, -0.5, 0.9),
                         7e3,
                         3e3,
                         1e3};
    const Law law = n % 2 == 0
                        ? Law(both)
                        : Law(Power{900e6, 400e6, 150e6, both.m_t, both.m_r, both.m_a});
    const auto nodes = NodeForce::make(cut, law, 1e-6);
    if (!nodes) {
      continue;
    }
    std::vector<double> phi;
    for (int i = 0; i < 12; ++i) phi.push_back(between(random, 0, 2 * pi));
    std::vector<Vector3> F(phi.size());
    std::vector<SixLoads> all(phi.size());
    std::vector<std::array<double, 18>> C(phi.size());
    nodes->forces(phi, F);
    nodes->loads(phi, 0.03, all);
    nodes->matrices(phi, C);
    const std::vector<double> k = coefficients(law);
    const AxialForce quadrature(cut, law, 1e-10);
    double peak = both.K_te * 1e-2 * cut.cut.a_p;
    std::vector<SixLoads> expected;
    for (const double angle : phi) {
      expected.push_back(quadrature.loads(angle, 0.03));
      peak = std::max(
          peak, size({expected.back()[0], expected.back()[1], expected.back()[2]}));
    }
    const double arm = std::max({cut.cutter.profile.D / 2, 0.03, cut.cut.a_p});
    for (std::size_t i = 0; i < phi.size(); ++i) {
      for (std::size_t q = 0; q < 6; ++q) {
        EXPECT_NEAR(all[i][q], expected[i][q], 1e-7 * peak * (q < 3 ? 1.0 : arm))
            << n << " at " << phi[i] << ", load " << q;
      }
      for (std::size_t row = 0; row < 3; ++row) {
        double sum = 0.0;
        for (std::size_t q = 0; q < k.size(); ++q)
          sum += C[i][row * k.size() + q] * k[q];
        EXPECT_NEAR(F[i][row], all[i][row], 1e-9 * peak) << n;
        EXPECT_NEAR(sum, all[i][row], 1e-9 * peak) << n;
      }
    }
  }
}

/// Each tooth has an edge of its own: by a list of helices, a serration, axial offsets or a
/// tilt, of any shape with a radius at its tip.
Cut random_any_cut(Random& random) {
  Cut cut = random_cut(random);
  const std::size_t teeth = cut.cutter.pitch.size();
  cut.cut.a_p = std::min(cut.cut.a_p, 8e-3);
  if (one_of(random, 3) == 0) {
    cut.cutter.helix = between(random, 5, 40) * unit::deg;
    for (std::size_t j = 0; j < teeth; ++j) {
      cut.cutter.helices.push_back(cut.cutter.helix +
                                   between(random, -3, 3) * unit::deg);
    }
  } else if (one_of(random, 3) == 0) {
    cut.cutter.helix = -between(random, 1, 30) * unit::deg;
  }
  if (one_of(random, 3) == 0) {
    cut.cutter.serration =
        geometry::Serration{.amplitude = between(random, 0.01e-3, 0.3e-3),
                            .wavelength = between(random, 1e-3, 4e-3),
                            .shift = {}};
  }
  constexpr std::array<double, 4> offsets = {0.0, 1e-9, 5e-6, 50e-6};
  const double axial = offsets[static_cast<std::size_t>(one_of(random, 4))];
  for (std::size_t j = 0; j < teeth; ++j) {
    cut.runout.axial_offsets.push_back(axial * between(random, -1, 1));
  }
  if (one_of(random, 3) == 0) {
    cut.runout.tilt = between(random, 0, 0.1) * unit::deg;
    cut.runout.tilt_angle = between(random, -pi, pi);
  }
  return cut;
}

/// F-4 of edges that differ under the linear law, by many slices that are thin at the tip:
/// good to 1e-3.
Vector3 sliced_force(const Cut& cut, double phi) {
  constexpr int slices = 40000;
  const AnyEdges any(cut);
  chip::TeethAtHeight teeth(any.edges, any.passage);
  const double low = any.zones.front().from;
  const double height = cut.cut.a_p - low;
  Vector3 F{};
  for (int k = 0; k < slices; ++k) {
    const double u = (k + 0.5) / slices;
    const double dz = height * 2 * u / slices;
    teeth.stand_at(low + height * u * u);
    for (std::size_t j = 0; j < teeth.teeth(); ++j) {
      if (!teeth.there(j)) continue;
      const geometry::EdgeAt& at = teeth.edge(j);
      const chip::Chip chip = teeth.chip(j, phi - at.omega);
      if (!chip.in_cut) continue;
      const double e = cut.edge_length == EdgeLength::axial ? 1.0 : at.dS_dz;
      const double t = (K.K_tc * chip.h + K.K_te * e) * dz;
      const double r = (K.K_rc * chip.h + K.K_re * e) * dz;
      const double a = (K.K_ac * chip.h + K.K_ae * e) * dz;
      const double inward = r * at.sin_kappa + a * at.cos_kappa;
      const double theta = phi - at.omega + at.position.epsilon;
      F[0] += -t * std::cos(theta) - inward * std::sin(theta);
      F[1] += t * std::sin(theta) - inward * std::cos(theta);
      F[2] += r * at.cos_kappa - a * at.sin_kappa;
    }
  }
  return F;
}

double apart(const SixLoads& a, const Vector3& b) {
  return size({a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

/// Chips at nodes of edges that differ, against their quadrature: all loads and [C], under
/// any law. The quadrature overlooks cuts shorter than its first look: slices tell.
TEST(Nodes, GiveTheForcesOfEdgesThatDiffer) {  // [F-15] [F-30]
  Random random(31);
  int close = 0;
  int cases = 0;
  for (int n = 0; n < 200; ++n) {
    const Cut cut = random_any_cut(random);
    const Law law =
        n % 2 == 0 ? Law(K)
                   : Law(PowerEdge{900e6, 400e6, 150e6, 0.25, 0.4, 0.1, 7e3, 3e3, 1e3});
    const auto nodes = NodeForce::make(AnyEdges(cut), law, 1e-6);
    if (!nodes) continue;
    ++cases;
    std::vector<double> phi;
    for (int i = 0; i < 8; ++i) phi.push_back(between(random, 0, 2 * pi));
    std::vector<SixLoads> all(phi.size());
    std::vector<SixLoads> expected(phi.size());
    std::vector<std::array<double, 18>> C(phi.size());
    nodes->loads(phi, 0.03, all);
    nodes->matrices(phi, C);
    AnyForce(cut, law, 1e-8).loads(phi, 0.03, expected);
    const std::vector<double> k = coefficients(law);
    double peak = K.K_te * 1e-2 * cut.cut.a_p;
    double most = 0.0;
    for (std::size_t i = 0; i < phi.size(); ++i) {
      peak = std::max(peak, size({expected[i][0], expected[i][1], expected[i][2]}));
      double error = 0.0;
      for (std::size_t q = 0; q < 6; ++q) {
        error =
            std::max(error, std::abs(all[i][q] - expected[i][q]) / (q < 3 ? 1 : 0.03));
      }
      most = std::max(most, error);
      if (error > 1e-3 * peak && n % 2 == 0) {
        const Vector3 sliced = sliced_force(cut, phi[i]);
        EXPECT_LT(apart(all[i], sliced), 0.05 * apart(expected[i], sliced)) << n;
      }
      for (std::size_t row = 0; row < 3; ++row) {
        double sum = 0.0;
        for (std::size_t q = 0; q < k.size(); ++q)
          sum += C[i][row * k.size() + q] * k[q];
        EXPECT_NEAR(sum, all[i][row], 1e-9 * peak) << n;
      }
    }
    close += most <= 1e-6 * peak ? 1 : 0;
  }
  EXPECT_GE(cases, 195);
  EXPECT_GE(close, 0.98 * cases);
}

/// A ball or a sharp cone, whose edges begin at the axis.
Cut random_tip(Random& random) {
  Cut cut = random_cut(random);
  const double D = cut.cutter.profile.D;
  if (one_of(random, 2) == 0) {
    cut.cutter.profile = geometry::ball(D);
    cut.cut.a_p = between(random, 0.02, 0.8) * D;
  } else {
    const double alpha = between(random, 3, 60) * unit::deg;
    const double height = 0.5 * D * std::tan(alpha);
    cut.cutter.profile = {.D = D, .Rr = D / 2, .Rz = height, .alpha = alpha};
    cut.cut.a_p = between(random, 0.02, 1.2) * height;
  }
  cut.chip.model = chip::Model::trochoidal;
  return cut;
}

/// The part next to the axis is left to the quadrature, which looks closely there.
TEST(Nodes, OfEdgesThatDifferNearTheAxisAreThoseOfSlices) {  // [F-15] [F-30]
  Random random(37);
  constexpr int cases = 60;
  int close = 0;
  for (int n = 0; n < cases; ++n) {
    Cut cut = random_tip(random);
    cut.runout.eccentricity = 0.0;
    for (std::size_t j = 0; j < cut.cutter.pitch.size(); ++j) {
      cut.runout.axial_offsets.push_back(between(random, -5e-6, 5e-6));
    }
    std::vector<double> phi;
    for (int i = 0; i < 3; ++i) phi.push_back(2 * pi * (i + 0.3) / 3);
    const auto F = forces(cut, K, phi, 1e-6);
    double peak = 1e-6;
    double error = 0.0;
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const Vector3 sliced = sliced_force(cut, phi[i]);
      peak = std::max(peak, size(sliced));
      error = std::max(
          error, size({F[i][0] - sliced[0], F[i][1] - sliced[1], F[i][2] - sliced[2]}));
    }
    close += error <= 1e-3 * peak ? 1 : 0;
  }
  EXPECT_GE(close, 0.95 * cases);
}

/// Within a feed of the axis an eccentricity makes teeth pass one another and marks end:
/// a cut that is shorter than the grid there may be overlooked.
TEST(Nodes, AtTheAxisMeetAGradedReference) {  // [F-15]
  Random random(21);
  constexpr int cases = 200;
  int close = 0;
  for (int n = 0; n < cases; ++n) {
    const Cut cut = random_tip(random);
    const Edges edges(cut);
    std::vector<double> phi;
    for (int i = 0; i < 5; ++i) phi.push_back(2 * pi * (i + 0.3) / 5);
    const auto F = forces(cut, K, phi, 1e-6);
    double peak = 1e-6;
    double error = 0.0;
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const Vector3 expected = plain_force(edges, phi[i], 1600);
      peak = std::max(peak, size(expected));
      error = std::max(error, size({F[i][0] - expected[0], F[i][1] - expected[1],
                                    F[i][2] - expected[2]}));
    }
    EXPECT_LE(error, 1e-4 * peak) << n;
    close += error <= 1e-7 * peak ? 1 : 0;
  }
  EXPECT_GE(close, 0.95 * cases);
}

/// Panels near the axis against the quadrature along the edge: all loads, and any law. Where
/// the edge of the stock is near, the quadrature is what is compared with itself.
TEST(Nodes, NearTheAxisAreThatOfTheQuadrature) {  // [F-4] [F-6] [F-7]
  Random random(23);
  int close = 0;
  int cases = 0;
  for (int n = 0; n < 60; ++n) {
    const Cut cut = random_tip(random);
    const Law law =
        n % 2 == 0 ? Law(K)
                   : Law(PowerEdge{900e6, 400e6, 150e6, 0.25, 0.4, 0.1, 7e3, 3e3, 1e3});
    const auto nodes = NodeForce::make(cut, law, 1e-6);
    if (!nodes) continue;
    ++cases;
    std::vector<double> phi;
    for (int i = 0; i < 5; ++i) phi.push_back(2 * pi * (i + 0.3) / 5);
    std::vector<SixLoads> all(phi.size());
    std::vector<std::array<double, 18>> C(phi.size());
    nodes->loads(phi, 0.03, all);
    nodes->matrices(phi, C);
    const AxialForce quadrature(cut, law, 1e-8);
    const std::vector<double> k = coefficients(law);
    double peak = 1e-6;
    double error = 0.0;
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const SixLoads expected = quadrature.loads(phi[i], 0.03);
      peak = std::max(peak, size({expected[0], expected[1], expected[2]}));
      for (std::size_t q = 0; q < 6; ++q) {
        error = std::max(error, std::abs(all[i][q] - expected[q]) / (q < 3 ? 1 : 0.03));
      }
      for (std::size_t row = 0; row < 3; ++row) {
        double sum = 0.0;
        for (std::size_t q = 0; q < k.size(); ++q)
          sum += C[i][row * k.size() + q] * k[q];
        EXPECT_NEAR(sum, all[i][row], 1e-7 * peak) << n;
      }
    }
    EXPECT_LE(error, 1e-4 * peak) << n;
    close += error <= 1e-6 * peak ? 1 : 0;
  }
  EXPECT_GE(cases, 40);
  EXPECT_GE(close, 0.95 * cases);
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

TEST(Nodes, GiveTorqueAndBendingOfTheChipAlone) {  // [F-6] [F-7] [F-15]
  Random random(10);
  for (int n = 0; n < 1000; ++n) {
    const Cut cut = random_cut(random);
    const double length = between(random, 0, 80e-3);
    const double arm = std::max({cut.cutter.profile.D / 2, length, cut.cut.a_p});
    std::vector<double> phi;
    for (int i = 0; i < 10; ++i) phi.push_back(2 * pi * (i + 0.3) / 10);
    const auto all = loads(cut, K, phi, length, 1e-8);
    double peak = K.K_te * 1e-2 * cut.cut.a_p;
    for (const Loads& load : all) peak = std::max(peak, size(load.force));
    const Edges edges(cut);
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const Six expected = plain_loads(edges, phi[i], length, 400);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(all[i].force[k], expected[k], 2e-8 * peak) << n << " at " << phi[i];
      }
      EXPECT_NEAR(all[i].torque, -expected[3], 2e-8 * peak * arm) << n;
      EXPECT_NEAR(all[i].bending, std::hypot(expected[4], expected[5]),
                  2e-8 * peak * arm)
          << n;
    }
  }
}

}  // namespace
}  // namespace trochoid::force
