#include "made_wall.h"

#include <trochoid/force/forces.h>
#include <trochoid/surface/edge_nodes.h>

#include <gtest/gtest.h>

namespace trochoid::surface::edge_moments_test {

constexpr int points = 16;

/// The values of one coefficient at an angle: the moments, F_x, F_y.
std::vector<double> values_at(const EdgeMoments& edges, double phi) {
  std::vector<double> out(columns * edges.values());
  edges.at(phi, nullptr, out);
  return out;
}

std::vector<MadeCut> all_kinds() {
  std::vector<MadeCut> cuts = {made_cut(true), made_cut(false)};
  cuts.push_back(with_runout(made_cut(true, 4, 20.0), 15e-6, 1.1));
  cuts.push_back(made_cut(false, 2, 0.0));
  cuts.back().runout.radial_offsets = {0.0, 250e-6};  // tooth 1 cuts nothing
  cuts.push_back(made_cut(true, 2, 60.0));
  cuts.back().cut.a_p = 25e-3;  // more than an axial pitch
  cuts.back().cut.engagement = geometry::DownMilling{8e-3};
  cuts.push_back(with_runout(made_cut(), 15e-6, 1.1));
  cuts.back().chip.model = chip::Model::trochoidal;
  cuts.push_back(made_cut());
  cuts.back().cutter.pitch = {1.9, 2.2, 2 * pi - 4.1};
  return cuts;
}

TEST(EdgeMoments, FxAndFyAreThoseOfTheRoomForce) {  // [E-2]
  const force::Law K = law(800e6, 300e6, 9e3, 4e3);
  const auto four = wall_coefficients(K);
  for (const MadeCut& s : all_kinds()) {
    const EdgeMoments edges(s, K, {0.0, s.cut.a_p, points});
    const auto phi = angles(61);
    const auto F = force::forces(s, K, phi, 1e-10);
    double largest = 0.0;
    for (const auto& f : F) largest = std::max(largest, std::hypot(f[0], f[1]));
    ASSERT_GT(largest, 1.0);
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const auto v = values_at(edges, phi[i]);
      double Fx = 0.0;
      double Fy = 0.0;
      for (std::size_t c = 0; c < columns; ++c) {
        Fx += four[c] * v[c * edges.values() + points];
        Fy += four[c] * v[c * edges.values() + points + 1];
      }
      EXPECT_NEAR(Fx, F[i][0], 1e-8 * largest);
      EXPECT_NEAR(Fy, F[i][1], 1e-8 * largest);
    }
  }
}

TEST(EdgeMoments, AtNodesAreThoseOfTheQuadrature) {  // [E-2] [E-3]
  std::vector<MadeCut> cuts = all_kinds();
  cuts.push_back(with_runout(made_cut(false), 15e-6, 1.1));
  cuts.back().chip.model = chip::Model::trochoidal;
  for (const MadeCut& s : cuts) {
    const EdgeMoments edges(s, law(0, 0, 1, 1), {0.0, s.cut.a_p, points});
    force::Bend none;  // a bend sends it along the quadrature
    none.shift = [](double) { return 0.0; };
    none.deflected = false;
    std::vector<double> there(columns * edges.values());
    std::array<double, columns> largest{};
    std::array<double, columns> off{};
    for (const double phi : angles(111)) {
      const auto here = values_at(edges, phi);
      edges.at(phi, &none, there);
      for (std::size_t k = 0; k < here.size(); ++k) {
        const std::size_t c = k / edges.values();
        largest[c] = std::max(largest[c], std::abs(there[k]));
        off[c] = std::max(off[c], std::abs(here[k] - there[k]));
      }
    }
    for (std::size_t c = 0; c < columns; ++c) {
      ASSERT_GT(largest[c], 0.0);
      EXPECT_LT(off[c], 1e-7 * largest[c]);
    }
  }
}

TEST(EdgeMoments, OfABentCutterAtNodesAreThoseOfTheQuadrature) {  // [E-10]
  for (const auto model : {chip::Model::radial, chip::Model::trochoidal}) {
    for (const bool down : {true, false}) {
      MadeCut s = with_runout(made_cut(down), 5e-6, 1.2);
      s.chip.model = model;
      const numerics::LagrangeBasis basis(0.0, s.cut.a_p, points);
      const force::Law edge = law(0, 0, 1, 1);
      const EdgeMoments edges(s, edge, basis);
      const force::Edges curves(s);
      const auto nodes = EdgeNodes::make(curves, force::form(edge), basis);
      ASSERT_TRUE(nodes);
      const auto now = [](double z) { return 40e-6 + 5e-3 * z; };
      const auto then = [](double z) { return 30e-6 + 2e-3 * z; };
      std::vector<double> shift;
      std::vector<double> before;
      for (const double z : basis.points()) shift.push_back(now(z));
      for (int k = 0; k < 9; ++k) {
        for (const double z : basis.points()) before.push_back(then(z));
      }
      const NodeBend bend{shift, before};
      force::Bend same;
      same.shift = now;
      same.advance = [&](double z, std::size_t, double theta, std::span<double> out) {
        for (double& gained : out) gained = std::cos(theta) * (now(z) - then(z));
      };
      std::vector<double> there(columns * edges.values());
      std::array<double, columns> largest{};
      std::array<double, columns> off{};
      MomentSums sums;
      for (const double phi : angles(111)) {
        nodes->at(phi, &bend, sums);
        edges.at(phi, &same, there);
        for (std::size_t c = 0; c < columns; ++c) {
          for (std::size_t q = 0; q < points; ++q) {
            const double m = there[c * edges.values() + q];
            largest[c] = std::max(largest[c], std::abs(m));
            off[c] = std::max(off[c], std::abs(sums.across[c][q] - m));
          }
        }
      }
      for (std::size_t c = 0; c < columns; ++c) {
        EXPECT_LT(off[c], 1e-5 * largest[c]) << c << static_cast<int>(model) << down;
      }
    }
  }
}

