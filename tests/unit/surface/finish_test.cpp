#include <trochoid/surface/finish.h>

#include <trochoid/base/units.h>
#include <trochoid/geometry/tooth_edges.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace trochoid::surface::finish_test {

constexpr double mm = 1e-3;
constexpr double um = 1e-6;

force::Setup face_mill(const geometry::Profile& profile, int teeth, double f_z) {
  force::Setup out;
  out.cutter.profile = profile;
  out.cutter.pitch = geometry::equal_pitch(teeth);
  out.cutter.lag_diameter = profile.D;
  out.cut = {.engagement = geometry::Slot{}, .a_p = 1 * mm, .f_z = f_z, .Omega = 100.0};
  return out;
}

const BottomEdge dished{.dish = 10 * unit::deg, .lead = 0.02 * unit::deg};

TEST(Finish, AnArcLeavesTheRoughnessOfTheBooks) {  // [W-1] [W-3] [W-5]
  const double r = 0.8 * mm;
  const double f_z = 0.05 * mm;
  const auto setup = face_mill(geometry::bull_nose(63 * mm, r), 5, f_z);
  const Roughness w = roughness(floor_profile(setup, dished, 0.0));
  const double Rt = f_z * f_z / (8 * r);
  EXPECT_NEAR(w.Rt, Rt, 3e-3 * Rt);
  EXPECT_NEAR(w.Ra, f_z * f_z / (18 * std::sqrt(3.0) * r), 3e-3 * w.Ra);
  EXPECT_NEAR(w.Rq, Rt * std::sqrt(4.0 / 45), 3e-3 * w.Rq);
  EXPECT_EQ(w.Rz, w.Rt);
}

/// A change of passes at the very end of a period left a piece without a height.
TEST(Finish, OfABallIsThatOfItsArcBesideTheAxis) {  // [W-3]
  const double R = 6 * mm;
  const double f_z = 0.1 * mm;
  const auto setup = face_mill(geometry::ball(2 * R), 1, f_z);
  for (const double y : {0.5 * mm, 2 * mm, 4 * mm}) {
    const Roughness w = roughness(floor_profile(setup, {}, y));
    const double arc = std::sqrt(R * R - y * y);
    EXPECT_NEAR(w.Ra, f_z * f_z / (18 * std::sqrt(3.0) * arc), 0.15 * w.Ra) << y;
    EXPECT_NEAR(w.mean, R - arc, 0.01 * (R - arc)) << y;
  }
  EXPECT_TRUE(std::isfinite(roughness(floor_profile(setup, {}, 0.0)).Ra));
}

TEST(Finish, OneDeeperToothWritesAlone) {  // [W-3]
  auto setup = face_mill(geometry::bull_nose(63 * mm, 0.8 * mm), 4, 0.05 * mm);
  setup.runout.axial_offsets = {0.0, -30 * um, -30 * um, -30 * um};
  const PeriodicProfile profile = floor_profile(setup, dished, 0.0);
  EXPECT_NEAR(shares(profile, 4)[0], 1.0, 1e-12);
  const double f = 0.2 * mm;
  EXPECT_NEAR(roughness(profile).Rt, f * f / (8 * 0.8 * mm),
              0.01 * f * f / (8 * 0.8 * mm));
}

TEST(Finish, ASharpCornerLeavesATriangle) {  // [W-3] [W-5]
  const double kappa = 45 * unit::deg;
  const BottomEdge bottom{.dish = 1.5 * unit::deg, .lead = 0.05 * unit::deg};
  const double f_z = 0.15 * mm;
  const auto setup = face_mill(geometry::taper(80 * mm, kappa), 7, f_z);
  const Roughness w = roughness(floor_profile(setup, bottom, 0.0));
  const double lead = std::tan(bottom.lead);
  const double Rt =
      f_z / (1 / (std::tan(kappa) - lead) + 1 / (std::tan(bottom.dish) + lead));
  EXPECT_NEAR(w.Rt, Rt, 2e-3 * Rt);
  EXPECT_NEAR(w.Ra, Rt / 4, 2e-3 * Rt);
  EXPECT_NEAR(w.Rq, Rt / std::sqrt(12.0), 2e-3 * Rt);
}

TEST(Finish, AnEccentricityIsTheOffsetsThatItMakes) {  // [W-4]
  const auto round = [](double rho) {
    auto setup = face_mill(geometry::bull_nose(50 * mm, 1 * mm), 3, 0.1 * mm);
    setup.runout.eccentricity = rho;
    setup.runout.angle = 0.6;
    return setup;
  };
  auto offsets = round(0.0);
  for (const double psi : geometry::tooth_angles(offsets.cutter)) {
    offsets.runout.radial_offsets.push_back(8 * um * std::cos(psi - 0.6));
  }
  const Roughness a = roughness(floor_profile(round(8 * um), dished, 0.0));
  const Roughness b = roughness(floor_profile(offsets, dished, 0.0));
  // Across the blade the eccentricity moves the mark along y, which changes nothing here.
  EXPECT_NEAR(a.Ra, b.Ra, 1e-3 * a.Ra);
  EXPECT_NE(a.Ra, roughness(floor_profile(round(0.0), dished, 0.0)).Ra);
}

