#include <trochoid/geometry/tooth_edges.h>

#include <trochoid/base/units.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::geometry::tooth_edges_test {

constexpr double mm = 1e-3;
constexpr double um = 1e-6;

Cutter four_teeth(const Profile& profile, double helix_deg = 35) {
  return {.profile = profile,
          .pitch = equal_pitch(4),
          .helix = helix_deg * unit::deg,
          .lag_diameter = profile.D};
}

TEST(ToothEdges, OfAlikeTeethAreThoseOfTheClosedForms) {  // [G-20] [G-22]
  const Runout runout{.radial_offsets = {0.0, 5 * um, -3 * um, 2 * um},
                      .eccentricity = 4 * um,
                      .angle = 0.7};
  for (const Profile& p : {cylinder(10 * mm), ball(10 * mm), bull_nose(12 * mm, 2 * mm),
                           taper(6 * mm, 5 * unit::deg, 0.5 * mm)}) {
    for (const LagLaw law : {LagLaw::constant_lead, LagLaw::constant_helix}) {
      Cutter c = four_teeth(p);
      c.lag_law = law;
      EXPECT_TRUE(edges_alike(c, runout));
      const ToothEdges edges(c, runout);
      const Meridian m = meridian(p);
      const std::vector<double> psi = tooth_angles(c);
      std::vector<EdgePosition> teeth(4);
      for (const double z : {0.05 * mm, 0.4 * mm, 1.9 * mm, 4.5 * mm}) {
        const double s = arc_length_at(m, z);
        const MeridianPoint point = point_at(m, s);
        const Lag lag = lag_at(c, m, s);
        edge_positions(runout, psi, point.r, lag.angle, teeth);
        for (std::size_t j = 0; j < 4; ++j) {
          const EdgeAt at = edges.edge_at(j, z);
          EXPECT_TRUE(at.there);
          EXPECT_NEAR(at.r, point.r, 1e-15);
          EXPECT_NEAR(at.omega, psi[j] + lag.angle, 1e-12);
          EXPECT_NEAR(at.sin_kappa, point.sin_kappa, 1e-12);
          EXPECT_NEAR(at.cos_kappa, point.cos_kappa, 1e-12);
          EXPECT_NEAR(at.dS_dz, edge_length_factor(point, lag) / point.sin_kappa,
                      1e-10);
          EXPECT_NEAR(at.position.R, teeth[j].R, 1e-15);
          EXPECT_NEAR(at.position.epsilon, teeth[j].epsilon, 1e-13);
        }
      }
    }
  }
}

TEST(ToothEdges, AreToldFromAlikeTeethByEachKey) {
  const Cutter plain = four_teeth(cylinder(10 * mm));
  EXPECT_TRUE(edges_alike(plain, {}));
  Cutter c = plain;
  c.helices = {c.helix, c.helix, c.helix, c.helix};
  EXPECT_TRUE(edges_alike(c, {}));
  c.helices[2] += 0.01;
  EXPECT_FALSE(edges_alike(c, {}));
  c = plain;
  c.helix = -0.1;
  EXPECT_FALSE(edges_alike(c, {}));
  c = plain;
  c.serration = Serration{.amplitude = 0.2 * mm, .wavelength = 2 * mm, .shift = {}};
  EXPECT_FALSE(edges_alike(c, {}));
  EXPECT_FALSE(edges_alike(plain, {.axial_offsets = {0.0, 0.0, 1 * um, 0.0}}));
  EXPECT_FALSE(edges_alike(plain, {.tilt = 1e-4}));
}

TEST(ToothEdges, ASerrationHasCrestsWhereItIsShifted) {  // [G-20]
  Cutter c = four_teeth(cylinder(10 * mm), 0.0);
  c.serration = Serration{.amplitude = 0.4 * mm, .wavelength = 2 * mm, .shift = {}};
  const ToothEdges edges(c, {});
  for (std::size_t j = 0; j < 4; ++j) {
    const double crest = 0.5 * mm * static_cast<double>(j);
    EXPECT_NEAR(edges.edge_at(j, crest).r, 5 * mm, 1e-15);
    EXPECT_NEAR(edges.edge_at(j, crest + 1 * mm).r, 4.6 * mm, 1e-15);
    // Below a crest the radius grows upwards: the edge leans as a taper does.
    const EdgeAt rising = edges.edge_at(j, crest + 1.5 * mm);
    const double slope = 0.2 * mm * std::numbers::pi / mm;
    EXPECT_NEAR(rising.cos_kappa / rising.sin_kappa, slope, 1e-12);
    EXPECT_LT(edges.edge_at(j, crest + 0.5 * mm).cos_kappa, 0.0);
  }
}

