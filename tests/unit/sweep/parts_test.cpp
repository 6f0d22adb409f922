#include <trochoid/sweep/parts.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace trochoid::sweep::parts_test {

namespace fs = std::filesystem;
using results::SweepRow;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

fs::path file() {
  const std::string name =
      testing::UnitTest::GetInstance()->current_test_info()->name();
  return fs::temp_directory_path() / ("trochoid_parts_" + name);
}

std::vector<SweepRow> some_rows(std::size_t count, double first) {
  std::vector<SweepRow> rows;
  for (std::size_t i = 0; i < count; ++i) {
    rows.push_back({.cells = {first + 0.1 * static_cast<double>(i), nan,
                              std::string("a \"b\", c")},
                    .status = "failed",
                    .message = "why, \"so\""});
  }
  return rows;
}

std::string text() {
  std::ifstream in(file(), std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

std::size_t done(const std::string& meaning = "same") {
  return Parts(file(), meaning, 3).take_done().size();
}

struct PartsFile : testing::Test {
  PartsFile() {
    fs::remove(file());
    Parts parts(file(), "same", 3);
    parts.add(0, some_rows(4, 1));
    parts.add(4, some_rows(3, 2));
  }
  ~PartsFile() override { fs::remove(file()); }
  PartsFile(const PartsFile&) = delete;
  PartsFile& operator=(const PartsFile&) = delete;
};

TEST_F(PartsFile, GivesBackTheSameBits) {
  const auto rows = Parts(file(), "same", 3).take_done();
  ASSERT_EQ(rows.size(), 7U);
  EXPECT_EQ(rows.number(3, 0), 1 + 0.1 * 3);
  EXPECT_EQ(rows.number(6, 0), 2 + 0.1 * 2);
  EXPECT_TRUE(std::isnan(rows.number(6, 1)));
  EXPECT_EQ(std::get<std::string>(rows.row(0).cells[2]), "a \"b\", c");
  EXPECT_EQ(rows.row(0).status, "failed");
  EXPECT_EQ(rows.row(0).message, "why, \"so\"");
}

TEST_F(PartsFile, OfAnotherSweepIsBegunAnew) {
  EXPECT_EQ(done("other"), 0U);
  EXPECT_EQ(done(), 0U);
}

TEST_F(PartsFile, CutAnywhereKeepsWholePartsOnlyAndGoesOn) {
  const std::string whole = text();
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    std::ofstream(file(), std::ios::binary) << whole.substr(0, size);
    const std::size_t kept = done();
    EXPECT_TRUE(kept == 0 || kept == 4 || kept == 7) << size;
    EXPECT_EQ(kept == 7, size == whole.size()) << size;
    {
      Parts parts(file(), "same", 3);
      parts.add(parts.take_done().size(), some_rows(2, 3));
    }
    EXPECT_EQ(done(), kept + 2) << size;
  }
}

TEST_F(PartsFile, AChangedByteIsNotBelieved) {
  std::string changed = text();
  changed[changed.rfind("2.1")] = '3';
  std::ofstream(file(), std::ios::binary) << changed;
  EXPECT_EQ(done(), 4U);
}

}  // namespace trochoid::sweep::parts_test