TEST(Finish, ADishOfNothingIsFlat) {  // [W-5]
  const auto setup = face_mill(geometry::bull_nose(63 * mm, 0.8 * mm), 5, 0.1 * mm);
  EXPECT_TRUE(is_flat(setup.cutter.profile, {}));
  EXPECT_FALSE(is_flat(setup.cutter.profile, dished));
  EXPECT_FALSE(is_flat(geometry::ball(10 * mm), {}));
  EXPECT_NEAR(roughness(floor_profile(setup, {}, 0.0)).Ra, 0.0, 1e-15);
}

TEST(Finish, AWiperLevelsMarks) {  // [W-5]
  const auto setup = face_mill(geometry::bull_nose(63 * mm, 0.8 * mm), 5, 0.1 * mm);
  BottomEdge wiper = dished;
  wiper.lead = 0.0;
  wiper.wiper = 0.6 * mm;  // wider than the feed of a turn
  EXPECT_NEAR(roughness(floor_profile(setup, wiper, 0.0)).Ra, 0.0, 1e-12);
}

TEST(Finish, OfAWallIsThatOfTheBooks) {  // [W-6]
  for (const bool up : {false, true}) {
    auto setup = face_mill(geometry::cylinder(10 * mm), 4, 0.2 * mm);
    setup.cut.engagement = up ? geometry::Engagement{geometry::UpMilling{0.5 * mm}}
                              : geometry::Engagement{geometry::DownMilling{0.5 * mm}};
    const double R = 5 * mm;
    const double feed = 0.8 * mm / unit::turn;
    const double R_e = std::pow(R + (up ? feed : -feed), 2) / R;
    const Roughness w = roughness(wall_profile(setup, 0.0));
    EXPECT_NEAR(w.Rt, std::pow(0.2 * mm, 2) / (8 * R_e), 1e-3 * w.Rt);
    EXPECT_NEAR(w.lowest, 0.0, 1e-15);
  }
}

TEST(Finish, OfAWallIsTheLeastOfAllPasses) {  // [W-6]
  auto setup = face_mill(geometry::cylinder(12 * mm), 3, 0.15 * mm);
  setup.cut.engagement = geometry::DownMilling{0.5 * mm};
  setup.cutter.helix = 0.5;
  setup.runout = {
      .radial_offsets = {0.0, 2 * um, -1 * um}, .tilt = 2e-4, .tilt_angle = 0.4};
  const double z = 5 * mm;
  const PeriodicProfile profile = wall_profile(setup, z);
  const geometry::ToothEdges edges(setup.cutter, setup.runout);
  // Points of all paths in small steps, none of which lies below the profile.
  double closest = 1.0;
  for (std::size_t j = 0; j < 3; ++j) {
    const geometry::EdgeAt at = edges.edge_at(j, z);
    for (int i = -4000; i <= 4000; ++i) {
      const double theta = std::numbers::pi + i * 2.5e-5;
      for (int n = -3; n < 4; ++n) {
        const double phi = theta - at.position.epsilon + at.omega + n * unit::turn;
        const double x =
            profile.period * phi / unit::turn + at.position.R * std::sin(theta);
        if (x < 0 || x >= profile.period) continue;
        const double e = 6 * mm + at.position.R * std::cos(theta);
        const double above = e - profile_at(profile, x).height;
        EXPECT_GT(above, -1e-14);
        closest = std::min(closest, above);
      }
    }
  }
  EXPECT_LT(closest, 1e-12);
}

/// A triangle, and a sine in pieces.
TEST(Roughness, OfATriangleAndOfASine) {  // [W-1]
  PeriodicProfile triangle{
      .period = 2.0,
      .breaks = {0.0, 1.0, 2.0},
      .tooth = {0, 0},
      .height = [](std::size_t piece, double x) { return piece == 0 ? x : 2 - x; }};
  const Roughness t = roughness(triangle);
  EXPECT_NEAR(t.mean, 0.5, 1e-14);
  EXPECT_NEAR(t.Ra, 0.25, 1e-14);
  EXPECT_NEAR(t.Rq, 1 / std::sqrt(12.0), 1e-14);
  EXPECT_NEAR(t.Rt, 1.0, 1e-14);
  PeriodicProfile sine{.period = 1.0,
                       .breaks = {0.0, 0.3, 1.0},
                       .tooth = {0, 1},
                       .height = [](std::size_t, double x) {
                         return std::sin(2 * std::numbers::pi * x);
                       }};
  const Roughness s = roughness(sine);
  EXPECT_NEAR(s.Ra, 2 / std::numbers::pi, 1e-9);
  EXPECT_NEAR(s.Rq, std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(s.Rt, 2.0, 1e-9);
  EXPECT_NEAR(shares(sine, 2)[1], 0.7, 1e-14);
}

TEST(Roughness, AGaussianFilterPassesHalfAtItsCutoff) {  // [W-2]
  PeriodicProfile sine{.period = 1.0,
                       .breaks = {0.0, 1.0},
                       .tooth = {0},
                       .height = [](std::size_t, double x) {
                         return 3 + std::sin(2 * std::numbers::pi * x);
                       }};
  const Roughness whole = roughness(sine);
  const Roughness half = filtered_roughness(sine, 1.0);
  EXPECT_NEAR(half.Rq, 0.5 * whole.Rq, 1e-9);
  EXPECT_NEAR(half.Ra, 0.5 * whole.Ra, 1e-9);
  EXPECT_NEAR(half.Rz, 1.0, 1e-9);
  EXPECT_NEAR(filtered_roughness(sine, 20.0).Rq, whole.Rq, 1e-9);
}

}  // namespace trochoid::surface::finish_test
