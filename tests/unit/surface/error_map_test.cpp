#include "made_wall.h"

#include <trochoid/surface/error_map.h>
#include <trochoid/surface/nominal_model.h>

#include <gtest/gtest.h>

#include <stdexcept>

namespace trochoid::surface::error_map_test {

constexpr Coefficients K = {800e6, 300e6, 9e3, 4e3};

Setting cutting(Model model, const MadeCut& cut = with_runout(made_cut(), 5e-6, 1.2),
                BodiesAt bodies = cutter_only()) {
  Setting s = made_setting(model, cut, std::move(bodies));
  s.law = law(K[0], K[1], K[2], K[3]);
  return s;
}

TEST(ErrorMap, AnEnvelopeIsThatOfEveryHeight) {  // [E-9]
  const Setting s = cutting(Model::envelope);
  const ErrorMap map =
      error_map(s, {.samples_per_turn = 30, .turns = 2, .heights = {0.4e-3, 2e-3}});
  ASSERT_TRUE(map.converged);
  ASSERT_EQ(map.rows.size(), 2U);
  for (const ErrorRow& row : map.rows) {
    const HeightCut cut = height_cut(s, K, row.height);
    ASSERT_EQ(row.x.size(), 60U);
    for (std::size_t i = 0; i < row.x.size(); ++i) {
      EXPECT_NEAR(row.x[i], cut.feed * static_cast<double>(i) / 30, 1e-12);
      const SurfacePoint point = envelope_error(cut, row.x[i]);
      EXPECT_NEAR(row.error[i], point.error, 1e-10);
      EXPECT_EQ(row.tooth[i], point.tooth);
    }
    ASSERT_TRUE(row.waves);
    EXPECT_GT(row.waves->once_per_turn, 1e-6);
    EXPECT_FALSE(row.per_K);
  }
  const auto& [low, high] = std::tie(map.rows[0].statistics, map.rows[1].statistics);
  EXPECT_DOUBLE_EQ(map.error.mean, (low.error.mean + high.error.mean) / 2);
  EXPECT_EQ(map.error.max, std::max(low.error.max, high.error.max));
}

TEST(ErrorMap, ImprintsAreOneATooth) {  // [E-8]
  const Setting s = cutting(Model::imprint);
  const ErrorMap map = error_map(s, {.turns = 2, .heights = {1.1e-3}});
  const auto points = imprint_errors(height_cut(s, K, 1.1e-3));
  const ErrorRow& row = map.rows.front();
  ASSERT_EQ(row.error.size(), 2 * points.size());
  for (std::size_t i = 0; i < row.error.size(); ++i) {
    EXPECT_NEAR(row.error[i], points[i % points.size()].error, 1e-10);
  }
  EXPECT_FALSE(row.waves);
  ASSERT_TRUE(row.per_K);
  // Without runout and edge forces the error is what the coefficients make of it.
  const std::vector<Nominal> here = {{.height = 1.1e-3, .readings = {0}}};
  const auto rigid = NominalModel(s, here).rigid(Coefficients{K[0], K[1], 0, 0});
  EXPECT_NEAR((*row.per_K)[0] * K[0] + (*row.per_K)[1] * K[1], rigid.error[0], 1e-10);
}

TEST(ErrorMap, APulseGoesWithTheSpindle) {  // [E-7]
  Setting s = cutting(Model::quasi_static);
  s.phase = 2.2;
  const ErrorMap map = error_map(s, {.samples_per_turn = 24, .heights = {0.5e-3}});
  const HeightCut cut = height_cut(s, K, 0.5e-3);
  const auto tips = edge_places(s.setup, 0.0);
  for (std::size_t i = 0; i < 24; ++i) {
    const double phi = s.phase + 2 * pi * static_cast<double>(i) / 24;
    const std::size_t tooth = last_entered(tips, entry_angle(s.setup), phi);
    EXPECT_NEAR(map.rows[0].error[i], quasi_static_error(cut, tooth, phi).error, 1e-10);
  }
}

TEST(ErrorMap, ForcesAreThoseOfTheMomentsAtTheAnglesAskedFor) {  // [E-3]
  for (const bool down : {true, false}) {
    const Setting s = cutting(Model::envelope, made_cut(down));
    const ErrorMap map =
        error_map(s, {.angles = {0.2, 2.9, 5.0}, .heights = {1e-3}, .position = 7e-3});
    ASSERT_EQ(map.forces.size(), 3U);
    const double sigma = down ? 1.0 : -1.0;
    for (const ForceSample& force : map.forces) {
      const double F_y =
          weighted_force(s.setup, K, force.phi, [](double) { return 1.0; });
      EXPECT_NEAR(force.F_y, F_y, 1e-3);
      EXPECT_EQ(force.F_normal, sigma * force.F_y);
      EXPECT_NEAR(force.x, 7e-3 + 0.6e-3 * force.phi / (2 * pi), 1e-12);
    }
    EXPECT_EQ(map.F_normal.max,
              std::max({map.forces[0].F_normal, map.forces[1].F_normal,
                        map.forces[2].F_normal}));
    EXPECT_EQ(map.rows[0].deflection.size(), 3U);
  }
}

TEST(ErrorMap, AProbeReadsMoreOfALeaningWall) {  // [E-13] [E-14]
  Setting s = cutting(Model::envelope, made_cut());
  const MapOptions options{.samples_per_turn = 60, .heights = {0.5e-3, 1.5e-3, 2.5e-3}};
  const ErrorMap point = error_map(s, options);
  s.probe_radius = 0.5e-3;
  const ErrorMap ball = error_map(s, options);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GT(ball.rows[i].statistics.error.mean, point.rows[i].statistics.error.mean);
    EXPECT_GT(ball.rows[i].statistics.error.max, point.rows[i].statistics.error.max);
  }
}

