#include "made_cut.h"

#include <trochoid/force/arc_turn.h>
#include <trochoid/force/slice.h>

#include <gtest/gtest.h>

namespace trochoid::force::arc_turn_test {

using geometry::ArcLayer;
using geometry::EngagedArc;
using geometry::StockBoundary;

MadeCut lively(double helix_deg) {
  MadeCut s = slot(geometry::cylinder(10e-3), 3, helix_deg);
  s.runout.radial_offsets = {4e-6, -3e-6, -1e-6};
  return s;
}

/// The same stock as arcs: below y = -(R - a_e), bounded by one line.
geometry::Arcs down_milling(double a_e, double R, double R_e, double a_p) {
  const StockBoundary line{StockBoundary::Kind::line, pi, R - a_e};
  const double from = std::acos(-(R - a_e) / R_e);
  return {{{0.0, a_p, {{{from, 2 * pi - from}, line, line}}}}};
}

TEST(ArcTurn, ArcsBoundedByALineAreDownMilling) {  // [N-6] [N-7]
  for (const double helix : {0.0, 30.0}) {
    for (const Law& law : {Law(steel()), Law(aluminium()), Law(both())}) {
      MadeCut s = lively(helix);
      s.cut.engagement = geometry::DownMilling{1e-3};
      const auto phi = turn(90);
      const auto known = forces(s, law, phi, 1e-9);
      s.cut.engagement = down_milling(1e-3, 5e-3, 5.004e-3, s.cut.a_p);
      const auto found = forces(s, law, phi, 1e-9);
      EXPECT_LT(difference(known, found), 2e-6 * peak(known)) << helix << name_of(law);
    }
  }
}

TEST(ArcTurn, AWholeCircleIsASlot) {  // [N-7]
  MadeCut s = lively(35);
  const auto phi = turn(120);
  const auto known = forces(s, steel(), phi, 1e-9);
  const auto mean = *mean_force(s, steel(), 1e-9);
  s.cut.engagement = geometry::Arcs{{{0.0, 1.0, {{{-pi / 2, 3 * pi / 2}}}}}};
  EXPECT_LT(difference(known, forces(s, steel(), phi, 1e-9)), 1e-6 * peak(known));
  const auto found = *mean_force(s, steel(), 1e-9);
  for (std::size_t q = 0; q < 3; ++q) {
    EXPECT_NEAR(found[q], mean[q], 1e-6 * peak(known));  // [N-8]
  }
}

TEST(ArcTurn, LayersAddUp) {  // [N-7]
  MadeCut s = lively(30);
  s.cut.a_p = 6e-3;
  const auto phi = turn(60);
  s.cut.engagement = down_milling(2e-3, 5e-3, 5.004e-3, 6e-3);
  const auto whole = loads(s, steel(), phi, 40e-3, 1e-9);
  geometry::Arcs parts = down_milling(2e-3, 5e-3, 5.004e-3, 6e-3);
  const ArcLayer one = parts.layers.front();
  parts.layers.clear();
  double from = 0.0;
  for (const double to : {0.1e-3, 0.1003e-3, 2.5e-3, 6e-3}) {
    parts.layers.push_back({from, to, one.arcs});
    from = to;
  }
  s.cut.engagement = parts;
  const auto found = loads(s, steel(), phi, 40e-3, 1e-9);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    EXPECT_NEAR(found[i].force[1], whole[i].force[1], 1e-5);
    EXPECT_NEAR(found[i].torque, whole[i].torque, 1e-7);
    EXPECT_NEAR(found[i].bending, whole[i].bending, 1e-6);
  }
}

TEST(ArcTurn, TorqueAndBendingAreThoseOfTheSameCutGivenByItsDepth) {  // [N-7]
  for (const double helix : {0.0, 30.0}) {
    MadeCut s = lively(helix);
    s.cut.a_p = 8e-3;
    const auto phi = turn(40);
    s.cut.engagement = geometry::DownMilling{2e-3};
    const auto known = loads(s, steel(), phi, 30e-3, 1e-9);
    s.cut.engagement = down_milling(2e-3, 5e-3, 5.004e-3, s.cut.a_p);
    const auto found = loads(s, steel(), phi, 30e-3, 1e-9);
    for (std::size_t i = 0; i < phi.size(); ++i) {
      EXPECT_NEAR(found[i].torque, known[i].torque, 1e-4) << helix;
      EXPECT_NEAR(found[i].bending, known[i].bending, 1e-3) << helix;
    }
  }
}

