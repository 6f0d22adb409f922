#include <trochoid/base/error.h>
#include <trochoid/cases/case_source.h>
#include <trochoid/files/frf_file.h>
#include <trochoid/files/record_file.h>
#include <trochoid/files/step_file.h>

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace trochoid::cases::case_memory_test {

namespace {

/// What a program gives has no place in a file.
Node given(auto value) {
  return {std::move(value), {"folder/case", 0, 0}};
}

Members table(std::vector<std::pair<std::string, Node>> keys) {
  Members members;
  for (auto& [key, node] : keys) {
    members.push_back({key, node.where, std::move(node)});
  }
  return members;
}

Node slot(double speed) {
  const Node tool = given(table({{"teeth", given(std::int64_t{2})},
                                 {"diameter_mm", given(8.0)},
                                 {"helix_deg", given(30.0)}}));
  const Node cut = given(table({{"engagement", given(std::string("slot"))},
                                {"axial_depth_mm", given(2.0)},
                                {"feed_per_tooth_mm", given(0.04)},
                                {"spindle_rpm", given(speed)}}));
  return given(table({{"tool", tool}, {"cut", cut}}));
}

Node with_measurement(Node root, const std::string& name) {
  const Node entry = given(
      table({{"file", given(name)}, {"sample_rate_Hz", given(std::int64_t{1000})}}));
  std::get<Members>(root.value)
      .push_back({"measurement", root.where, given(Array{entry})});
  return root;
}

std::shared_ptr<const files::NumericTable> three_samples() {
  auto record = std::make_shared<files::NumericTable>();
  for (const char* name : {"Fx", "Fy", "Fz"}) {
    record->columns.push_back({.name = name, .path = name, .unit = "kN", .count = 3});
  }
  record->values = [](std::size_t i) {
    return std::vector<double>(3, static_cast<double>(i));
  };
  return record;
}

std::vector<std::string> problems_of(const CaseSource& source, Command command) {
  try {
    read_case(source, command);
  } catch (const base::InputError& error) {
    return error.problems();
  }
  return {};
}

}  // namespace

TEST(CaseInMemory, ProblemsHaveNoPlaceInAFile) {
  const Node root = slot(-1);
  const auto problems = problems_of({root, "folder/case", {}}, Command::identify);
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_TRUE(problems[0].starts_with("case: cut.spindle_rpm = -1 rpm: out of range"))
      << problems[0];
  EXPECT_TRUE(problems[1].starts_with("case: [[measurement]] is missing"))
      << problems[1];
}

TEST(CaseInMemory, KeysAreCheckedBeforeAnyCommandIsMeant) {
  const Node good = slot(875);
  EXPECT_NO_THROW(check_keys({good, "folder/case", {}}));
  const Node bad = slot(-1);
  EXPECT_THROW(check_keys({bad, "folder/case", {}}), base::InputError);
}

TEST(CaseInMemory, ARecordInMemoryStandsForItsFile) {
  const Node root = with_measurement(slot(875), "plate");
  const auto missing = problems_of({root, "folder/case", {}}, Command::identify);
  ASSERT_EQ(missing.size(), 1U);
  EXPECT_NE(missing[0].find("there is no such file (folder/plate)"), std::string::npos);

  const Case c =
      read_case({root, "folder/case", {.records = {{"plate", three_samples()}}}},
                Command::identify);
  const signal::Record& record = c.measurements.at(0).record.get();
  EXPECT_EQ(record.file, "plate");
  EXPECT_EQ(record.channel[2], std::vector<double>(3, 2000.0));
  EXPECT_EQ(record.sample_rate, 1000.0);
  EXPECT_NE(c.as_understood.find("file = \"plate\""), std::string::npos);
}

TEST(CaseInMemory, ATextStandsForTheFileThatItWouldBe) {
  const Node frf = given(table({{"file", given(std::string("tip"))}}));
  const Node step = given(table({{"file", given(std::string("step"))}}));
  const Node root = given(table({{"frf", frf}, {"step", step}}));
  EXPECT_EQ(problems_of({root, "folder/case", {}}, Command::modes).size(), 2U);
  const auto text = [](const char* content) {
    return std::make_shared<const std::string>(content);
  };
  const Case c = read_case(
      {root,
       "folder/case",
       {.records = {},
        .texts = {{"tip", text("freq_Hz,re_m/N,im_m/N\n10,1e-6,0\n20,2e-6,0\n")},
                  {"step", text("time_s,position_um\n0,0\n1,3\n")}}}},
      Command::modes);
  const files::FrfFile& response = c.machine.frf->response.get();
  EXPECT_EQ(response.response.H.at(1).real(), 2e-6);
  files::StepSource step_source = c.machine.step->source;
  step_source.step = 1e-6;
  const files::StepFile read = files::read_step(step_source);
  EXPECT_EQ(read.record.position.at(1), 3e-6);
  EXPECT_NE(c.as_understood.find("file = \"tip\""), std::string::npos);
}

}  // namespace trochoid::cases::case_memory_test
