#include <gtest/gtest.h>
#include <trochoid/files/csv.h>
#include <trochoid/files/tdms.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>

namespace trochoid::files::tdms_real_test {

std::filesystem::path folder() {
  const char* const shared = std::getenv("TROCHOID_SHARED");
  return std::filesystem::path(shared != nullptr ? shared
                                                 : TROCHOID_SOURCE_DIR "/../shared") /
         "data/tdms";
}

double at(const std::vector<Field>& row, std::size_t i) {
  const auto number = parse_number(row[i].text);
  return number.fault == NumberFault::none ? number.value : std::nan("");
}

/// Files of National Instruments' programs; what npTDMS reads in them stands beside them.
TEST(RealTdms, AgreesWithAnotherReader) {
  std::ifstream expected(folder() / "expected_channels.csv");
  if (!expected) GTEST_SKIP() << folder() << " is not here";
  std::string line;
  std::getline(expected, line);
  int channels = 0;
  while (std::getline(expected, line)) {
    std::vector<Field> row;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    split(line, ',', row);
    SCOPED_TRACE(line);
    std::ifstream in(folder() / row[0].text, std::ios::binary);
    const auto table = tdms_table(in, std::string(row[0].text));
    const auto path = std::string(row[1].text) + "/" + std::string(row[2].text);
    const auto column =
        std::find_if(table.columns.begin(), table.columns.end(),
                     [&](const NumericColumn& c) { return c.path == path; });
    ASSERT_NE(column, table.columns.end());
    const auto values =
        table.values(static_cast<std::size_t>(column - table.columns.begin()));
    ASSERT_EQ(static_cast<double>(values.size()), at(row, 4));
    EXPECT_EQ(column->count, values.size());
    // The other reader adds and scales in another order.
    const double slack = 1e-12;
    EXPECT_NEAR(values.front(), at(row, 5), slack);
    EXPECT_NEAR(values.back(), at(row, 6), slack);
    EXPECT_NEAR(std::accumulate(values.begin(), values.end(), 0.0) /
                    static_cast<double>(values.size()),
                at(row, 7), slack);
    EXPECT_NEAR(*std::min_element(values.begin(), values.end()), at(row, 8), slack);
    EXPECT_NEAR(*std::max_element(values.begin(), values.end()), at(row, 9), slack);
    EXPECT_NEAR(column->sample_rate * at(row, 10), 1.0, slack);
    EXPECT_EQ(column->unit, row[11].text);
    ++channels;
  }
  EXPECT_EQ(channels, 13);
}

}  // namespace trochoid::files::tdms_real_test