TEST(ArcTurn, HardArcsOfAnyCutterAreLaidOverItsEdges) {
  MadeCut s = slot(geometry::ball(8e-3), 2, 30);
  s.runout.radial_offsets = {3e-6, -3e-6};
  const auto phi = turn(12);
  const auto known = forces(s, steel(), phi, 1e-7);
  s.cut.engagement = geometry::Arcs{{{0.0, 1.0, {{{-pi / 2, 3 * pi / 2}}}}}};
  EXPECT_LT(difference(known, forces(s, steel(), phi, 1e-7)), 1e-5 * peak(known));
  s.cut.engagement = geometry::Arcs{{{0.0, 1.0, {{{0.0, pi / 2}}}}}};
  EXPECT_GT(difference(known, forces(s, steel(), phi, 1e-7)), 0.1 * peak(known));
}

TEST(ArcTurn, TheMatrixGivesTheForces) {
  MadeCut s = lively(30);
  s.cut.engagement = down_milling(2e-3, 5e-3, 5.004e-3, s.cut.a_p);
  const auto phi = turn(10);
  const ForceMatrix matrix(s, steel(), 1e-9);
  std::vector<double> C(phi.size() * 3 * 6);
  matrix.evaluate(phi, C);
  const auto K = coefficients(steel());
  const auto F = forces(s, steel(), phi, 1e-9);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    for (std::size_t q = 0; q < 3; ++q) {
      double sum = 0.0;
      for (std::size_t c = 0; c < 6; ++c) sum += C[(3 * i + q) * 6 + c] * K[c];
      EXPECT_NEAR(sum, F[i][q], 1e-4);
    }
  }
}

/// Chip over the mark of one tooth on a circular path, from the root itself.
double exact_chip_on_circle(double R, double kappa, double f, double theta,
                            double theta_p, double R_k) {
  const auto sigma = [&](double d) { return f * (theta_p + d) / (2 * pi); };
  const auto g = [&](double d) {
    const double a = kappa * sigma(d);
    return R_k * std::sin(d) + std::sin(a) / kappa * std::cos(theta) +
           (1 - std::cos(a)) / kappa * std::sin(theta);
  };
  double lo = -pi / 2;
  double hi = pi / 2;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (lo + hi);
    (g(middle) < 0 ? lo : hi) = middle;
  }
  const double a = kappa * sigma(lo);
  return R - (R_k * std::cos(lo) - std::sin(a) / kappa * std::sin(theta) +
              (1 - std::cos(a)) / kappa * std::cos(theta));
}

TEST(ArcTurn, ChipsOnACircularPathAreTurned) {  // [N-4]
  MadeCut s = slot(geometry::cylinder(10e-3), 2, 0);
  s.runout.radial_offsets = {0.0, -8e-6};
  const double f = 2 * s.cut.f_z;
  for (const double radius : {3e-3, -3e-3, 20e-3, -8e-3}) {
    const double kappa = 1 / radius;
    s.cut.engagement = geometry::Arcs{{{0.0, 1.0, {{{-pi / 2, 3 * pi / 2}}}}}, kappa};
    const Slice slice(s, 0.0);
    for (double theta = 0.05; theta < 3.1; theta += 0.11) {
      for (const std::size_t j : {0u, 1u}) {
        const double R = j == 0 ? 5e-3 : 4.992e-3;
        const double other = j == 0 ? 4.992e-3 : 5e-3;
        const double h = std::min(exact_chip_on_circle(R, kappa, f, theta, pi, other),
                                  exact_chip_on_circle(R, kappa, f, theta, 2 * pi, R));
        EXPECT_NEAR(slice.chip_thickness(j, theta), std::max(h, 0.0), 0.01e-6)
            << radius << ' ' << theta;
      }
    }
  }
}

/// A whole circle of stock in thin layers, closer at the tip.
geometry::Arcs whole_circle(double a_p, int layers) {
  geometry::Arcs arcs;
  for (int i = 0; i < layers; ++i) {
    const double from = static_cast<double>(i) / layers;
    const double to = static_cast<double>(i + 1) / layers;
    arcs.layers.push_back(
        {a_p * from * from, a_p * to * to, {{{-pi / 2, 3 * pi / 2}}}});
  }
  return arcs;
}

