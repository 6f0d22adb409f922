#include "steps.h"

#include <trochoid/base/units.h>
#include <trochoid/geometry/cut.h>
#include <trochoid/geometry/edge.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trochoid::geometry::edge_test {

constexpr double pi = std::numbers::pi;

Cutter cutter_of(const Profile& profile, LagLaw law, double helix_deg = 35) {
  return {.profile = profile,
          .pitch = equal_pitch(3),
          .helix = helix_deg * unit::deg,
          .lag_law = law,
          .lag_diameter = profile.D};
}

TEST(Edge, OfACylinderIsLongerByTheHelixAlone) {  // [G-6]
  for (const double helix : {0.0, 10.0, 30.0, 45.0, 80.0}) {
    const Cutter c = cutter_of(cylinder(8e-3), LagLaw::constant_lead, helix);
    const Meridian m = meridian(c.profile);
    for (const double s : {0.0, 1e-3, 7e-3}) {
      EXPECT_NEAR(edge_length_factor(point_at(m, s), lag_at(c, m, s)),
                  1 / std::cos(helix * unit::deg), 1e-12);
    }
  }
}

TEST(Edge, ItsLengthIsThatOfTheCurveInSpace) {  // [G-6]
  const double step = 1e-6;
  for (const Profile& p : {ball(10e-3), taper(6e-3, 7 * unit::deg, 1e-3)}) {
    for (const LagLaw law : {LagLaw::constant_lead, LagLaw::constant_helix}) {
      const Cutter c = cutter_of(p, law);
      const Meridian m = meridian(p);
      for (const double s : {0.3e-3, 0.9e-3, 4e-3, 9e-3}) {
        const auto space = [&](double at) {
          const MeridianPoint q = point_at(m, at);
          const double turn = lag_at(c, m, at).angle;
          return std::array{q.r * std::cos(turn), q.r * std::sin(turn), q.z};
        };
        const auto a = space(s - step);
        const auto b = space(s + step);
        const double chord = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        EXPECT_NEAR(edge_length_factor(point_at(m, s), lag_at(c, m, s)),
                    chord / (2 * step), 1e-6);
      }
    }
  }
}

TEST(Lag, OfAConstantLeadGrowsWithTheHeight) {  // [G-7]
  Cutter c = cutter_of(ball(10e-3), LagLaw::constant_lead, 30);
  c.lag_diameter = 12e-3;
  const Meridian m = meridian(c.profile);
  for (const double z : {0.0, 1e-3, 5e-3, 8e-3}) {
    EXPECT_NEAR(lag_at(c, m, arc_length_at(m, z)).angle,
                2 * z * std::tan(pi / 6) / 12e-3, 1e-14);
  }
}

TEST(Lag, LawsAgreeOnACylinderAndUpToTheFlank) {  // [G-7] [G-8]
  const auto differ = [](const Profile& p, double s) {
    const Cutter lead = cutter_of(p, LagLaw::constant_lead);
    const Cutter helix = cutter_of(p, LagLaw::constant_helix);
    const Meridian m = meridian(p);
    return lag_at(lead, m, s).angle - lag_at(helix, m, s).angle;
  };
  for (const double s : {0.0, 1e-3, 9e-3}) {
    EXPECT_NEAR(differ(cylinder(10e-3), s), 0.0, 1e-14);
    EXPECT_NEAR(differ(ball(10e-3), s), 0.0, 1e-14);
  }
  const Profile p = taper(10e-3, 10 * unit::deg, 2e-3);
  const double s_N = meridian(p).s_N;
  EXPECT_EQ(differ(p, 0.5 * s_N), 0.0);
  EXPECT_NEAR(differ(p, s_N), 0.0, 1e-14);
  EXPECT_GT(std::abs(differ(p, s_N + 5e-3)), 0.01);
}

TEST(Lag, OfAConstantHelixKeepsTheAngleToTheMeridian) {  // [G-8]
  for (const double taper_deg : {-6.0, 1e-9, 0.0, 4.0, 20.0}) {
    const Profile p = taper(10e-3, taper_deg * unit::deg);
    const Cutter c = cutter_of(p, LagLaw::constant_helix, 35);
    const Meridian m = meridian(p);
    for (const double s : steps(1e-3, 10e-3, 1e-3)) {
      EXPECT_NEAR(point_at(m, s).r * lag_at(c, m, s).per_arc, std::tan(35 * unit::deg),
                  1e-12);
    }
  }
}

TEST(Lag, ItsSlopeIsItsDerivative) {  // [G-7] [G-8]
  const double step = 1e-7;
  for (const Profile& p :
       {ball(10e-3), taper(10e-3, 12 * unit::deg, 2e-3), taper(10e-3, -0.05)}) {
    for (const LagLaw law : {LagLaw::constant_lead, LagLaw::constant_helix}) {
      const Cutter c = cutter_of(p, law);
      const Meridian m = meridian(p);
      for (const double s : {0.4e-3, 1.1e-3, 3.3e-3, 8.8e-3}) {
        const double slope =
            (lag_at(c, m, s + step).angle - lag_at(c, m, s - step).angle) / (2 * step);
        EXPECT_NEAR(lag_at(c, m, s).per_arc, slope, 1e-6 * slope);
      }
    }
  }
}

TEST(Cutter, ToothAnglesAddUpThePitches) {  // [G-1]
  Cutter c = cutter_of(cylinder(8e-3), LagLaw::constant_lead);
  c.pitch = {0.5, 2.0, 2 * pi - 2.5};
  EXPECT_EQ(tooth_angles(c), (std::vector{0.0, 0.5, 2.5}));
  EXPECT_EQ(equal_pitch(4), std::vector(4, pi / 2));
}

TEST(Cutter, PitchesAreEqualButForRounding) {
  EXPECT_TRUE(equally_pitched(equal_pitch(7)));
  EXPECT_TRUE(equally_pitched(std::vector{2 * pi}));
  EXPECT_TRUE(equally_pitched(std::vector{1.0, 1.0 + 1e-10}));
  EXPECT_FALSE(equally_pitched(std::vector{1.0, 1.0 + 1e-8}));
}

TEST(Cut, RadialDepthsAreBandsOfTheStock) {  // [G-11]
  const double inf = std::numeric_limits<double>::infinity();
  const Band slot = stock_band(Slot{}, 10e-3);
  EXPECT_EQ(slot.y_lo, -inf);
  EXPECT_EQ(slot.y_hi, inf);
  const Band up = stock_band(UpMilling{3e-3}, 10e-3);
  EXPECT_NEAR(up.y_lo, 2e-3, 1e-18);
  EXPECT_EQ(up.y_hi, inf);
  const Band down = stock_band(DownMilling{3e-3}, 10e-3);
  EXPECT_EQ(down.y_lo, -inf);
  EXPECT_NEAR(down.y_hi, -2e-3, 1e-18);
}

}  // namespace trochoid::geometry::edge_test
