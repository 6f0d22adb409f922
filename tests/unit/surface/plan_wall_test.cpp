#include "made_readings.h"

#include <trochoid/surface/plan_cutting.h>
#include <trochoid/surface/plan_readings.h>

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace trochoid::surface::plan_wall_test {

constexpr double a_p = 3e-3;

WallTrial trial_of(Model model, double rho = 4e-6) {
  WallTrial trial{.setting = made_setting(model, with_runout(made_cut(), rho, 1.2))};
  trial.setting.law = law(800e6, 300e6);
  return trial;
}

WallPrediction told(const WallTrial& trial, const WallDesign& design) {
  const WallCatalogue catalogue(trial, heights_of(design, a_p), 0.0);
  return catalogue.predict(catalogue.readings_of(design));
}

TEST(WallDesign, HasHeightsSpreadOverTheMiddle) {
  const auto heights = heights_of({.heights = 3, .spread = 0.8}, 10.0);
  ASSERT_EQ(heights.size(), 3U);
  EXPECT_DOUBLE_EQ(heights[0], 1.0);
  EXPECT_DOUBLE_EQ(heights[1], 5.0);
  EXPECT_DOUBLE_EQ(heights[2], 9.0);
}

TEST(WallDesign, HasAsManyPlacesInEachToothFeed) {
  EXPECT_EQ(whole_places(1, 3), 3);
  EXPECT_EQ(whole_places(4, 3), 6);
  EXPECT_EQ(whole_places(7, 3), 12);  // four in each rather than three
  EXPECT_EQ(whole_places(12, 3), 12);
  EXPECT_EQ(whole_places(13, 3), 24);
}

TEST(WallCatalogue, LaysManyReadingsOverMoreTurns) {
  const WallDesign design{.heights = 2, .per_height = 24, .spread = 0.8};
  const WallCatalogue catalogue(trial_of(Model::envelope), heights_of(design, a_p),
                                5e-3);
  const PlannedReadings planned = catalogue.readings_of(design);
  ASSERT_EQ(planned.readings.size(), 48U);
  const double turn = 3 * 0.2e-3;
  EXPECT_NEAR(planned.readings[12].travel - planned.readings[0].travel, turn, 1e-12);
  EXPECT_EQ(planned.row[12], planned.row[0]);
  EXPECT_GT(planned.readings[0].travel, 5e-3);
  EXPECT_THROW((void)catalogue.readings_at(1.234e-3, 10), std::invalid_argument);
  EXPECT_EQ(catalogue.readings_at(heights_of(design, a_p)[0], 10).readings.size(), 10U);
}

TEST(WallPrediction, NarrowsWithTheRootOfTheReadings) {  // [E-60]
  const WallTrial trial = trial_of(Model::envelope);
  const WallPrediction few = told(trial, {.heights = 5, .per_height = 12});
  const WallPrediction many = told(trial, {.heights = 5, .per_height = 48});
  ASSERT_TRUE(few.told && many.told);
  EXPECT_NEAR(many.se_K_tc / few.se_K_tc, 0.5, 1e-6);
  EXPECT_NEAR(many.se_K_rc / few.se_K_rc, 0.5, 1e-6);
  EXPECT_NEAR(*many.se_eccentricity / *few.se_eccentricity, 0.5, 1e-6);
  EXPECT_LT(few.correlation, -0.9);
}

TEST(WallPrediction, WidensWithWhatIsUnknownOfTheForm) {  // [E-61]
  WallTrial trial = trial_of(Model::envelope);
  double before = 0.0;
  for (const PlannedForm form :
       {PlannedForm::none, PlannedForm::offset, PlannedForm::tilt}) {
    trial.form = form;
    const WallPrediction now = told(trial, {.heights = 9, .per_height = 12});
    ASSERT_TRUE(now.told);
    EXPECT_GT(now.se_K_tc, 1.2 * before);
    before = now.se_K_tc;
  }
}

TEST(WallPrediction, SaysWhatCannotBeTold) {
  const WallTrial trial = trial_of(Model::imprint);
  // Two heights for two coefficients and an offset.
  EXPECT_FALSE(told(trial, {.heights = 2, .per_height = 12}).told);
  EXPECT_TRUE(told(trial, {.heights = 3, .per_height = 12}).told);
  // As many readings as unknowns leave nothing for the noise.
  EXPECT_FALSE(told(trial, {.heights = 2, .per_height = 3}).told);
}

TEST(WallPrediction, OfOneToothHasNoRunout) {
  WallTrial trial = trial_of(Model::envelope);
  trial.setting.setup = made_cut(true, 1);
  const WallPrediction one = told(trial, {.heights = 9, .per_height = 12});
  EXPECT_TRUE(one.told);
  EXPECT_FALSE(one.se_eccentricity.has_value());
}

TEST(WallPrediction, WithoutRunoutHasNoAngle) {
  const WallPrediction none =
      told(trial_of(Model::envelope, 0.0), {.heights = 5, .per_height = 12});
  ASSERT_TRUE(none.told);
  EXPECT_TRUE(none.se_eccentricity.has_value());
  EXPECT_FALSE(none.se_angle.has_value());
}

TEST(WallPrediction, WithFeedbackTellsAboutTheSame) {
  WallTrial trial = trial_of(Model::envelope);
  trial.setting.law = law(200e6, 130e6);
  const WallDesign design{.heights = 5, .per_height = 12};
  trial.setting.model = Model::imprint;  // of means with and without
  const WallPrediction rigid = told(trial, design);
  trial.feedback = Feedback::entry;
  const WallPrediction bent = told(trial, design);
  ASSERT_TRUE(rigid.told && bent.told);
  EXPECT_NEAR(bent.se_K_tc / rigid.se_K_tc, 1.0, 0.15);
  EXPECT_NE(bent.se_K_tc, rigid.se_K_tc);
}

TEST(WallPrediction, TenMoreReadingsHelp) {
  const WallTrial trial = trial_of(Model::envelope);
  const WallDesign design{.heights = 5, .per_height = 12};
  const auto heights = heights_of(design, a_p);
  const WallCatalogue catalogue(trial, heights, 0.0);
  PlannedReadings all = catalogue.readings_of(design);
  const WallPrediction before = catalogue.predict(all);
  const PlannedReadings more = catalogue.readings_at(heights[0], 10);
  all.readings.insert(all.readings.end(), more.readings.begin(), more.readings.end());
  all.row.insert(all.row.end(), more.row.begin(), more.row.end());
  EXPECT_LT(catalogue.predict(all).se_K_tc, before.se_K_tc);
}

TEST(ErrorGrid, RemovesWhatTheStockHas) {  // [E-62]
  MadeCut cut = made_cut();
  // 3 mm x 1 mm x 3 teeth x 0.2 mm, 100 rad/s
  EXPECT_NEAR(removal_rate(cut), 1.8e-9 * 100 / (2 * pi), 1e-18);
  EXPECT_NEAR(removal_rate(with_radial_depth(cut, 2e-3)), 3.6e-9 * 100 / (2 * pi),
              1e-18);
  cut.cut.engagement = geometry::Slot{};
  EXPECT_THROW((void)removal_rate(cut), std::invalid_argument);
}

TEST(ErrorGrid, StaysOnTheSideOfTheWall) {
  const auto up = with_radial_depth(made_cut(false), 2e-3);
  EXPECT_TRUE(std::holds_alternative<geometry::UpMilling>(up.cut.engagement));
}

TEST(ErrorGrid, GrowsWithTheFeed) {
  Setting s = made_setting(Model::envelope);
  s.law = law(800e6, 300e6);
  const std::vector<double> feeds = {0.05e-3, 0.1e-3, 0.2e-3};
  const std::vector<double> depths = {0.25e-3, 0.5e-3};
  const auto cells = error_grid(
      s, {.samples_per_turn = 36, .heights = {0.0, 1.5e-3, a_p}}, feeds, depths);
  ASSERT_EQ(cells.size(), 6U);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    ASSERT_TRUE(cells[i].ok);
    EXPECT_EQ(cells[i].f_z, feeds[i % 3]);
    EXPECT_EQ(cells[i].a_e, depths[i / 3]);
    if (i % 3 > 0) {
      EXPECT_GT(cells[i].peak, cells[i - 1].peak);
    }
  }
}

