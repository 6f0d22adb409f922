#include <gtest/gtest.h>
#include <trochoid/files/uff58.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

namespace trochoid::files::uff58_real_test {

/// Files of several instruments, with what an independent reader makes of them. They
/// lie beside the project where they lie at all.
std::filesystem::path folder() {
  const char* const shared = std::getenv("TROCHOID_SHARED");
  return std::filesystem::path(shared != nullptr ? shared
                                                 : TROCHOID_SOURCE_DIR "/../shared") /
         "data/uff58";
}

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<std::map<std::string, std::string>> expected_sets() {
  std::ifstream in(folder() / "expected_dataset58.csv");
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> out;
  std::string line;
  while (std::getline(in, line)) {
    std::stringstream fields(line);
    std::string field;
    std::vector<std::string> row;
    while (std::getline(fields, field, ',')) row.push_back(field);
    if (names.empty()) {
      names = row;
      continue;
    }
    auto& set = out.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) set[names[i]] = row[i];
  }
  return out;
}

/// `(1+2j)`, `0j` or `3.5`
std::complex<double> number(std::string text) {
  if (text.front() == '(') text = text.substr(1, text.size() - 2);
  const char* at = text.c_str();
  char* end = nullptr;
  const double first = std::strtod(at, &end);
  if (*end == 'j') return {0.0, first};
  return {first, *end == '\0' ? 0.0 : std::strtod(end, nullptr)};
}

void expect_near(std::complex<double> value, std::complex<double> expected) {
  EXPECT_NEAR(std::abs(value - expected), 0.0, 1e-9 * std::abs(expected) + 1e-300);
}

void compare(const Uff58& set, const std::map<std::string, std::string>& e) {
  const auto whole = [&](const char* name) { return std::stoi(e.at(name)); };
  EXPECT_EQ(set.function_type, whole("func_type"));
  EXPECT_EQ(set.binary, whole("binary") == 1);
  EXPECT_EQ(set.ordinate_type, whole("ord_data_type"));
  EXPECT_EQ(set.even, whole("even_spacing") == 1);
  ASSERT_EQ(set.y.size(), static_cast<std::size_t>(whole("points")));
  EXPECT_EQ(set.response_node, whole("rsp_node"));
  EXPECT_EQ(set.response_direction, whole("rsp_dir"));
  EXPECT_EQ(set.reference_node, whole("ref_node"));
  EXPECT_EQ(set.reference_direction, whole("ref_dir"));
  expect_near(set.x.front(), number(e.at("x_first")));
  expect_near(set.x.back(), number(e.at("x_last")));
  expect_near(set.y.front(), number(e.at("first")));
  expect_near(set.y.back(), number(e.at("last")));
  std::complex<double> sum = 0.0;
  for (const auto& y : set.y) sum += y;
  // Their order of summation is another one: 1e-12 of the sum of the magnitudes.
  double all = 0.0;
  for (const auto& y : set.y) all += std::abs(y);
  const auto n = static_cast<double>(set.y.size());
  EXPECT_NEAR(std::abs(sum / n - number(e.at("mean"))), 0.0, 1e-6 * all / n);
}

TEST(RealUff58, IsReadLikeByAnIndependentReader) {
  const auto expected = expected_sets();
  if (expected.empty()) GTEST_SKIP() << folder() << " is not here";
  for (const auto& e : expected) {
    SCOPED_TRACE(e.at("file") + " " + e.at("set"));
    const auto file = read_uff(content(folder() / e.at("file")), e.at("file"));
    const auto at = static_cast<std::size_t>(std::stoi(e.at("set")));
    ASSERT_GE(file.sets.size(), at);
    compare(file.sets[at - 1], e);
  }
}

TEST(RealUff58, FilesWithoutASet58ArePassedOver) {
  const auto name = folder() / "uff55_translation.uff";
  if (!std::filesystem::exists(name)) GTEST_SKIP() << name << " is not here";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    if (entry.path().extension() != ".uff") continue;
    SCOPED_TRACE(entry.path().string());
    const auto file = read_uff(content(entry.path()), "real");
    EXPECT_GT(file.sets.size() + file.others.size(), 0u);
    ++files;
  }
  EXPECT_GT(files, 10);
}

}  // namespace trochoid::files::uff58_real_test
