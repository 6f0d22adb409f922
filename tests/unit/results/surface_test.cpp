#include <trochoid/results/json.h>
#include <trochoid/results/surface.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace trochoid::results::surface_test {

/// Two teeth, two heights, two places, one angle of the force.
SurfaceResult made() {
  SurfaceResult r{.diameter = 12e-3,
                  .a_p = 3e-3,
                  .wall = structure::Plate{60e-3, 30e-3, 2e-3, 69e9, 0.33}};
  r.heading.message = "The error of the wall.";
  for (const double height : {0.5e-3, 2.5e-3}) {
    surface::ErrorRow row{.height = height,
                          .x = {0.0, 0.1e-3},
                          .error = {1e-6, 3e-6},
                          .tooth = {1, 0},
                          .deflection = {4e-6},
                          .compliance = 2e-6};
    row.statistics = surface::error_statistics(row.error, row.tooth, 2);
    r.map.rows.push_back(row);
  }
  r.map.rows[0].waves = {0.5e-6, 0.25e-6};
  r.map.rows[1].per_K = {2e-15, -1e-15};
  r.map.error = {2e-6, 1e-6, 3e-6};
  r.map.forces = {{.phi = 1.0, .x = 0.0, .F_x = -3.0, .F_y = -7.0, .F_normal = 7.0}};
  r.map.F_normal = {7.0, 7.0, 7.0};
  r.map.F_x = {-3.0, -3.0, -3.0};
  r.map.shape = surface::DeflectedShape{.phi = 1.0,
                                        .F_normal = 7.0,
                                        .heights = {-27e-3, 3e-3},
                                        .cutter = {0.0, 0.0},
                                        .wall = {0.0, 4e-6}};
  r.map.influence_heights = {0.5e-3};
  r.map.influence_of_cutter = {0.0};
  r.map.influence_of_wall = {2e-6};
  return r;
}

const base::Table& table_of(const Answer& answer, const std::string& file) {
  return *std::find_if(answer.tables.begin(), answer.tables.end(),
                       [&](const base::Table& t) { return t.file == file; });
}

using Columns = std::vector<std::pair<std::string, std::vector<double>>>;

Columns columns_of(const Answer& answer, const std::string& file) {
  Columns columns;
  for (const base::Table::Column& column : table_of(answer, file).columns) {
    columns.emplace_back(column.name, column.values);
  }
  return columns;
}

TEST(SurfaceAnswer, ColumnsCarryTheirNamesAndUnits) {
  const Answer answer = answer_of(made());
  const Columns surface = columns_of(answer, "surface.csv");
  ASSERT_EQ(surface.size(), 4U);
  EXPECT_EQ(surface[0].first, "x_mm");
  EXPECT_EQ(surface[0].second, (std::vector<double>{0, 0.1, 0, 0.1}));
  EXPECT_EQ(surface[1].first, "height_mm");
  EXPECT_EQ(surface[1].second, (std::vector<double>{0.5, 0.5, 2.5, 2.5}));
  EXPECT_EQ(surface[2].first, "error_mm");
  EXPECT_NEAR(surface[2].second[1], 3e-3, 1e-15);
  EXPECT_EQ(surface[3], (Columns::value_type{"tooth", {2, 1, 2, 1}}));
  const Columns forces = columns_of(answer, "forces.csv");
  ASSERT_EQ(forces.size(), 5U);
  EXPECT_EQ(forces[2], (Columns::value_type{"F_normal_N", {7}}));
  EXPECT_EQ(forces[3], (Columns::value_type{"Fx_N", {-3}}));
  EXPECT_EQ(forces[4], (Columns::value_type{"Fy_N", {-7}}));
  EXPECT_EQ(columns_of(answer, "deflection.csv")[1],
            (Columns::value_type{"height_mm", {0.5, 2.5}}));
  const Columns bent = columns_of(answer, "bent.csv");
  ASSERT_EQ(bent.size(), 3U);
  EXPECT_EQ(bent[0], (Columns::value_type{"height_mm", {-27, 3}}));
  EXPECT_EQ(bent[2].first, "wall_mm");
  EXPECT_NEAR(bent[2].second[1], 4e-3, 1e-15);
  EXPECT_EQ(columns_of(answer, "influence.csv").size(), 4U);
}

TEST(SurfaceAnswer, TellsOfAHeightWhatIsKnownOfIt) {
  const Answer answer = answer_of(made());
  const auto& heights = std::get<Array>(find(answer.result, "heights")->data);
  ASSERT_EQ(heights.size(), 2U);
  EXPECT_EQ(json_text(*find(heights[0], "share")), "[0.5, 0.5]");
  EXPECT_NE(find(heights[0], "once_per_turn_um"), nullptr);
  EXPECT_EQ(find(heights[0], "operator"), nullptr);
  EXPECT_EQ(find(heights[1], "once_per_turn_um"), nullptr);
  EXPECT_NE(find(heights[1], "operator"), nullptr);
}

