#include "steps.h"

#include <trochoid/base/units.h>
#include <trochoid/geometry/meridian.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace trochoid::geometry::meridian_test {

constexpr double pi = std::numbers::pi;
constexpr double beta = 8 * unit::deg;

struct Named {
  std::string name;
  Profile profile;
  bool tangent = true;  ///< no corner where cone, arc and flank meet
};

/// Bottom cone, corner and vertical flank, tangent to one another.
Profile cone_and_corner() {
  const double alpha = 12 * unit::deg;
  const double Rr = 5e-3 - 1e-3;
  return {.D = 10e-3,
          .R = 1e-3,
          .Rr = Rr,
          .Rz = Rr * std::tan(alpha) + 1e-3 / std::cos(alpha),
          .alpha = alpha};
}

std::vector<Named> shapes() {
  const double tip = 2 * 1.5e-3 * (1 - std::sin(beta)) / std::cos(beta);
  return {{"cylinder", cylinder(10e-3)},
          {"ball", ball(10e-3)},
          {"bull nose", bull_nose(10e-3, 2e-3)},
          {"sharp taper", taper(10e-3, beta)},
          {"inverse taper", taper(10e-3, -beta)},
          {"taper with corner", taper(10e-3, beta, 1.5e-3)},
          {"tapered ball", taper(tip, beta, 1.5e-3)},
          {"cone and corner", cone_and_corner()},
          {"drill", {.D = 10e-3, .Rr = 5e-3, .alpha = 30 * unit::deg}, false},
          {"corner that is cut off",
           {.D = 10e-3, .R = 2e-3, .Rr = 3.5e-3, .Rz = 1.8e-3},
           false}};
}

void expect_at(const MeridianPoint& p, double r_mm, double z_mm, double slack = 1e-15) {
  EXPECT_NEAR(p.r, r_mm * unit::mm, slack);
  EXPECT_NEAR(p.z, z_mm * unit::mm, slack);
}

/// Where segments are tangent, a root is taken of what rounding leaves of zero.
constexpr double root_slack = 1e-10;

TEST(Meridian, SegmentsMeetWhereOneWouldDrawThem) {  // [G-5]
  const Meridian c = meridian(cylinder(10e-3));
  expect_at(c.M, 5, 0);
  expect_at(c.N, 5, 0);
  const Meridian b = meridian(ball(10e-3));
  expect_at(b.M, 0, 0);
  expect_at(b.N, 5, 5);
  const Meridian n = meridian(bull_nose(10e-3, 2e-3));
  expect_at(n.M, 3, 0);
  expect_at(n.N, 5, 2);
  const Meridian t = meridian(taper(10e-3, beta));
  expect_at(t.N, 5, 0);
  const Meridian d = meridian({.D = 10e-3, .Rr = 5e-3, .alpha = pi / 6});
  expect_at(d.M, 5, 5 / std::sqrt(3.0));
  expect_at(d.N, 5, 5 / std::sqrt(3.0));
}

TEST(Meridian, ATaperIsTangentToItsCorner) {  // [G-5]
  const Meridian t = meridian(taper(10e-3, beta, 1.5e-3));
  const double Rr = 5 - 1.5 * (1 - std::sin(beta)) / std::cos(beta);
  expect_at(t.M, Rr, 0);
  expect_at(t.N, Rr + 1.5 * std::cos(beta), 1.5 * (1 - std::sin(beta)), root_slack);
  EXPECT_NEAR(t.N.r, 5e-3 + t.N.z * std::tan(beta), 1e-15);
}

TEST(Meridian, AConeIsTangentToItsCorner) {  // [G-2] [G-5]
  const Meridian m = meridian(cone_and_corner());
  const double alpha = m.profile.alpha;
  expect_at(m.M, 4 + std::sin(alpha), (4 + std::sin(alpha)) * std::tan(alpha),
            root_slack);
  expect_at(m.N, 5, m.profile.Rz / unit::mm, root_slack);
}

