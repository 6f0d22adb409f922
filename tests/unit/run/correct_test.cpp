#include <trochoid/results/json.h>
#include <trochoid/run/correct.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace trochoid::run {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path example = fs::path(TROCHOID_SOURCE_DIR) / "examples/runout_correction";

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The example with some of its text replaced.
struct Changes {
  std::vector<std::pair<std::string, std::string>> all;
};

results::Answer answer_of(const std::string& name, const Changes& changes,
                          bool controller = false, const char* file = "case.toml") {
  std::string text = text_of(example / file);
  for (const auto& [from, to] : changes.all) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }
  const fs::path path =
      fs::path(testing::TempDir()) / ("trochoid_correct_" + name + ".toml");
  std::ofstream(path) << text;
  return correct(inputs::read_case(path, inputs::Command::correct), controller, {});
}

const base::Table& table_of(const results::Answer& answer, const std::string& file) {
  return *std::find_if(answer.tables.begin(), answer.tables.end(),
                       [&](const base::Table& t) { return t.file == file; });
}

bool warned(const results::Answer& answer, const std::string& code) {
  return std::any_of(answer.heading.warnings.begin(), answer.heading.warnings.end(),
                     [&](const base::Warning& w) { return w.code == code; });
}

/// [diez2010]: 38 % before, 30 um for an estimated 26 um, near equal after, the table
/// within 10 %; at least 86 % less is what a correction of it has to reach.
TEST(Correct, ReproducesTheCaseOfThePaper) {
  const results::Answer answer = answer_of("paper", {});
  ASSERT_TRUE(answer.heading.ok) << answer.heading.message;
  const Json r = Json::parse(results::json_text(answer.result));
  EXPECT_NEAR(r["before"]["difference"], 0.388, 0.002);
  EXPECT_LT(r["after"]["difference"], 0.002);
  EXPECT_GT(r["reduction"], 0.86);
  EXPECT_NEAR(r["runout"]["chip_difference_um"][0], 27.8, 1e-9);
  EXPECT_NEAR(r["runout"]["static_fit"]["chip_difference_um"][0]["value"], 26.0, 0.5);
  EXPECT_NEAR(r["command"]["peak_to_peak_um"], 30.2, 0.3);
  EXPECT_LT(r["command"]["table_deviation_um"], 0.1 * 30.3);
  EXPECT_TRUE(r["command"]["within_limits"]);
  // Equal peaks are not equal chips, and the answer says so.
  EXPECT_GT(r["after"]["area_difference"], 0.3);
  EXPECT_TRUE(warned(answer, "unequal_chips"));
  // The wall is the longer flute's, with the command as without: f^2/(8 R) deep.
  for (const char* when : {"before", "after"}) {
    const Json& wall = r[when]["walls"].at(1);
    EXPECT_NEAR(wall["peak_to_valley_um"], 1e3 * 0.1 * 0.1 / (8 * 4), 0.005);
    EXPECT_NEAR(wall["share"][0], 1.0, 1e-6);
  }
}

TEST(Correct, CommandStaysInTheStrokeAboutItsMiddle) {
  const results::Answer answer = answer_of("stroke", {});
  const base::Table& command = table_of(answer, "command.csv");
  ASSERT_EQ(command.columns.at(1).name, "command_um");
  const auto& values = command.columns[1].values;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  EXPECT_EQ(values.size(), 720U);
  EXPECT_NEAR((*low + *high) / 2, 30.0, 0.01);
  EXPECT_GE(*low, 0.0);
  EXPECT_LE(*high, 60.0);
  const std::string& header = answer.texts.at(0).text;
  EXPECT_NE(header.find("trochoid_command_um[TROCHOID_COMMAND_POINTS]"),
            std::string::npos);
}

TEST(Correct, FindsRunoutBehindWhatGivesWay) {
  Changes here;
  here.all = {{"record.csv", (example / "record.csv").string()}};
  const results::Answer answer = answer_of("record", here, false, "measured.toml");
  ASSERT_TRUE(answer.heading.ok) << answer.heading.message;
  const Json r = Json::parse(results::json_text(answer.result))["runout"];
  EXPECT_NEAR(r["chip_difference_um"][0], 27.8, 0.4);
  EXPECT_LT(r["static_fit"]["chip_difference_um"][0]["value"], 26.5);
}

TEST(Correct, CommandForARigidReadingLeavesWhatGivesWay) {
  const results::Answer answer =
      answer_of("static", {{{"[correct]", "[correct]\nestimate = \"static_fit\""}}});
  const Json r = Json::parse(results::json_text(answer.result));
  EXPECT_GT(r["after"]["difference"], 0.02);
  EXPECT_GT(r["reduction"], 0.86);
  EXPECT_TRUE(warned(answer, "static_estimate"));
}

