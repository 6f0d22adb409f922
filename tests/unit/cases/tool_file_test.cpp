#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/cases/tool_file.h>
#include <trochoid/cases/usual_tools.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace trochoid::cases::tool_file_test {

using Keys = std::vector<std::string>;

class ToolFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }

  FoundTool read(const std::string& text, std::optional<int> number = {},
                 bool inches = false) {
    std::ofstream(file_) << text;
    return read_tool({file_, number, inches});
  }

  std::string refused(const std::string& text, std::optional<int> number = {}) {
    try {
      read(text, number);
    } catch (const base::InputError& error) {
      return error.problems().at(0).substr(file_.string().size());
    }
    return "taken";
  }

  std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("tool_") +
       testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(ToolFile, OfFreeCad) {
  const FoundTool mill = read(
      R"({"version": 2, "name": "5 mm", "shape": "endmill.fcstd", "shape-type": "Endmill",
          "parameter": {"Diameter": "5.0000 mm", "Length": "50 mm"},
          "attribute": {"Flutes": "3"}})");
  EXPECT_EQ(mill.name, "5 mm");
  EXPECT_EQ(mill.shape, Shape::cylinder);
  EXPECT_EQ(mill.diameter, 5 * unit::mm);
  EXPECT_EQ(mill.teeth, 3);
  EXPECT_EQ(mill.corner_radius, std::nullopt);
}

TEST_F(ToolFile, CornersAndInches) {
  const FoundTool bull = read(
      R"({"shape": "bullnose.fcstd",
          "parameter": {"Diameter": "0.25 in", "CornerRadius": "0.0625 \"", "Flutes": 0}})");
  EXPECT_EQ(bull.shape, Shape::bull_nose);
  EXPECT_DOUBLE_EQ(bull.diameter, 6.35 * unit::mm);
  EXPECT_DOUBLE_EQ(bull.corner_radius.value(), 1.5875 * unit::mm);
  EXPECT_EQ(bull.teeth, std::nullopt);
}

/// As FreeCAD 0.19 to 1.0 write them.
TEST_F(ToolFile, OfFreeCadInItsOlderWords) {
  const FoundTool flat = read(
      R"({"shape": "bullnose.fcstd", "parameter": {"Diameter": "6.00 mm", "FlatRadius": "1.50 mm"}})");
  EXPECT_EQ(flat.shape, Shape::bull_nose);
  EXPECT_DOUBLE_EQ(flat.corner_radius.value(), 1.5 * unit::mm);
  const FoundTool torus = read(
      R"({"shape": "torus.fcstd", "parameter": {"Diameter": "6.00 mm", "TorusRadius": "0.50 mm"}})");
  EXPECT_EQ(torus.shape, Shape::bull_nose);
  EXPECT_DOUBLE_EQ(torus.corner_radius.value(), 0.5 * unit::mm);
  for (const std::string mu : {"u", "\xC2\xB5", "\xCE\xBC"}) {
    const FoundTool small =
        read(R"({"shape": "endmill.fcstd", "parameter": {"Diameter": "635.0 )" + mu +
             R"(m"}})");
    EXPECT_DOUBLE_EQ(small.diameter, 0.635 * unit::mm);
  }
}

TEST_F(ToolFile, OfLinuxCncWithoutAPocket) {
  const std::string table = "T1 P X0 Y0 D4.00 I0 ; 4mm\nT2 P0 X0 D6.00 ;6mm\n";
  EXPECT_DOUBLE_EQ(read(table, 1).diameter, 4 * unit::mm);
  EXPECT_EQ(refused(table), ": which tool? --tool-number, one of 1, 2");
}

