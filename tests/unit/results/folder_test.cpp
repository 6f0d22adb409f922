#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/results/folder.h>
#include <trochoid/results/json.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace trochoid::results::folder_test {

namespace fs = std::filesystem;

Answer sample() {
  Answer answer;
  answer.command = "simulate";
  answer.heading.title = "St 52-3 slot <\"8 mm\">";
  answer.heading.message = "Both teeth cut.";
  answer.heading.warnings = {{"runout_dominates", "The runout exceeds the feed."}};
  answer.result = json_value(R"({"mean_N":[1.5,-2,0.1]})");
  answer.heading.case_toml = "title = 'St 52-3 slot <\"8 mm\">'\n[tool]\nteeth = 2\n";
  answer.tables = {{"chip.csv", {{"tooth", {1, 2}}, {"h_mm", {0.1 + 0.2, 1.0 / 3.0}}}},
                   {"forces.csv", {{"angle_deg", {0.0, 0.5}}, {"Fx_N", {-1.0, 7.0}}}}};
  answer.texts = {{"material.toml", "[force]\nlaw = \"linear_edge\"\n"}};
  return answer;
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const fs::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

template <class Action>
std::string reason_of(Action action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

class Folder : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::temp_directory_path() /
            ("trochoid_" + std::string(info->name()) + std::to_string(::getpid()));
    fs::remove_all(root_);
    fs::create_directories(root_);
    folder_ = root_ / "slot.simulate";
  }
  void TearDown() override { fs::remove_all(root_); }
  [[nodiscard]] std::ptrdiff_t entries_of_root() const {
    return std::distance(fs::directory_iterator(root_), fs::directory_iterator{});
  }

  fs::path root_;
  fs::path folder_;
};

TEST_F(Folder, HoldsEverythingOfTheAnswer) {
  write_folder(folder_, sample(), "<html>");
  EXPECT_EQ(content(folder_ / "case.toml"), sample().heading.case_toml);
  EXPECT_EQ(content(folder_ / "summary.json"), summary_json(sample()));
  EXPECT_EQ(content(folder_ / "forces.csv"), "angle_deg,Fx_N\n0,-1\n0.5,7\n");
  EXPECT_EQ(content(folder_ / "material.toml"), sample().texts.front().text);
  EXPECT_EQ(content(folder_ / "report.html"), "<html>");
  EXPECT_EQ(entries_of_root(), 1) << "only the folder itself may remain";
}

TEST_F(Folder, HasNoReportWhenNoneIsGiven) {
  write_folder(folder_, sample(), "");
  EXPECT_FALSE(fs::exists(folder_ / "report.html"));
}

TEST_F(Folder, MakesTheFoldersAboveAndMindsNoTrailingSlash) {
  write_folder(root_ / "a" / "b" / "", sample(), "");
  EXPECT_TRUE(fs::exists(root_ / "a" / "b" / "summary.json"));
}

TEST_F(Folder, ReadsBackAsItWasWritten) {
  write_folder(folder_, sample(), "<html>");
  const Answer read = read_folder(folder_);
  EXPECT_EQ(summary_json(read), summary_json(sample()));
  EXPECT_EQ(read.heading.title, sample().heading.title);
  EXPECT_EQ(read.heading.case_toml, sample().heading.case_toml);
  ASSERT_EQ(read.tables.size(), 2U);
  EXPECT_EQ(read.tables[0].file, "chip.csv");
  ASSERT_EQ(read.tables[0].columns.size(), 2U);
  EXPECT_EQ(read.tables[0].columns[1].name, "h_mm");
  EXPECT_EQ(read.tables[0].columns[1].values, sample().tables[0].columns[1].values);
  ASSERT_EQ(read.texts.size(), 1U);
  EXPECT_EQ(read.texts[0].text, sample().texts[0].text);
}

TEST_F(Folder, KeepsMissingNumbersMissing) {
  Answer answer = sample();
  answer.tables[0].columns[0].values[1] = std::numeric_limits<double>::quiet_NaN();
  write_folder(folder_, answer, "");
  const Answer read = read_folder(folder_);
  EXPECT_EQ(read.tables[0].columns[0].values[0], 1.0);
  EXPECT_TRUE(std::isnan(read.tables[0].columns[0].values[1]));
}