TEST(Correct, ShapesAndStrategiesMakePeaksEqual) {
  using Pair = std::pair<std::string, std::string>;
  for (const auto& [shape, strategy] :
       {Pair{"sine", "plain"}, Pair{"square", "lead"}, Pair{"trapezoid", "inverse"},
        Pair{"quintic", "inverse_in_time"}, Pair{"harmonics", "learning"}}) {
    SCOPED_TRACE(shape + " " + strategy);
    const results::Answer answer = answer_of(
        "all", {{{"shape = \"sine\"", "shape = \"" + shape + "\""},
                 {"strategy = \"lead\"",
                  "strategy = \"" + strategy + "\"\nspindle_rpm = [1000, 2000, 2]"}}});
    ASSERT_TRUE(answer.heading.ok) << answer.heading.message;
    EXPECT_LT(Json::parse(results::json_text(answer.result))["after"]["difference"],
              0.005);
  }
}

TEST(Correct, SaysWhatIsBeyondALimit) {
  const results::Answer answer =
      answer_of("limits", {{{"stroke_um = [0, 60]", "stroke_um = [0, 20]"},
                            {"push_N = 2000", "push_N = 10"}}});
  ASSERT_TRUE(answer.heading.ok);
  const Json command = Json::parse(results::json_text(answer.result))["command"];
  EXPECT_FALSE(command["within_limits"]);
  EXPECT_LT(command["stroke_margin_um"], 0);
  EXPECT_TRUE(warned(answer, "beyond_limit"));
}

/// A tool that chatters has no peaks to make equal.
TEST(Correct, RefusesACutThatChatters) {
  std::string soft = "stiffness_N_per_m = 8e6";
  const results::Answer answer =
      answer_of("chatter", {{{soft, "stiffness_N_per_m = 5e5"},
                             {soft, "stiffness_N_per_m = 5e5"},
                             {"axial_depth_mm = 1", "axial_depth_mm = 3"}}});
  EXPECT_FALSE(answer.heading.ok);
  EXPECT_NE(answer.heading.message.find("chatter"), std::string::npos)
      << answer.heading.message;
}

/// Four teeth in a slot: two cut at once, one axis cannot serve both.
TEST(Correct, SaysWhatOneAxisCannotDo) {
  const results::Answer answer =
      answer_of("four", {{{"teeth = 2", "teeth = 4"},
                          {"[0.0139, -0.0139]", "[0.010, -0.004, 0.003, -0.009]"},
                          {"strategy = \"lead\"", "strategy = \"inverse\""},
                          {"target = \"peak_force\"", "target = \"least_squares\""},
                          {"axial_depth_mm = 1", "axial_depth_mm = 0.2"},
                          {"adapt = true", "adapt = false"}}});
  ASSERT_TRUE(answer.heading.ok) << answer.heading.message;
  const Json axes = Json::parse(results::json_text(answer.result))["axes"];
  EXPECT_EQ(axes["most_teeth_in_cut"], 2);
  EXPECT_LT(axes["two_axes_um"], axes["one_axis_um"]);
  EXPECT_LT(axes["one_axis_um"], axes["uncorrected_um"]);
  EXPECT_TRUE(warned(answer, "several_teeth_in_cut"));
}

TEST(CorrectController, LearnsTheAmplitudeInFiveTurns) {
  const results::Answer answer = answer_of("adapt", {}, true);
  ASSERT_TRUE(answer.heading.ok) << answer.heading.message;
  const Json c = Json::parse(results::json_text(answer.result))["controller"];
  EXPECT_GT(c["difference_before"], 0.38);
  EXPECT_LT(c["difference_running"], 0.01);
  EXPECT_LE(c["turns_to_3_percent"], 5);
  EXPECT_GE(c["lowest_um"], 0.0);
  EXPECT_LE(c["highest_um"], 60.0);
  EXPECT_TRUE(c["fault"].is_null());
}

TEST(CorrectController, GoesToMidStrokeWithoutIndexPulses) {
  const results::Answer answer =
      answer_of("lost",
                {{{"adapt = true",
                   "index_lost_at_turn = 25\njitter_s = 1e-4\nspeed_ripple = 0.02"}}},
                true);
  const Json c = Json::parse(results::json_text(answer.result))["controller"];
  EXPECT_EQ(c["fault"], "no index pulse");
  EXPECT_LT(c["difference_running"], 0.03);
  ASSERT_TRUE(c["time_to_safe_s"].is_number());
  EXPECT_LT(c["time_to_safe_s"], 0.2);
  const base::Table& samples = table_of(answer, "controller.csv");
  EXPECT_NEAR(samples.columns.at(1).values.back(), 30.0, 1e-6);
  EXPECT_GT(c["turns"].back()["difference"], 0.3) << "no correction, no equal peaks";
}

TEST(CorrectController, RefusesWhatItCannotLearn) {
  const results::Answer answer =
      answer_of("three",
                {{{"teeth = 2", "teeth = 3"},
                  {"axial_depth_mm = 1", "axial_depth_mm = 0.2"},
                  {"[0.0139, -0.0139]", "[0.01, 0, -0.01]"}}},
                true);
  EXPECT_FALSE(answer.heading.ok);
  EXPECT_NE(answer.heading.message.find("controller refuses"), std::string::npos)
      << answer.heading.message;
}

}  // namespace
}  // namespace trochoid::run