TEST_F(ToolFile, OfLinuxCnc) {
  const std::string table =
      "T1 P1 D0.125000 Z+0.511000 ;1/8 end mill\r\n;a comment\n"
      "T3   P3 X0 Y0 D+6.5 I95.0 ;6.5 mm, 3 flutes\nT99 P99 Z+0.1 ;no diameter\n";
  const FoundTool third = read(table, 3);
  EXPECT_DOUBLE_EQ(third.diameter, 6.5 * unit::mm);
  EXPECT_EQ(third.name, "6.5 mm, 3 flutes");
  EXPECT_EQ(third.shape, std::nullopt);
  EXPECT_DOUBLE_EQ(read(table, 1, true).diameter, 3.175 * unit::mm);
  EXPECT_EQ(refused(table), ": which tool? --tool-number, one of 1, 3");
  EXPECT_EQ(refused(table, 99), ": which tool? --tool-number, one of 1, 3");
  EXPECT_DOUBLE_EQ(read("T7 D2\n").diameter, 2 * unit::mm);
  EXPECT_EQ(read("T7 D2 ;Fr\xe4ser 2\n").name, "Frser 2") << "what is no UTF-8";
}

TEST_F(ToolFile, WhatIsNoEndMillIsRefused) {
  EXPECT_EQ(
      refused(R"({"shape": "drill.fcstd", "parameter": {"Diameter": "5 mm"}})"),
      ": the tool is of the shape \"drill\"; must be an end mill: endmill, ballend, "
      "bullnose or torus");
  EXPECT_EQ(
      refused(R"({"shape": "endmill.fcstd", "parameter": {"Diameter": "5"}})"),
      ": \"Diameter\" = \"5\": must be a length such as \"6.0 mm\" or \"0.25 in\"");
  EXPECT_EQ(refused("{\"tool\": 1"),
            ": this is no tool bit of FreeCAD, which is JSON with a \"shape\"");
  EXPECT_EQ(refused(R"({"shape": 3, "name": null})"),
            ": the tool is of the shape \"\"; must be an end mill: endmill, ballend, "
            "bullnose or torus");
  EXPECT_EQ(refused("time_s,Fx_N\n0,1\n").substr(0, 29),
            ": no tool with a diameter is ");
  EXPECT_EQ(refused("T1 D1e400\nT2 Dnan\nT1e30 D1\nT3 Dinf\nT4 D1e-300\n").substr(0, 9),
            ": no tool");
}

TEST_F(ToolFile, SaysWhatStays) {
  ToolTable tool{.teeth = 2, .helix = {{0.5}}};
  EXPECT_EQ(take_tool({.shape = Shape::ball, .diameter = 0.006, .teeth = 4}, tool),
            Keys{"helix_deg"});
  EXPECT_EQ(tool.shape, Shape::ball);
  EXPECT_EQ(tool.teeth, 4);
  EXPECT_EQ(take_tool({.diameter = 0.008}, tool),
            (Keys{"shape", "teeth", "helix_deg"}));
  EXPECT_EQ(tool.diameter, 0.008);
}

TEST_F(ToolFile, ANewCaseWithItIsOne) {
  std::ofstream(file_) << "T4 P1 D10 ;new, 3 flutes\n";
  const std::string text =
      new_case(Command::simulate, {.tool = ToolChoice{.file = file_}});
  EXPECT_NE(text.find("diameter_mm = 10 "), std::string::npos) << text;
  EXPECT_NE(
      text.find(
          "(new, 3 flutes). That file does not give these\n# keys, so check them: "
          "shape, teeth, helix_deg\n"),
      std::string::npos)
      << text;
}

/// Every kind of cutter gives a case that is sound, with teeth and a cut of its own.
TEST(UsualTool, IsASoundCase) {
  ASSERT_EQ(usual_tools().size(), 6U);
  for (const UsualTool& tool : usual_tools()) {
    const auto file = std::filesystem::path(testing::TempDir()) / "usual_tool.toml";
    for (const Command command : {Command::simulate, Command::identify}) {
      const ToolChoice choice{std::string(tool.name)};
      std::ofstream(file) << new_case(command, {.tool = choice});
      std::ofstream(file.parent_path() / "record.csv") << "angle_deg,Fx_N\n0,1\n1,2\n";
      const Case made = read_case(file, command);
      EXPECT_GT(made.setup.cutter.teeth(), 2) << tool.name;
      EXPECT_EQ(made.title, tool.meaning);
    }
    std::filesystem::remove(file);
  }
}

}  // namespace trochoid::cases::tool_file_test