TEST_F(Folder, ReplacesAnOlderAnswerWhole) {
  write_folder(folder_, sample(), "<html>");
  Answer second = sample();
  second.tables.pop_back();
  write_folder(folder_, second, "");
  EXPECT_FALSE(fs::exists(folder_ / "forces.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "report.html"));
  EXPECT_TRUE(fs::exists(folder_ / "summary.json"));
  EXPECT_EQ(entries_of_root(), 1);
}

TEST_F(Folder, FillsAnEmptyFolder) {
  fs::create_directory(folder_);
  write_folder(folder_, sample(), "");
  EXPECT_TRUE(fs::exists(folder_ / "summary.json"));
}

TEST_F(Folder, NeverReplacesFilesOfSomebodyElse) {
  write_folder(folder_, sample(), "");
  put(folder_ / "notes.txt", "mine");
  const std::string reason = reason_of([&] { write_folder(folder_, sample(), ""); });
  EXPECT_NE(reason.find("it contains 'notes.txt'"), std::string::npos) << reason;
  EXPECT_NE(reason.find(folder_.string()), std::string::npos) << reason;
  EXPECT_EQ(content(folder_ / "notes.txt"), "mine");
  EXPECT_EQ(entries_of_root(), 1);
}

TEST_F(Folder, NeverReplacesAFolderWithoutOurSummary) {
  fs::create_directory(folder_);
  put(folder_ / "case.toml", "title = \"the only copy\"");
  EXPECT_THROW(write_folder(folder_, sample(), ""), std::runtime_error);
  put(folder_ / "summary.json", R"({"somebody": "else"})");
  EXPECT_THROW(write_folder(folder_, sample(), ""), std::runtime_error);
  EXPECT_EQ(content(folder_ / "case.toml"), "title = \"the only copy\"");
}

TEST_F(Folder, NeverReplacesAFile) {
  put(folder_, "a file");
  const std::string reason = reason_of([&] { write_folder(folder_, sample(), ""); });
  EXPECT_NE(reason.find("not a folder"), std::string::npos) << reason;
  EXPECT_EQ(content(folder_), "a file");
}

TEST_F(Folder, ReplacesWhatALinkPointsTo) {
  const fs::path real = root_ / "real";
  write_folder(real, sample(), "");
  fs::create_directory_symlink(real, folder_);
  write_folder(folder_, sample(), "<html>");
  EXPECT_TRUE(fs::is_symlink(folder_));
  EXPECT_TRUE(fs::exists(real / "report.html"));
}

TEST_F(Folder, LeavesNothingBehindWhenItFails) {
  Answer answer = sample();
  answer.tables[0].columns[0].values.push_back(3.0);  // columns of different lengths
  EXPECT_THROW(write_folder(folder_, answer, ""), std::invalid_argument);
  EXPECT_EQ(entries_of_root(), 0);

  write_folder(folder_, sample(), "");
  EXPECT_THROW(write_folder(folder_, answer, ""), std::invalid_argument);
  EXPECT_EQ(summary_json(read_folder(folder_)), summary_json(sample()));
  EXPECT_EQ(entries_of_root(), 1);
}

TEST_F(Folder, NamesThePlaceThatCannotBeWritten) {
  put(root_ / "file", "");
  const fs::path inside = root_ / "file" / "slot.simulate";
  const std::string reason = reason_of([&] { write_folder(inside, sample(), ""); });
  EXPECT_NE(reason.find("cannot write " + (root_ / "file").string()), std::string::npos)
      << reason;
}

TEST_F(Folder, WritesOnlyFilesThatMayBeReplacedLater) {
  Answer answer = sample();
  answer.tables[0].file = "unlisted.csv";
  EXPECT_THROW(write_folder(folder_, answer, ""), std::invalid_argument);
}

TEST_F(Folder, IsReadOnlyIfItIsOurs) {
  EXPECT_THROW(static_cast<void>(read_folder(folder_)), base::InputError);
  fs::create_directory(folder_);
  put(folder_ / "summary.json", "[1, 2");
  EXPECT_THROW(static_cast<void>(read_folder(folder_)), base::InputError);
  put(folder_ / "summary.json", R"({"trochoid": {}, "command": 7})");
  EXPECT_THROW(static_cast<void>(read_folder(folder_)), base::InputError);
}

TEST_F(Folder, TakesANewReportAndKeepsTheRest) {
  write_folder(folder_, sample(), "<html>");
  const std::string older = R"({"trochoid": {"version": "0.0.1", "commit": "older"}})";
  put(folder_ / "summary.json", older);
  put(folder_ / "notes.txt", "mine");
  write_report(folder_, "<html>new");
  EXPECT_EQ(content(folder_ / "report.html"), "<html>new");
  EXPECT_EQ(read_summary(folder_), older) << "whoever made the numbers stays named";
  EXPECT_EQ(content(folder_ / "notes.txt"), "mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}),
            7);
}

TEST_F(Folder, TakesAReportOnlyIfItIsOurs) {
  fs::create_directory(folder_);
  EXPECT_THROW(write_report(folder_, "<html>"), base::InputError);
  EXPECT_FALSE(fs::exists(folder_ / "report.html"));
}

TEST_F(Folder, NamesTheLineOfABrokenTable) {
  write_folder(folder_, sample(), "");
  put(folder_ / "forces.csv", "angle_deg,Fx_N\n0,1\n0.5,many\n");
  std::string reason = reason_of([&] { static_cast<void>(read_folder(folder_)); });
  EXPECT_NE(reason.find("forces.csv:3:1: 'many' is not a number"), std::string::npos)
      << reason;
  put(folder_ / "forces.csv", "angle_deg,Fx_N\n0\n");
  reason = reason_of([&] { static_cast<void>(read_folder(folder_)); });
  EXPECT_NE(reason.find("forces.csv:2:1: 1 values, but 2 columns"), std::string::npos)
      << reason;
}

}  // namespace trochoid::results::folder_test