SixLoads sum_of(const ArcTurn& turn, double phi, double gauge_length) {
  ToothLoads F;
  for (std::size_t j = 0; j < turn.teeth(); ++j) F += turn.at(j, phi);
  return {F.x,
          F.y,
          F.z,
          F.torque,
          F.axial_y - F.moment_y[0] + gauge_length * F.y,
          F.moment_x[0] - gauge_length * F.x - F.axial_x};
}

/// Layers with arcs of their own: bounded by lines and a circle, with a ridge between.
geometry::Arcs three_layers(double R, double a_p) {
  const StockBoundary side{StockBoundary::Kind::line, 0.3, R - 1e-4};
  geometry::Arcs out;
  out.layers = {{0.0, 0.3 * a_p, {{{0.4, 2.9}, {}, side}}},
                {0.3 * a_p, 0.5 * a_p, {{{0.9, 1.5}}, {{1.8, 3.0}}}},
                {0.5 * a_p, a_p, {{{-pi / 2, 3 * pi / 2}}}}};
  return out;
}

TEST(ArcTurn, LayersShareWhatTheStockDoesNotBound) {
  for (const double helix : {0.0, 30.0, 70.0}) {
    MadeCut s = lively(helix);
    s.cut.a_p = 20e-3;
    s.cut.engagement = three_layers(5e-3, s.cut.a_p);
    MadeCut other = s;
    other.runout.eccentricity = 1e-14;  // each part of each layer for itself
    const ArcTurn::Options options{.within = {0.0, pi}, .heights = true};
    const ArcTurn shared(s, steel(), options);
    const ArcTurn alone(other, steel(), options);
    EXPECT_NEAR(shared.peak_chip(), alone.peak_chip(), 1e-4 * alone.peak_chip());
    EXPECT_NEAR(shared.mean().y, alone.mean().y, 1e-6 * std::abs(alone.mean().y));
    for (double phi = 0.013; phi < 2 * pi; phi += 0.2) {
      const SixLoads a = sum_of(shared, phi, 40e-3);
      const SixLoads b = sum_of(alone, phi, 40e-3);
      EXPECT_NEAR(a[0], b[0], 2e-3) << helix << ' ' << phi;
      EXPECT_NEAR(a[5], b[5], 1e-4) << helix << ' ' << phi;
    }
  }
}

TEST(ArcTurn, LayersThatTouchHaveNoKinkBetweenThem) {
  for (const double helix : {0.0, 30.0}) {
    MadeCut s = lively(helix);
    s.cut.a_p = 6e-3;
    const ArcTurn::Options options{.within = {0.0, pi}};
    const auto events_of = [&](std::vector<ArcLayer> layers) {
      s.cut.engagement = geometry::Arcs{std::move(layers)};
      return ArcTurn(s, steel(), options).events();
    };
    const std::vector<EngagedArc> one{{{0.4, 2.9}}};
    const std::vector<EngagedArc> other{{{0.9, 2.0}}};
    const auto whole = events_of({{0.0, 4e-3, one}, {4e-3, 6e-3, other}});
    const auto parts = events_of({{0.0, 1e-3, one},
                                  {1e-3, 4e-3, one},
                                  {4e-3, 5e-3, other},
                                  {5e-3, 6e-3, other}});
    ASSERT_EQ(whole.size(), parts.size()) << helix;
    EXPECT_GT(whole.size(), 8u);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      EXPECT_NEAR(whole[i], parts[i], 1e-9);
    }
  }
}

TEST(ArcTurn, AtManyAnglesIsThatAtEach) {
  for (const double helix : {0.0, 30.0, -30.0, 70.0}) {
    MadeCut s = lively(helix);
    s.cut.a_p = 20e-3;
    s.cut.engagement = three_layers(5e-3, s.cut.a_p);
    const ArcTurn turn(s, steel(),
                       {.within = {-pi, 3 * pi}, .heights = true, .cones = helix < 0});
    const std::vector<double> phi = trochoid::force::turn(97);
    for (std::size_t j = 0; j < turn.teeth(); ++j) {
      const std::vector<ToothLoads> all = turn.loads_at(j, phi);
      for (std::size_t i = 0; i < phi.size(); ++i) {
        const ToothLoads one = turn.at(j, phi[i]);
        EXPECT_NEAR(all[i].x, one.x, 1e-9);
        EXPECT_NEAR(all[i].z, one.z, 1e-9);
        EXPECT_NEAR(all[i].torque, one.torque, 1e-11);
        EXPECT_NEAR(all[i].moment_x[0], one.moment_x[0], 1e-11) << helix << phi[i];
        EXPECT_NEAR(all[i].moment_y[2], one.moment_y[2], 1e-14) << helix << phi[i];
      }
    }
  }
}