TEST(EdgeMoments, OfAPowerLawAreThoseOfTheRoomForceToo) {  // [E-2]
  const force::Law K = force::Power{900e6, 400e6, 150e6, 0.25, 0.4, 0.1};
  const auto four = wall_coefficients(K);
  EXPECT_EQ(four[2], 0.0);
  EXPECT_EQ(four[3], 0.0);
  const MadeCut s = with_runout(made_cut(), 15e-6, 1.1);
  const EdgeMoments edges(s, K, {0.0, s.cut.a_p, points});
  const auto phi = angles(31);
  const auto F = force::forces(s, K, phi, 1e-10);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    const auto v = values_at(edges, phi[i]);
    const std::size_t y = points + 1;
    EXPECT_NEAR(four[0] * v[y] + four[1] * v[edges.values() + y], F[i][1],
                2e-3);  // of 160 N: the chip ends as a root
  }
}

TEST(EdgeMoments, AThinToothAtOneAnglePullsByHand) {  // [E-2]
  MadeCut s = made_cut(true, 1, 0.0);
  s.cut.a_p = 1e-3;
  const EdgeMoments edges(s, law(0, 0), {0.0, 1e-3, 3});
  const double theta = 165 * unit::deg;
  const auto v = values_at(edges, theta);
  const double width = 0.2e-3 * std::sin(theta) * 1e-3;       // h a_p
  EXPECT_NEAR(v[4], width * std::sin(theta), 1e-18);          // K_tc
  EXPECT_NEAR(v[5 + 4], -width * std::cos(theta), 1e-18);     // K_rc
  EXPECT_NEAR(v[2 * 5 + 4], 1e-3 * std::sin(theta), 1e-15);   // K_te
  EXPECT_NEAR(v[3 * 5 + 4], -1e-3 * std::cos(theta), 1e-15);  // K_re
  EXPECT_NEAR(v[3], -width * std::cos(theta), 1e-18);
  EXPECT_NEAR(v[5 + 3], -width * std::sin(theta), 1e-18);
}

TEST(EdgeMoments, AddUpToTheForceAcrossTheWall) {  // [E-3]
  for (const MadeCut& s : all_kinds()) {
    const EdgeMoments edges(s, law(0, 0), {0.0, s.cut.a_p, points});
    for (const double phi : angles(23)) {
      const auto v = values_at(edges, phi);
      for (std::size_t c = 0; c < columns; ++c) {
        const double* row = v.data() + c * edges.values();
        double sum = 0.0;
        double size = 0.0;
        for (int q = 0; q < points; ++q) {
          sum += row[q];
          size += std::abs(row[q]);
        }
        EXPECT_NEAR(sum, row[points + 1], 1e-12 * size);
      }
    }
  }
}

TEST(EdgeMoments, GiveTheMomentOfAnyPolynomial) {  // [E-3]
  const Coefficients K = {800e6, 300e6, 9e3, 4e3};
  for (const bool down : {true, false}) {
    const MadeCut s = made_cut(down);
    const EdgeMoments edges(s, law(0, 0), {0.0, s.cut.a_p, points});
    for (const double phi : angles(40)) {
      const auto v = values_at(edges, phi);
      for (const int power : {0, 1, 3, 7}) {
        const auto weight = [&](double z) { return std::pow(z / 3e-3, power); };
        double sum = 0.0;
        for (std::size_t c = 0; c < columns; ++c) {
          for (std::size_t q = 0; q < points; ++q) {
            sum += K[c] * v[c * edges.values() + q] * weight(edges.basis().points()[q]);
          }
        }
        EXPECT_NEAR(sum, weighted_force(s, K, phi, weight), 1e-6) << phi;  // of 200 N
      }
    }
  }
}

