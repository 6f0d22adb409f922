#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/inputs/surface_file.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace trochoid::inputs {
namespace {

namespace fs = std::filesystem;

constexpr int teeth = 3;

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> broken_surfaces() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(BROKEN_SURFACES)) {
    if (entry.path().extension() == ".csv") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class BrokenSurface : public testing::TestWithParam<std::string> {};

/// Every file is wrong in one way; what is said about it stands beside it, without the
/// folder before the file's name.
TEST_P(BrokenSurface, IsRefusedWithItsMessage) {
  const fs::path folder = BROKEN_SURFACES;
  SurfaceMeasurement measurement;
  measurement.file = (folder / (GetParam() + ".csv")).string();
  std::string said = "(nothing: the file was accepted)";
  try {
    static_cast<void>(read_surface(measurement, teeth));
  } catch (const base::InputError& error) {
    said = error.what();
  }
  const auto prefix = folder.string() + "/";
  for (auto at = said.find(prefix); at != std::string::npos; at = said.find(prefix)) {
    said.erase(at, prefix.size());
  }
  EXPECT_EQ(said, contents(folder / (GetParam() + ".expected")));
}

INSTANTIATE_TEST_SUITE_P(Files, BrokenSurface, testing::ValuesIn(broken_surfaces()),
                         [](const auto& one) { return one.param; });

TEST(BrokenSurfaces, AreThere) {
  EXPECT_GE(broken_surfaces().size(), 25u);
}

}  // namespace
}  // namespace trochoid::inputs