TEST(ToothEdges, AnAxialOffsetOnATaperIsARadialOneTimesTheTangent) {  // [G-21]
  const double beta = 30 * unit::deg;
  const Cutter c = four_teeth(taper(50 * mm, beta), 0.0);
  const Runout axial{.axial_offsets = {0.0, 20 * um, -15 * um, 4 * um}};
  Runout radial{.radial_offsets = {}};
  for (const double a : axial.axial_offsets) {
    radial.radial_offsets.push_back(a * std::tan(beta));
  }
  const ToothEdges one(c, axial);
  const ToothEdges other(c, radial);
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_NEAR(one.edge_at(j, 2 * mm).position.R, other.edge_at(j, 2 * mm).position.R,
                1e-15);
    EXPECT_NEAR(one.lowest_height(j), -axial.axial_offsets[j], 1e-18);
  }
}

TEST(ToothEdges, ATiltIsAnEccentricityThatGrowsWithTheHeight) {  // [G-23]
  const Cutter c = four_teeth(cylinder(20 * mm), 0.0);
  const double tilt = 0.02 * unit::deg;
  const double mu = 1.1;
  const ToothEdges leaning(c, {.tilt = tilt, .tilt_angle = mu});
  for (const double z : {1 * mm, 12 * mm, 30 * mm}) {
    const ToothEdges beside(c, {.eccentricity = z * std::tan(tilt), .angle = mu});
    for (std::size_t j = 0; j < 4; ++j) {
      const EdgeAt a = leaning.edge_at(j, z);
      const EdgeAt b = beside.edge_at(j, z);
      EXPECT_NEAR(a.position.R, b.position.R, 1e-15);
      EXPECT_NEAR(a.position.epsilon, b.position.epsilon, 1e-13);
    }
  }
}

TEST(ToothEdges, ATiltedBallStaysASphere) {  // [G-21] [G-23]
  const double R = 5 * mm;
  const Cutter c = four_teeth(ball(2 * R), 30);
  const double tilt = 0.03 * unit::deg;
  const double mu = 0.4;
  const ToothEdges edges(c, {.tilt = tilt, .tilt_angle = mu});
  // Its centre is moved sideways by R tan(tilt).
  const double moved = R * std::tan(tilt);
  for (const double z : {0.1 * mm, 1 * mm, 3 * mm}) {
    for (std::size_t j = 0; j < 4; ++j) {
      const EdgeAt at = edges.edge_at(j, z);
      const double angle = at.omega - at.position.epsilon;
      const double x = at.position.R * std::cos(angle) - moved * std::cos(mu);
      const double y = at.position.R * std::sin(angle) - moved * std::sin(mu);
      EXPECT_NEAR(std::hypot(x, y, z - R), R, 2e-9);
    }
  }
}

TEST(ToothEdges, BeginWhereTheirOwnHeightIsZero) {  // [G-21]
  for (const Profile& p : {cylinder(80 * mm), bull_nose(80 * mm, 2 * mm),
                           taper(80 * mm, 45 * unit::deg)}) {
    const Cutter c = four_teeth(p, 5);
    const ToothEdges edges(c, {.axial_offsets = {0.0, -30 * um, 12 * um, -4 * um},
                               .tilt = 0.015 * unit::deg,
                               .tilt_angle = 0.9});
    for (std::size_t j = 0; j < 4; ++j) {
      const double lowest = edges.lowest_height(j);
      EXPECT_NEAR(edges.edge_at(j, lowest).own_height, 0.0, 1e-13);
      EXPECT_TRUE(edges.edge_at(j, lowest + 1e-9).there);
      EXPECT_FALSE(edges.edge_at(j, lowest - 1e-9).there);
    }
    const std::vector<double> breaks = edges.breaks(5 * mm);
    EXPECT_EQ(breaks.back(), 5 * mm);
    EXPECT_TRUE(std::is_sorted(breaks.begin(), breaks.end()));
  }
}

TEST(ToothEdges, TheirLengthIsThatOfTheCurveInSpace) {  // [G-22]
  Cutter c = four_teeth(taper(20 * mm, 10 * unit::deg), 40);
  c.serration = Serration{.amplitude = 0.3 * mm, .wavelength = 2 * mm, .shift = {}};
  const ToothEdges edges(c, {.axial_offsets = {0.0, 10 * um, -20 * um, 5 * um}});
  const double step = 1e-8;
  for (std::size_t j = 0; j < 4; ++j) {
    for (const double z : {0.5 * mm, 1.7 * mm, 3.3 * mm}) {
      const EdgeAt a = edges.edge_at(j, z - step);
      const EdgeAt b = edges.edge_at(j, z + step);
      const double length =
          std::hypot(b.r * std::cos(b.omega) - a.r * std::cos(a.omega),
                     b.r * std::sin(b.omega) - a.r * std::sin(a.omega), 2 * step);
      EXPECT_NEAR(edges.edge_at(j, z).dS_dz, length / (2 * step), 1e-6);
    }
  }
}

}  // namespace trochoid::geometry::tooth_edges_test
