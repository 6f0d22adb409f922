#include "made_wall.h"

#include <gtest/gtest.h>

#include <set>

namespace trochoid::surface::envelope_test {

/// A deflection made up for a test.
numerics::PeriodicPieces course(const std::function<double(double)>& f) {
  return {[&](double phi, std::span<double> out) { out[0] = f(phi); },
          {.period = 2 * pi, .longest = 0.2, .allowed = {1e-13}}};
}

HeightCut made_height(const MadeCut& s, double height,
                      const std::function<double(double)>& delta) {
  return {*side_of(s.cut.engagement),   s.cutter.profile.D / 2,
          s.cutter.teeth() * s.cut.f_z, 0.0,
          edge_places(s, height),       course(delta)};
}

double none(double) {
  return 0.0;
}

/// Cusp radius of the paths: (R - sigma f/2pi)^2/R.
double cusp_radius(const HeightCut& cut) {
  const double r = cut.R - cut.side.sigma * cut.feed / (2 * pi);
  return r * r / cut.R;
}

/// The lowest of all passes at x: each path as a chain of short straight pieces.
double brute_force(const HeightCut& cut, double x) {
  constexpr int pieces = 6000;
  constexpr double reach = 0.35;  // in theta, to both sides of the wall
  constexpr int turns = 40;
  double lowest = 1.0;
  for (const EdgePlace& tooth : cut.teeth) {
    for (int n = -turns; n <= turns; ++n) {
      double x_before = 0.0;
      double e_before = 0.0;
      for (int i = 0; i <= pieces; ++i) {
        const double theta = cut.side.theta + reach * (2.0 * i / pieces - 1);
        const double phi = theta + tooth.behind + 2 * pi * n;
        const double at = cut.x_0 + cut.feed * phi / (2 * pi) +
                          tooth.R * std::sin(theta) +
                          (cut.along.functions() == 0 ? 0.0 : value_at(cut.along, phi));
        const bool first = i == 0;
        if (first && std::abs(at - x) > 2 * reach * tooth.R + 1e-3) break;
        if ((x < at) != (x < x_before) || first) {
          const double e = cut.R + cut.side.sigma * tooth.R * std::cos(theta) +
                           value_at(cut.deflection, phi);
          if (!first && (x < at) != (x < x_before)) {
            lowest = std::min(
                lowest, e_before + (e - e_before) * (x - x_before) / (at - x_before));
          }
        }
        x_before = at;
        e_before = cut.R + cut.side.sigma * tooth.R * std::cos(theta) +
                   value_at(cut.deflection, phi);
      }
    }
  }
  return lowest;
}

/// The same with a cutter that also bends along the feed.
HeightCut bent_along(HeightCut cut, const std::function<double(double)>& u_x,
                     double most) {
  cut.along = course(u_x);
  cut.most_along = most;
  return cut;
}

TEST(Envelope, AnEvenBendAlongTheFeedShiftsTheWall) {  // [E-44]
  const HeightCut cut =
      made_height(with_runout(made_cut(), 5e-6, 0.4), 1e-3,
                  [](double phi) { return 9e-6 * std::sin(3 * phi); });
  const HeightCut bent = bent_along(
      cut, [](double) { return 0.07e-3; }, 0.07e-3);
  for (int i = 0; i < 40; ++i) {
    const double x = 0.6e-3 * (i + 0.37) / 40;
    const SurfacePoint a = envelope_error(bent, x);
    const SurfacePoint b = envelope_error(cut, x - 0.07e-3);
    EXPECT_NEAR(a.error, b.error, 1e-12);
    EXPECT_EQ(a.tooth, b.tooth);
  }
}

TEST(Envelope, AnUnevenOneIsThatOfThePathsThemselves) {  // [E-44]
  for (const bool down : {true, false}) {
    const auto u_x = [](double phi) { return 40e-6 * std::cos(2 * phi + 0.4); };
    const auto delta = [](double phi) { return 20e-6 * std::sin(3 * phi + 0.2); };
    const HeightCut bent = bent_along(
        made_height(with_runout(made_cut(down), 5e-6, 0.4), 1e-3, delta), u_x, 40e-6);
    for (int i = 0; i < 8; ++i) {
      const double x = 0.6e-3 * (i + 0.37) / 8;
      EXPECT_NEAR(envelope_error(bent, x).error, brute_force(bent, x), 2e-9) << down;
    }
  }
}

TEST(QuasiStatic, IsDeflectionMinusTheRadiusOfTheOwner) {  // [E-7]
  MadeCut s = made_cut();
  s.runout.radial_offsets = {0.0, 5e-6, -2e-6};
  const HeightCut cut =
      made_height(s, 1e-3, [](double phi) { return 20e-6 * std::sin(phi); });
  const SurfacePoint a = quasi_static_error(cut, 1, 0.3);
  EXPECT_NEAR(a.error, 20e-6 * std::sin(0.3) - 5e-6, 1e-12);
  EXPECT_EQ(a.tooth, 1);
  EXPECT_EQ(a.phi, 0.3);
  EXPECT_NEAR(quasi_static_error(cut, 2, 0.3).error, 20e-6 * std::sin(0.3) + 2e-6,
              1e-12);
}

TEST(Imprint, IsTakenWhereEachToothTouchesTheWall) {  // [E-8]
  for (const bool down : {true, false}) {
    MadeCut s = made_cut(down);
    s.runout.radial_offsets = {1e-6, 5e-6, -2e-6};
    const HeightCut cut =
        made_height(s, 1.5e-3, [](double phi) { return 20e-6 * std::sin(phi); });
    const auto points = imprint_errors(cut);
    ASSERT_EQ(points.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      const double phi = (down ? pi : 0.0) + 2 * pi / 3 * static_cast<double>(i) + 0.25;
      EXPECT_NEAR(points[i].phi, phi, 1e-14);
      EXPECT_NEAR(points[i].error, 20e-6 * std::sin(phi) - s.runout.radial_offsets[i],
                  1e-12);
      EXPECT_EQ(points[i].tooth, static_cast<int>(i));
    }
  }
}

TEST(Imprint, DownMillingFeelsTheFlutesAboveUpMillingThoseBelow) {  // [E-8]
  // one point of force at a time: what lies below (above) the height does nothing
  for (const bool down : {true, false}) {
    Setting s = made_setting(Model::imprint, made_cut(down, 1));
    const double at_top = imprint_errors(height_cut(s, {8e8, 3e8}, 3e-3))[0].error;
    const double at_tip = imprint_errors(height_cut(s, {8e8, 3e8}, 0.0))[0].error;
    EXPECT_GT(std::abs(down ? at_tip : at_top), 1e-6);
    EXPECT_NEAR(down ? at_top : at_tip, 0.0, 1e-9);
  }
}

TEST(Envelope, ARigidCutLeavesScallops) {  // [E-9]
  for (const bool down : {true, false}) {
    for (const int teeth : {1, 2, 3, 5}) {
      MadeCut s = made_cut(down, teeth);
      s.cut.f_z = 0.6e-3 / teeth;
      const HeightCut cut = made_height(s, 1e-3, none);
      const double f = s.cut.f_z;
      double peak = 0.0;
      std::set<int> who;
      for (int i = 0; i < 600; ++i) {
        const SurfacePoint p = envelope_error(cut, 0.6e-3 * i / 600);
        peak = std::max(peak, p.error);
        EXPECT_GE(p.error, 0.0);
        who.insert(p.tooth);
      }
      // to the order f^2/R^2
      EXPECT_NEAR(mean_envelope(cut, 600), f * f / (24 * cusp_radius(cut)),
                  1e-3 * f * f / (24 * cusp_radius(cut)));
      EXPECT_NEAR(peak, f * f / (8 * cusp_radius(cut)), 4e-3 * f * f / (8 * 6e-3));
      EXPECT_EQ(who.size(), static_cast<std::size_t>(teeth));
    }
  }
}

TEST(Envelope, ARigidShiftShiftsIt) {  // [E-9]
  const HeightCut here = made_height(made_cut(), 1e-3, none);
  const HeightCut there = made_height(made_cut(), 1e-3, [](double) { return 7e-6; });
  for (double x = 0.0; x < 0.6e-3; x += 0.017e-3) {
    EXPECT_NEAR(envelope_error(there, x).error, envelope_error(here, x).error + 7e-6,
                1e-15);
  }
}

TEST(Envelope, RepeatsWithTheFeedOfATurn) {  // [E-9]
  const HeightCut cut =
      height_cut(made_setting(Model::envelope, with_runout(made_cut(), 3e-6, 1.0)),
                 {8e8, 3e8}, 0.5e-3);
  for (double x = 0.0; x < 0.6e-3; x += 0.031e-3) {
    const SurfacePoint a = envelope_error(cut, x);
    const SurfacePoint b = envelope_error(cut, x + 7 * cut.feed);
    EXPECT_NEAR(a.error, b.error, 1e-13);
    EXPECT_EQ(a.tooth, b.tooth);
    EXPECT_NEAR(b.phi - a.phi, 14 * pi, 1e-6);
  }
}

TEST(Envelope, ItsStartIsWhereTheAxisWas) {  // [E-9]
  HeightCut cut = made_height(with_runout(made_cut(), 3e-6, 1.0), 0.5e-3, none);
  const double before = envelope_error(cut, 0.1e-3).error;
  cut.x_0 = 41.7e-3;
  EXPECT_NEAR(envelope_error(cut, 41.8e-3).error, before, 1e-13);
}

TEST(Envelope, TheToothAndAngleNamedMadeIt) {  // [E-9]
  const HeightCut cut =
      height_cut(made_setting(Model::envelope, with_runout(made_cut(), 2e-6, 1.0)),
                 {8e8, 3e8}, 0.5e-3);
  for (double x = 0.0; x < 0.6e-3; x += 0.031e-3) {
    const SurfacePoint p = envelope_error(cut, x);
    const EdgePlace& tooth = cut.teeth[static_cast<std::size_t>(p.tooth)];
    const double theta = p.phi - tooth.behind;
    EXPECT_NEAR(cut.feed * p.phi / (2 * pi) + tooth.R * std::sin(theta), x, 1e-13);
    EXPECT_NEAR(cut.R + tooth.R * std::cos(theta) + value_at(cut.deflection, p.phi),
                p.error, 1e-15);
  }
}

struct Case {
  const char* name;
  MadeCut cut;
  std::function<double(double)> delta;
};

class AllPasses : public testing::TestWithParam<int> {
 public:
  static Case made(int which) {
    const auto slow = [](double phi) { return 50e-6 * std::sin(phi); };
    const auto pulses = [](double phi) { return 30e-6 * (1 + std::cos(3 * phi + 1)); };
    switch (which) {
      case 0:
        return {"rigid, runout", with_runout(made_cut(), 2e-6, 1.0), none};
      case 1:
        return {"up, runout, pulses", with_runout(made_cut(false), 8e-6, 2.0), pulses};
      case 2:
        return {"down, pulses", made_cut(), pulses};
      case 3:
        return {"large runout", with_runout(made_cut(true, 4), 0.2e-3, 0.3), slow};
      case 4: {
        MadeCut s = made_cut(true, 2);  // a slope of 1 mm a turn over a feed of 40 um
        s.cut.f_z = 20e-6;
        return {"fine feed, steep", s,
                [](double phi) { return 200e-6 * std::sin(phi); }};
      }
      case 5: {
        MadeCut s = made_cut(false, 1);
        s.cut.f_z = 10e-6;
        return {"fine feed, a narrow pulse", s, [](double phi) {
                  return 80e-6 * std::exp(20 * (std::cos(phi - 0.2) - 1));
                }};
      }
      default: {
        MadeCut s = made_cut(true, 3);
        s.cutter.pitch = {1.9, 2.2, 2 * pi - 4.1};
        return {"uneven pitch", with_runout(s, 2e-6, 0.5), pulses};
      }
    }
  }
};

TEST_P(AllPasses, NothingStandsAboveAnyPath) {  // [E-9]
  const Case it = made(GetParam());
  const HeightCut cut = made_height(it.cut, 1.2e-3, it.delta);
  const int samples = 5;
  for (int i = 0; i < samples; ++i) {
    const double x = cut.feed * (i + 0.37) / samples;
    EXPECT_NEAR(envelope_error(cut, x).error, brute_force(cut, x), 1e-9) << it.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Made, AllPasses, testing::Range(0, 7));

TEST(Envelope, SpringBackLowersItToSecondOrder) {  // [E-9]
  // mean = imprint - delta'^2/2R + f^2/24 R_e for a deflection that falls evenly
  const double slope = 0.1e-3;
  const MadeCut s = made_cut(true, 1);
  const HeightCut cut = made_height(s, 0.0, [&](double phi) {
    return slope * std::sin(phi - pi);  // touches at phi = pi
  });
  const double f = s.cut.f_z;
  const double imprint = imprint_errors(cut)[0].error;
  EXPECT_NEAR(mean_envelope(cut, 400) - imprint,
              -slope * slope / (2 * 6e-3) + f * f / (24 * cusp_radius(cut)), 2e-8);
}

TEST(Envelope, TheLongestToothErasesTheOthers) {  // [E-9]
  MadeCut s = made_cut();
  s.runout.radial_offsets = {0.0, 60e-6, 0.0};
  const HeightCut cut = made_height(s, 1e-3, none);
  double lowest = 1.0;
  for (int i = 0; i < 100; ++i) {
    const SurfacePoint p = envelope_error(cut, 0.6e-3 * i / 100);
    EXPECT_EQ(p.tooth, 1);
    lowest = std::min(lowest, p.error);
  }
  EXPECT_NEAR(lowest, -60e-6, 2e-9);
}

TEST(Envelope, OfThePaperIsKnown) {  // [E-9] imprint 54.66, envelope 48.22 um
  const HeightCut cut = height_cut(made_setting(Model::envelope), {8e8, 3e8}, 0.5e-3);
  EXPECT_NEAR(imprint_errors(cut)[0].error, 54.663e-6, 3e-9);
  EXPECT_NEAR(mean_envelope(cut, 300), 48.217e-6, 5e-9);
}

}  // namespace trochoid::surface::envelope_test