TEST(ErrorMap, InfluenceIsThatOfTheBodies) {
  const Setting s = cutting(Model::imprint, made_cut(), with_wall());
  const std::vector<double> at = {0.0, 1e-3};
  const ErrorMap map =
      error_map(s, {.heights = {0.5e-3}, .influence_heights = at, .position = 30e-3});
  const Compliance compliance(s.bodies(30e-3), 3e-3, 30e-3, s.load);
  EXPECT_EQ(map.influence_of_cutter, compliance.of_cutter(at, at));
  EXPECT_EQ(map.influence_of_wall, compliance.of_wall(at, at));
  const std::array height = {0.5e-3};
  const Compliance whole(s.bodies(30e-3), 3e-3, 30e-3, Load::concentrated);
  EXPECT_EQ(map.rows[0].compliance, whole.rows(height).front());
}

TEST(ErrorMap, WithoutASteadyStateThereIsNoMap) {  // [E-10]
  Bodies soft = cutter_only()(0.0);
  soft.cutter->youngs_modulus /= 1000;
  const Setting s =
      cutting(Model::envelope, made_cut(), [soft](double) { return soft; });
  int solved = 0;
  const ErrorMap map = error_map(s, {.feedback = Feedback::entry}, [&] { ++solved; });
  EXPECT_FALSE(map.converged);
  EXPECT_FALSE(map.found);
  EXPECT_TRUE(map.rows.empty());
  EXPECT_EQ(solved, 1);
}

TEST(ErrorMap, BySteadyStatesOfEqualStepsIsTheSame) {  // [E-10]
  const Setting setting = cutting(Model::envelope);
  MapOptions options{.samples_per_turn = 36,
                     .heights = {0.3e-3, 1.5e-3, 2.7e-3},
                     .position = 30e-3,
                     .feedback = Feedback::regenerative};
  const ErrorMap exact = error_map(setting, options);
  options.stepwise = true;
  const ErrorMap steps = error_map(setting, options);
  ASSERT_TRUE(exact.converged && steps.converged);
  EXPECT_GT(exact.turns, 1);
  EXPECT_EQ(steps.turns, 1);  // another way
  const double size = std::max(std::abs(exact.error.max), std::abs(exact.error.min));
  EXPECT_NEAR(steps.error.max, exact.error.max, 0.01 * size);
  EXPECT_NEAR(steps.error.min, exact.error.min, 0.01 * size);
  EXPECT_NEAR(steps.error.mean, exact.error.mean, 0.005 * size);
}

TEST(ErrorMap, HeightsAreSpreadOverTheAxialDepthUnlessNamed) {
  const ErrorMap map = error_map(cutting(Model::imprint));
  ASSERT_EQ(map.rows.size(), 21U);
  EXPECT_EQ(map.rows.front().height, 0.0);
  EXPECT_NEAR(map.rows[1].height, 0.15e-3, 1e-15);
  EXPECT_NEAR(map.rows.back().height, 3e-3, 1e-15);
  EXPECT_EQ(map.influence_heights.size(), 21U);
}

TEST(ErrorMap, TheHighestHeightIsStillOnTheWall) {
  // 20 steps of a twentieth are a bit more than these.
  for (const double a_p : {3.5e-3, 3.7e-3, 7e-3}) {
    MadeCut cut = made_cut();
    cut.cut.a_p = a_p;
    const auto wall_only = [](double x) { return Bodies{.wall = with_wall()(x).wall}; };
    const ErrorMap map =
        error_map(cutting(Model::imprint, cut, wall_only), {.position = 20e-3});
    EXPECT_EQ(map.rows.back().height, a_p);
    EXPECT_GT(map.influence_of_wall.back(), map.influence_of_wall.front());
    const DeflectedShape& shape = *map.shape;
    EXPECT_EQ(shape.heights.back(), a_p);
    EXPECT_NE(shape.wall.back(), 0.0);
  }
}

TEST(ErrorMap, ASlotHasNoSingleWall) {
  MadeCut slot = made_cut();
  slot.cut.engagement = geometry::Slot{};
  EXPECT_THROW(static_cast<void>(error_map(cutting(Model::envelope, slot))),
               std::invalid_argument);
}

}  // namespace trochoid::surface::error_map_test