TEST(EdgeMoments, ANeedleInTheMiddleOfTheEdgeIsNotMissed) {  // [E-3]
  // only a few degrees in the stock: at most angles a short stretch of a long edge
  MadeCut s = made_cut(true, 1, 55.0);
  s.cut.a_p = 20e-3;
  s.cut.engagement = geometry::DownMilling{2e-6};
  const EdgeMoments edges(s, law(0, 0), {0.0, s.cut.a_p, points});
  const Coefficients K = {800e6, 300e6, 0.0, 0.0};
  for (const double phi : angles(100)) {
    const auto v = values_at(edges, phi);
    const double F = K[0] * v[points + 1] + K[1] * v[edges.values() + points + 1];
    EXPECT_NEAR(F, weighted_force(s, K, phi, [](double) { return 1.0; }), 1e-8);
  }
}

TEST(EdgeMoments, UpMillingIsDownMillingInTheMirror) {  // [E-2] [E-3]
  // y -> -y turns theta to pi - theta, the edge upside down, and the sense of F_r
  const MadeCut down = made_cut(true, 1);
  const MadeCut up = made_cut(false, 1);
  const EdgeMoments a(down, law(0, 0), {0.0, 3e-3, points});
  const EdgeMoments b(up, law(0, 0), {0.0, 3e-3, points});
  const double lag = 0.5;  // of 45 deg over 3 mm
  for (const double phi : angles(50)) {
    const auto u = values_at(a, phi);
    const auto v = values_at(b, pi - phi + lag);
    for (std::size_t c = 0; c < columns; ++c) {
      const double sign = c % 2 == 0 ? 1.0 : -1.0;
      for (std::size_t q = 0; q < points; ++q) {
        EXPECT_NEAR(v[c * a.values() + q], sign * u[c * a.values() + points - 1 - q],
                    c < 2 ? 1e-16 : 1e-12);
      }
    }
  }
}

TEST(EdgeMoments, KinksAreWhereTheTipOrTheTopEntersOrLeaves) {  // [E-3]
  const MadeCut s = made_cut(true, 2);
  const EdgeMoments edges(s, law(0, 0), {0.0, 3e-3, points});
  const auto [first, last] = arc(s);
  std::vector<double> expected;
  for (const double lag : {0.0, 0.5}) {
    for (const double psi : {0.0, pi}) {
      expected.push_back(first + lag + psi);
      expected.push_back(last + lag + psi);
    }
  }
  const auto kinks = edges.kinks(false);
  for (const double want : expected) {
    const bool found = std::any_of(kinks.begin(), kinks.end(), [&](double kink) {
      return std::abs(std::remainder(kink - want, 2 * pi)) < 1e-9;
    });
    EXPECT_TRUE(found) << want;
  }
}

TEST(EdgeMoments, EqualTeethAreThoseWithoutRunoutAndWithEqualPitch) {
  const auto equal = [](const MadeCut& s) {
    return EdgeMoments(s, law(0, 0), {0.0, 3e-3, points}).equal_teeth();
  };
  EXPECT_TRUE(equal(made_cut()));
  EXPECT_FALSE(equal(with_runout(made_cut(), 1e-6, 0.0)));
  MadeCut s = made_cut();
  s.runout.radial_offsets = {1e-6, 1e-6, 1e-6};
  EXPECT_TRUE(equal(s));
  s.runout.radial_offsets[1] = 0.0;
  EXPECT_FALSE(equal(s));
  s = made_cut(true, 2);
  s.cutter.pitch = {3.0, 2 * pi - 3.0};
  EXPECT_FALSE(equal(s));
}

TEST(EdgeMoments, TablesOverATurnMeetTheSingleValues) {  // [E-3] [E-4]
  for (const MadeCut& s : all_kinds()) {
    if (s.cutter.helix == 0) continue;  // has jumps, see below
    const EdgeMoments edges(s, law(0, 0), {0.0, s.cut.a_p, points});
    const auto table = unit_moments(edges, 1e-6);
    std::vector<double> out(table.functions());
    std::array<double, columns> largest{};
    std::array<double, columns> off{};
    for (const double phi : angles(333)) {
      table.value(phi, out);
      const auto v = values_at(edges, phi);
      for (std::size_t k = 0; k < v.size(); ++k) {
        const std::size_t c = k / edges.values();
        largest[c] = std::max(largest[c], std::abs(v[k]));
        off[c] = std::max(off[c], std::abs(v[k] - out[k]));
      }
    }
    for (std::size_t c = 0; c < columns; ++c) EXPECT_LT(off[c], 1e-5 * largest[c]);
  }
}

TEST(EdgeMoments, OfAStraightToothAreTabledUpToTheirJumps) {  // [E-3]
  MadeCut s = made_cut(true, 3, 0.0);
  const EdgeMoments edges(s, law(0, 0), {0.0, s.cut.a_p, points});
  const auto table = unit_moments(edges, 1e-6);
  const double entry = arc(s)[0];
  const std::size_t y = points + 1;
  EXPECT_NEAR(value_at(table, entry - 1e-5, y), 0.0, 1e-13);
  const double sine = std::sin(entry + 1e-5);
  EXPECT_NEAR(value_at(table, entry + 1e-5, y), 0.2e-3 * 3e-3 * sine * sine, 1e-12);
}

}  // namespace trochoid::surface::edge_moments_test
