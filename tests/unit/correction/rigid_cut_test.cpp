#include "paper_case.h"

#include <trochoid/correction/rigid_cut.h>
#include <trochoid/correction/shapes.h>
#include <trochoid/correction/wall_marks.h>
#include <trochoid/force/forces.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace trochoid::correction::rigid_cut_test {

namespace {

constexpr double turn = 2 * std::numbers::pi;
const PeriodicMotion still = Harmonics{};
const std::vector<Shape> shapes = {Shape::square, Shape::sine, Shape::trapezoid,
                                   Shape::quintic, Shape::harmonics};

}  // namespace

TEST(RigidCut, AgreesWithTheForcesOfACutAtRest) {
  for (const auto& rho :
       {std::vector<double>{13e-6, -13e-6}, std::vector<double>{12e-6, -3e-6, -9e-6}}) {
    for (const chip::Model model :
         {chip::Model::none, chip::Model::feed, chip::Model::radial}) {
      for (const geometry::Engagement& engagement :
           {geometry::Engagement(geometry::Slot{}),
            geometry::Engagement(geometry::UpMilling{2e-3})}) {
        force::Setup setup = slot_with(rho);
        setup.cut.engagement = engagement;
        setup.chip.model = model;
        const RigidCut cut(setup, ordinary_law());
        std::vector<double> phi;
        for (int i = 0; i < 97; ++i) {
          phi.push_back(0.013 + turn * i / 97);
        }
        const auto want = force::forces(setup, ordinary_law(), phi, 1e-10);
        for (std::size_t i = 0; i < phi.size(); ++i) {
          const auto F = cut.force(still, phi[i]);
          for (std::size_t q = 0; q < 3; ++q) {
            EXPECT_NEAR(F[q], want[i][q], 1e-6) << phi[i];
          }
        }
      }
    }
  }
}

TEST(RigidCut, AgreesWithForcesOfUnequalPitchAndHelix) {
  force::Setup setup = slot_with({12e-6, -3e-6, -9e-6});
  setup.cutter.pitch = {1.9, 2.2, turn - 4.1};
  setup.cutter.helix = 0.5;
  setup.cut.a_p = 2e-3;
  const RigidCut cut(setup, ordinary_law(), 400);
  std::vector<double> phi;
  for (int i = 0; i < 41; ++i) {
    phi.push_back(0.013 + turn * i / 41);
  }
  const auto want = force::forces(setup, ordinary_law(), phi, 1e-9);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    const auto F = cut.force(still, phi[i]);
    for (std::size_t q = 0; q < 3; ++q) {
      EXPECT_NEAR(F[q], want[i][q], 0.05) << phi[i];
    }
  }
}

TEST(RigidCut, TableAwayFromTheToolMakesTheChipThinner) {
  const RigidCut cut(slot_with({0.0, 0.0}), steep_law());
  const PeriodicMotion away = Harmonics{0.0, {{0.0, -5e-6}}};  // +5 um at 90 degrees
  EXPECT_GT(place_at(away, turn / 4), 0);
  EXPECT_NEAR(cut.chip(away, 0, turn / 4).h, 50e-6 - 10e-6, 1e-15);
  EXPECT_NEAR(cut.chip(away, 1, turn * 3 / 4).h, 50e-6 + 10e-6, 1e-15);
}

TEST(RigidCut, AllMaterialIsCutWhateverTheTableDoes) {
  for (const auto& rho :
       {std::vector<double>{13e-6, -13e-6}, std::vector<double>{40e-6, -30e-6},
        std::vector<double>{12e-6, -3e-6, -9e-6}}) {
    const RigidCut cut(slot_with(rho), steep_law());
    for (const Shape shape : shapes) {
      for (const double factor : {0.0, 0.5, 1.0, 2.5}) {
        double sum = 0.0;
        for (const Flute& f :
             cut.flutes(scaled(table_motion(cut, shape, {}), factor))) {
          sum += f.chip_area;
        }
        const double all = 2 * static_cast<double>(rho.size()) * 50e-6;
        EXPECT_NEAR(sum, all, 1e-7 * all) << static_cast<int>(shape) << ' ' << factor;
      }
    }
  }
}

TEST(RigidCut, PredictionIsWhatItsPartsSay) {
  const RigidCut cut(slot_with({12e-6, -3e-6, -9e-6}), ordinary_law());
  const PeriodicMotion x = table_motion(cut, Shape::sine, {});
  const Prediction p = cut.predict(x, 90);
  ASSERT_EQ(p.angle.size(), 90U);
  for (std::size_t i = 0; i < p.angle.size(); ++i) {
    const auto F = cut.force(x, p.angle[i]);
    for (std::size_t q = 0; q < 3; ++q) {
      EXPECT_NEAR(F[q], p.force[i][q], 1e-12);
      double sum = 0.0;
      for (const auto& flute : p.flute_force) {
        sum += flute[i][q];
      }
      EXPECT_NEAR(sum, F[q], 1e-12);
    }
    EXPECT_DOUBLE_EQ(p.table[i], place_at(x, p.angle[i]));
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_DOUBLE_EQ(p.chip[j][i], cut.chip(x, static_cast<int>(j), p.angle[i]).h);
    }
  }
}