TEST(Meridian, PointsSatisfyTheEquationOfTheirSegment) {  // [G-2] [G-3] [G-4]
  for (const auto& [name, p, tangent] : shapes()) {
    const Meridian m = meridian(p);
    const double u = p.D / 2 * (1 - std::tan(p.alpha) * std::tan(p.beta));
    for (const double s : steps(1e-6, 12e-3, 37e-6)) {
      const MeridianPoint at = point_at(m, s);
      if (s < m.s_M) {
        EXPECT_NEAR(at.z, at.r * std::tan(p.alpha), 1e-15) << name;
      } else if (s < m.s_N) {
        EXPECT_NEAR(std::hypot(at.r - p.Rr, at.z - p.Rz), p.R, 1e-15) << name;
        EXPECT_NEAR(at.sin_kappa, (at.r - p.Rr) / p.R, 1e-12) << name;
        EXPECT_NEAR(at.cos_kappa, (p.Rz - at.z) / p.R, 1e-12) << name;
      } else {
        EXPECT_NEAR(at.r, u + at.z * std::tan(p.beta), 1e-15) << name;
        EXPECT_NEAR(at.cos_kappa, std::sin(p.beta), 1e-15) << name;
      }
    }
  }
}

TEST(Meridian, TheCurveRunsAlongItsTangentAtUnitSpeed) {
  const double step = 1e-7;
  for (const auto& [name, p, tangent] : shapes()) {
    const Meridian m = meridian(p);
    for (const double s : steps(2e-6, 12e-3, 41e-6)) {
      if (std::abs(s - m.s_M) < 2 * step || std::abs(s - m.s_N) < 2 * step) {
        continue;
      }
      const MeridianPoint a = point_at(m, s - step);
      const MeridianPoint b = point_at(m, s + step);
      const MeridianPoint at = point_at(m, s);
      EXPECT_NEAR((b.r - a.r) / (2 * step), at.cos_kappa, 1e-7) << name << " " << s;
      EXPECT_NEAR((b.z - a.z) / (2 * step), at.sin_kappa, 1e-7) << name << " " << s;
    }
  }
}

TEST(Meridian, TheCurveIsWholeAndItsTangentTurnsOnlyAtCorners) {
  const double step = 1e-9;
  for (const auto& [name, p, tangent] : shapes()) {
    const Meridian m = meridian(p);
    for (const double s : {m.s_M, m.s_N}) {
      if (s < step) {
        continue;
      }
      const MeridianPoint a = point_at(m, s - step);
      const MeridianPoint b = point_at(m, s + step);
      EXPECT_NEAR(std::hypot(b.r - a.r, b.z - a.z), 2 * step, 0.5 * step) << name;
      const double turn =
          std::atan2(b.sin_kappa, b.cos_kappa) - std::atan2(a.sin_kappa, a.cos_kappa);
      if (tangent) {
        EXPECT_NEAR(turn, 0.0, 3e-6) << name;  // 2 step / R, and rounding in a root
      }
    }
  }
}

TEST(Meridian, ArcLengthAndHeightAreInverse) {
  for (const auto& [name, p, tangent] : shapes()) {
    const Meridian m = meridian(p);
    for (const double z :
         steps(m.profile.alpha > 0 ? 0.0 : m.M.z + 1e-9, 9e-3, 53e-6)) {
      EXPECT_NEAR(point_at(m, arc_length_at(m, z)).z, z, 1e-13) << name;
    }
    for (const double s : steps(20e-6, 9e-3, 59e-6)) {
      // s(z) of an arc has few digits where the arc is flat
      const double slack = 1e-15 / point_at(m, s).sin_kappa;
      EXPECT_NEAR(arc_length_at(m, point_at(m, s).z), s, 10 * slack) << name;
    }
  }
}

TEST(Meridian, AFlatBottomCarriesNoEdge) {
  EXPECT_EQ(meridian(bull_nose(10e-3, 2e-3)).s_M, 0.0);
  EXPECT_EQ(meridian(cylinder(10e-3)).s_N, 0.0);
}

TEST(Meridian, WhatIsNoCutterIsRefused) {
  EXPECT_THROW(meridian({.D = 10e-3, .R = 1e-3, .Rr = 8e-3, .Rz = 1e-3}),
               std::invalid_argument);
  EXPECT_THROW(meridian({.D = 10e-3, .R = 1e-3, .Rr = 1e-3, .Rz = 1e-3}),
               std::invalid_argument);
  EXPECT_THROW(meridian(bull_nose(10e-3, 6e-3)), std::invalid_argument);
}

}  // namespace trochoid::geometry::meridian_test