TEST(ErrorGrid, FindsFeedbackAtSomeCellsAndBetweenThem) {
  Setting s = made_setting(Model::imprint);
  s.law = law(800e6, 300e6);
  s.tolerance = 1e-4;
  MapOptions samples{.samples_per_turn = 36, .heights = {0.0, a_p}};
  std::vector<double> feeds;
  for (int i = 0; i < 7; ++i) feeds.push_back(0.05e-3 + 0.02e-3 * i);
  const std::vector<double> depths = {0.3e-3, 0.5e-3};
  const auto rigid = error_grid(s, samples, feeds, depths);
  samples.feedback = Feedback::entry;
  const auto bent = error_grid(s, samples, feeds, depths);
  for (const std::size_t i : {std::size_t{0}, std::size_t{5}, std::size_t{13}}) {
    const GridCell alone =
        error_grid(s, samples, {&bent[i].f_z, 1}, {&bent[i].a_e, 1}).front();
    EXPECT_TRUE(bent[i].ok);
    EXPECT_NEAR(bent[i].peak, alone.peak, 2e-2 * std::abs(alone.peak - rigid[i].peak));
    EXPECT_GT(std::abs(alone.peak - rigid[i].peak), 1e-3 * rigid[i].peak) << i;
  }
}

TEST(FeedLimits, LieBetweenCells) {
  const std::vector<GridCell> cells = {
      {.f_z = 1.0, .ok = true, .peak = 10.0}, {.f_z = 2.0, .ok = true, .peak = 20.0},
      {.f_z = 1.0, .ok = true, .peak = 16.0}, {.f_z = 2.0, .ok = true, .peak = 20.0},
      {.f_z = 1.0, .ok = true, .peak = 10.0}, {.f_z = 2.0, .ok = false, .peak = 0.0},
      {.f_z = 1.0, .ok = true, .peak = 10.0}, {.f_z = 2.0, .ok = true, .peak = 11.0}};
  const auto limits =
      feed_limits(cells, 2, 15.0, [](const GridCell& c) { return c.peak; });
  ASSERT_EQ(limits.size(), 4U);
  EXPECT_DOUBLE_EQ(*limits[0], 1.5);
  EXPECT_FALSE(limits[1].has_value());
  EXPECT_DOUBLE_EQ(*limits[2], 1.0);  // nothing is known beyond
  EXPECT_DOUBLE_EQ(*limits[3], 2.0);
}