TEST(RigidCut, CutsWhatIsLeftInTheLimits) {
  force::Setup setup = slot_with({30e-6, -30e-6});  // more runout than feed
  const auto idle = RigidCut(setup, steep_law()).flutes(still);
  EXPECT_EQ(idle[1].chip_area, 0.0);
  EXPECT_EQ(idle[1].peak_chip, 0.0);
  EXPECT_NEAR(idle[0].chip_area, 4 * 50e-6, 1e-12);
  EXPECT_NEAR(idle[0].peak_chip, 2 * 50e-6, 1e-12);
  const RigidCut one(slot_with({5e-6}), steep_law());
  for (const double theta : {0.3, 1.5, 2.9}) {
    EXPECT_NEAR(one.chip(still, 0, theta).h, 50e-6 * std::sin(theta), 1e-17);
  }
  setup = slot_with({13e-6, -13e-6});
  setup.cut.f_z = 0.0;
  EXPECT_EQ(RigidCut(setup, steep_law()).flutes(still)[0].peak_y, 0.0);
  setup.cut.f_z = 50e-6;
  setup.cut.a_p = 0.0;
  EXPECT_EQ(RigidCut(setup, steep_law()).flutes(still)[0].peak_y, 0.0);
}

TEST(WallMarks, TheLongestToothMakesTheWallWhateverTheTableDoes) {
  const double R = 4e-3;
  const RigidCut round(slot_with({0.0, 0.0}), steep_law());
  const WallMarks both = wall_marks(round, still, false);
  EXPECT_NEAR(both.share[0], 0.5, 0.01);
  EXPECT_NEAR(both.peak_to_valley, std::pow(50e-6, 2) / (8 * R), 2e-3 * 1e-7);
  const RigidCut cut(slot_with({13e-6, -13e-6}), steep_law());
  for (const bool exit : {false, true}) {
    for (const Shape shape : {Shape::sine, Shape::square}) {
      const WallMarks after = wall_marks(cut, table_motion(cut, shape, {}), exit);
      EXPECT_NEAR(after.share[0], 1.0, 1e-9);
      EXPECT_EQ(after.share[1], 0.0);
      EXPECT_NEAR(after.peak_to_valley, std::pow(100e-6, 2) / (8 * R), 5e-3 * 3.1e-7);
    }
  }
  // A runout as small as the marks themselves: the table moves the shorter one's aside.
  const RigidCut fine(slot_with({10e-9, -10e-9}), steep_law());
  const WallMarks before = wall_marks(fine, still, false);
  EXPECT_GT(before.share[1], 0.0);
  EXPECT_LT(before.share[1], 0.5);
  const PeriodicMotion cosine = Harmonics{0.0, {{5e-6, 0.0}}};
  const WallMarks moved = wall_marks(fine, cosine, false);
  EXPECT_GT(moved.peak_to_valley, before.peak_to_valley);
  // A table that stands 5 um ahead meets the tooth 5 um farther back.
  const WallMarks one =
      wall_marks(RigidCut(slot_with({0.0}), steep_law()), cosine, false);
  const auto top = std::max_element(one.depth.begin(), one.depth.end());
  EXPECT_NEAR(one.x[static_cast<std::size_t>(top - one.depth.begin())], 45e-6, 0.2e-6);
}

TEST(RigidCut, RefusesOtherCutters) {
  force::Setup setup = slot_with({0.0, 0.0});
  setup.cutter.profile = geometry::ball(8e-3);
  EXPECT_THROW(RigidCut(setup, steep_law()), std::invalid_argument);
}

TEST(RigidCut, RefusesWhatIsNoCut) {
  const force::Setup good = slot_with({0.0, 0.0});
  EXPECT_THROW(RigidCut(good, steep_law(), 0), std::invalid_argument);
  EXPECT_THROW(RigidCut(good, force::Power{.m_t = 1.0}), std::invalid_argument);
  force::Setup bad = good;
  bad.cut.f_z = -1e-6;
  EXPECT_THROW(RigidCut(bad, steep_law()), std::invalid_argument);
  bad = good;
  bad.cut.a_p = std::nan("");
  EXPECT_THROW(RigidCut(bad, steep_law()), std::invalid_argument);
  bad = good;
  bad.runout.radial_offsets[1] = std::nan("");
  EXPECT_THROW(RigidCut(bad, steep_law()), std::invalid_argument);
}

}  // namespace trochoid::correction::rigid_cut_test