TEST(ArcTurn, ConesStandForAnyEdge) {  // [N-7]
  struct Kind {
    const char* name;
    MadeCut cut;
  };
  std::vector<Kind> kinds{{"ball", slot(geometry::ball(6e-3), 2, 30)},
                          {"bull nose", slot(geometry::bull_nose(10e-3, 2e-3), 3, 20)},
                          {"taper", slot(geometry::taper(8e-3, 0.1, 1e-3), 4, 35)},
                          {"left-hand", slot(geometry::cylinder(10e-3), 3, -20)},
                          {"variable helix", slot(geometry::cylinder(10e-3), 3, 30)},
                          {"serrated", slot(geometry::cylinder(10e-3), 3, 30)}};
  kinds[4].cut.cutter.helices = {30 * unit::deg, 34 * unit::deg, 38 * unit::deg};
  kinds[5].cut.cutter.serration = geometry::Serration{
      .amplitude = 0.3e-3, .wavelength = 1.5e-3, .shift = {0.0, 0.5e-3, 1e-3}};
  for (Kind& kind : kinds) {
    MadeCut& s = kind.cut;
    s.runout.radial_offsets.assign(s.cutter.pitch.size(), 0.0);
    s.runout.radial_offsets[1] = -8e-6;
    const auto phi = turn(24);
    const auto known = six_loads(s, steel(), phi, 40e-3, 1e-6);
    s.cut.engagement = whole_circle(s.cut.a_p, 40);
    const ArcTurn cones(s, steel(),
                        {.within = {-4 * pi, 6 * pi}, .heights = true, .cones = true});
    SixLoads most{};
    SixLoads error{};
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const SixLoads found = sum_of(cones, phi[i], 40e-3);
      for (std::size_t q = 0; q < 6; ++q) {
        most[q] = std::max(most[q], std::abs(known[i][q]));
        error[q] = std::max(error[q], std::abs(found[q] - known[i][q]));
      }
    }
    const double across = std::max(most[0], most[1]);
    const double bending = std::max(most[4], most[5]);
    for (std::size_t q = 0; q < 6; ++q) {
      const double scale = q < 2 ? across : (q > 3 ? bending : most[q]);
      EXPECT_LT(error[q], 0.01 * scale) << kind.name << ' ' << q;
    }
  }
}

TEST(ArcTurn, AFallingToolTakesTheVolumeThatItFallsInto) {  // [N-18]
  // A law of h alone: the torque of a turn is K_tc times the sum of R h over the edges.
  const LinearEdge only{1e9, 0.0, 0.0, 0.0, 0.0, 0.0};
  for (const double slope : {0.0, 0.3, 1.0}) {
    MadeCut s = slot(geometry::ball(6e-3), 2, 30);
    s.cut.a_p = 1e-3;
    s.cut.f_z = 5e-6;  // a chip is then little against the radius
    s.cut.engagement = whole_circle(s.cut.a_p, 60);
    const double f = 2 * s.cut.f_z;
    const double fall = slope * f;
    const ArcTurn turn(s, only,
                       {.within = {-4 * pi, 6 * pi}, .fall = fall, .cones = true});
    // Swept by the front: width f forward, and the disc at the height of each layer.
    double volume = 0.0;
    constexpr int n = 4000;
    for (int i = 0; i < n; ++i) {
      const double z = s.cut.a_p * (i + 0.5) / n;
      const double r = std::sqrt(z * (6e-3 - z));
      const double b = fall * (3e-3 - z) / r;  // of the disc growing
      for (int k = 0; k < 720; ++k) {
        const double theta = unit::turn * (k + 0.5) / 720;
        volume += std::max(f * std::sin(theta) + b, 0.0) * r * unit::turn / 720 *
                  s.cut.a_p / n;
      }
    }
    const double work = turn.mean().torque * unit::turn;
    EXPECT_NEAR(work, 1e9 * volume, 0.02 * 1e9 * volume) << slope;
  }
}

}  // namespace trochoid::force::arc_turn_test