TEST(SurfaceAnswer, ARigidBodyIsNullAndSaidSo) {
  const Answer answer = answer_of(made());
  const Value& bent = *find(answer.result, "bent");
  EXPECT_EQ(json_text(*find(bent, "cutter")), "null");
  EXPECT_EQ(json_text(*find(*find(bent, "wall"), "thickness_mm")), "2");
  EXPECT_NE(answer.short_table.find("um/N (rigid cutter)\n"), std::string::npos);
  EXPECT_EQ(answer.short_table.find("rigid wall"), std::string::npos);
  EXPECT_NE(answer.short_table.find("7.00 N mean"), std::string::npos);
}

TEST(SurfaceAnswer, WithoutASteadyStateIsItsModelAlone) {
  SurfaceResult r = made();
  r.map = {.feedback = surface::Feedback::entry, .converged = false};
  const Answer answer = answer_of(r);
  EXPECT_EQ(json_text(answer.result),
            "{\n  \"model\": \"envelope\",\n  \"feedback\": \"entry\"\n}");
  EXPECT_TRUE(answer.tables.empty());
  EXPECT_TRUE(answer.short_table.empty());
}

TEST(SurfaceAnswer, TellsOfEachPass) {
  SurfaceResult r = made();
  for (const double a_e : {1e-3, 0.0}) {
    r.passes.push_back({.cut = {a_e, 0.1e-3},
                        .thickness_before = 2e-3,
                        .thickness_after = 1.01e-3,
                        .radial_depth = {a_e, a_e - 1e-6, a_e + 2e-6},
                        .error = {10e-6, 5e-6, 20e-6},
                        .F_normal = {3, -1, 9}});
  }
  const Answer answer = answer_of(r);
  const auto& passes = std::get<Array>(find(answer.result, "passes")->data);
  ASSERT_EQ(passes.size(), 2U);
  EXPECT_EQ(json_text(*find(passes[0], "radial_depth_mm")), "1");
  EXPECT_EQ(json_text(*find(passes[0], "F_normal_max_N")), "9");
  EXPECT_EQ(json_text(*find(passes[0], "thickness_before_mm")), "2");
  const Columns columns = columns_of(answer, "passes.csv");
  ASSERT_EQ(columns.size(), 14U);
  EXPECT_EQ(columns[0], (Columns::value_type{"pass", {1, 2}}));
  EXPECT_EQ(columns[1], (Columns::value_type{"radial_depth_mm", {1, 0}}));
  EXPECT_EQ(columns[13].first, "thickness_left_mm");
  EXPECT_NEAR(columns[13].second[1], 1.01, 1e-12);
  EXPECT_NE(answer.short_table.find("thickness mm"), std::string::npos);
  r.wall.reset();
  const Answer rigid = answer_of(r);
  EXPECT_EQ(columns_of(rigid, "passes.csv").size(), 12U);
  const auto& all = std::get<Array>(find(rigid.result, "passes")->data);
  EXPECT_EQ(json_text(*find(all[1], "thickness_left_mm")), "null");
}

TEST(SurfaceAnswer, TellsWhatOtherForcesChange) {
  SurfaceResult r = made();
  r.also_bends = {surface::AlsoBends::x, surface::AlsoBends::z};
  r.straight = surface::MeanAndExtremes{1.5e-6, 1e-6, 2e-6};
  const Answer answer = answer_of(r);
  const Value& bends = *find(answer.result, "also_bends");
  EXPECT_EQ(json_text(*find(bends, "axes")), "[\"x\", \"z\"]");
  EXPECT_EQ(json_text(*find(bends, "peak_error_without_mm")), "0.002");
  EXPECT_NEAR(std::get<double>(find(bends, "mean_change_um")->data), 0.5, 1e-9);
  EXPECT_NE(answer.short_table.find("forces along x and z change the mean error by "
                                    "+0.500 um, the largest by +1.000 um\n"),
            std::string::npos);
}

TEST(SurfaceAnswer, TellsOfLoadsInTheirUnits) {
  SurfaceResult r = made();
  r.loads = structure::LoadedWalls{
      .x = {0.0, 30e-3},
      .y = {30e-3},
      .walls = {
          {structure::WallLoad::pressure, 2e3, {0.0, 4e-6}, 4e-6, 30e-3, 30e-3, 3e-3},
          {structure::WallLoad::edge_load, 5e2, {0.0, 6e-6}, 6e-6, 30e-3, 30e-3, 0.2}}};
  const Answer answer = answer_of(r);
  const Value& loads = *find(answer.result, "wall_loads");
  EXPECT_EQ(json_text(*find(*find(loads, "pressure"), "pressure_kPa")), "2");
  EXPECT_EQ(json_text(*find(*find(loads, "edge_load"), "edge_load_N_per_mm")), "0.5");
  EXPECT_EQ(json_text(*find(*find(loads, "edge_load"), "coefficient")), "0.2");
  const Columns columns = columns_of(answer, "wall_loads.csv");
  ASSERT_EQ(columns.size(), 4U);
  EXPECT_EQ(columns[0], (Columns::value_type{"x_mm", {0, 30}}));
  EXPECT_EQ(columns[1], (Columns::value_type{"wall_height_mm", {30, 30}}));
  EXPECT_EQ(columns[3].first, "edge_load_deflection_mm");
  EXPECT_NEAR(columns[3].second[1], 6e-3, 1e-15);
  EXPECT_EQ(find(answer_of(made()).result, "wall_loads"), nullptr);
}

}  // namespace trochoid::results::surface_test
