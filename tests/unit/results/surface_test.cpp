#include <trochoid/results/json.h>
#include <trochoid/results/surface.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace trochoid::results {
namespace {

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

}  // namespace
}  // namespace trochoid::results