TEST(ThinnestWall, JustKeepsTheLimit) {  // [E-63]
  const auto error = [](double t) { return 10.0 + 8.0 / (t * t * t); };
  const ThinnestWall found = thinnest_wall(0.1, 10.0, 18.0, error);
  ASSERT_TRUE(found.thickness.has_value());
  EXPECT_NEAR(*found.thickness, 1.0, 3e-3);
  EXPECT_LE(found.error, 18.0);
  EXPECT_FALSE(found.thinner_too);
  EXPECT_TRUE(thinnest_wall(0.1, 10.0, 1e5, error).thinner_too);
  const ThinnestWall none = thinnest_wall(0.1, 10.0, 9.0, error);
  EXPECT_FALSE(none.thickness.has_value());
  EXPECT_NEAR(none.error, 10.0, 0.01);
}

TEST(ThinnestWall, TakesNoAnswerForTooMuch) {
  const double infinite = std::numeric_limits<double>::infinity();
  const auto error = [&](double t) { return t < 2.0 ? infinite : 1.0; };
  EXPECT_NEAR(*thinnest_wall(0.1, 10.0, 5.0, error).thickness, 2.0, 1e-2);
}

TEST(WallDesigns, AreEachThereOnceTheFewestReadingsFirst) {
  const std::vector<double> spreads{0.8};
  const std::vector<double> heights{9, 3};
  const std::vector<double> places{11, 12};  // both are 12 with three teeth
  const auto designs = wall_designs(spreads, heights, places, 3);
  ASSERT_EQ(designs.size(), 2U);
  EXPECT_EQ(designs[0].heights, 3);
  EXPECT_EQ(designs[1].heights, 9);
  EXPECT_EQ(designs[1].per_height, 12);
}

TEST(ReadingsPlan, TakesTheFirstThatIsEnoughElseTheBest) {
  const WallTrial trial = trial_of(Model::envelope);
  const std::vector<WallDesign> designs{{.heights = 3, .per_height = 12},
                                        {.heights = 9, .per_height = 12},
                                        {.heights = 9, .per_height = 48}};
  const auto chosen = [&](double coefficients) {
    const WantedWidths wanted{coefficients, 1.0};
    const ReadingsPlan plan = plan_readings(trial, designs, wanted, {}, 0.0);
    EXPECT_EQ(plan.designs[*plan.chosen].enough, plan.shortfall <= 1.0);
    EXPECT_FALSE(plan.so_far.has_value());
    EXPECT_FALSE(plan.more.empty());
    return *plan.chosen;
  };
  EXPECT_EQ(chosen(1e6), 0U);
  EXPECT_EQ(chosen(1e-6), 2U);
}

TEST(PlannedCutting, NamesTheCutThatRemovesMostWithinTheLimit) {
  const WallTrial trial = trial_of(Model::envelope, 0.0);
  const double f_z = trial.setting.setup.cut.f_z;
  const CuttingRequest all{.feeds = {0.5 * f_z, f_z}, .radial_depths = {0.5e-3, 1e-3}};
  const PlannedCutting map = plan_cutting(trial.setting, {}, all);
  ASSERT_EQ(map.cells.size(), 4U);
  EXPECT_FALSE(map.best.has_value());
  CuttingRequest limited = all;
  limited.limit = 1.0;  // [m]: whatever the cut
  const PlannedCutting free = plan_cutting(trial.setting, {}, limited);
  EXPECT_EQ(free.best, 3U);
  EXPECT_FALSE(free.thinnest.has_value());  // there is no wall to make thinner
  limited.limit = 1.01 * map.cells[0].peak;
  const PlannedCutting tight = plan_cutting(trial.setting, {}, limited);
  ASSERT_TRUE(tight.best.has_value());
  EXPECT_LE(tight.cells[*tight.best].peak, *limited.limit);
}

}  // namespace trochoid::surface::plan_wall_test
