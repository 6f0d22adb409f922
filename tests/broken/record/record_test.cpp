#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/inputs/record_file.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace trochoid::inputs {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> broken_records() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(BROKEN_RECORDS)) {
    if (entry.path().extension() == ".expected") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The file that `name.expected` stands beside, whatever its format.
fs::path file_of(const std::string& name) {
  for (const auto& entry : fs::directory_iterator(BROKEN_RECORDS)) {
    if (entry.path().stem() == name && entry.path().extension() != ".expected") {
      return entry.path();
    }
  }
  return {};
}

class BrokenRecord : public testing::TestWithParam<std::string> {};

/// Every file is wrong in one way; what is said about it stands beside it, without the
/// folder before the file's name.
TEST_P(BrokenRecord, IsRefusedWithItsMessage) {
  const fs::path folder = BROKEN_RECORDS;
  Measurement measurement;
  measurement.file = file_of(GetParam());
  if (!WITH_HDF5 && measurement.file.extension() == ".h5") {
    GTEST_SKIP() << "built without HDF5";
  }
  std::string said;
  try {
    read_record(measurement);
  } catch (const base::InputError& error) {
    said = error.what();
  }
  const auto prefix = folder.string() + "/";
  for (auto at = said.find(prefix); at != std::string::npos; at = said.find(prefix)) {
    said.erase(at, prefix.size());
  }
  EXPECT_EQ(said, contents(folder / (GetParam() + ".expected")));
}

INSTANTIATE_TEST_SUITE_P(Files, BrokenRecord, testing::ValuesIn(broken_records()),
                         [](const auto& one) { return one.param; });

TEST(BrokenRecords, AreThere) {
  EXPECT_GE(broken_records().size(), 40u);
}

}  // namespace
}  // namespace trochoid::inputs
