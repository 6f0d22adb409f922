#include <trochoid/identification/answer.h>

#include <gtest/gtest.h>

#include <array>

namespace trochoid::identification::found_test {

/// Two coefficients and an eccentricity, of whose components one has no error.
TEST(FoundTogether, HasNoComponentOfAnEccentricityAlone) {
  const Problem problem{
      .setup = {},
      .law = {},
      .runs = {},
      .unknowns = {.runout = RunoutUnknowns::eccentricity, .teeth = 2},
      .columns = 2};
  const std::array p{0.1, 0.2};
  const std::array K{1e9, 5e8};
  Uncertainty known{.reason = std::vector<std::string>(4),
                    .on_edge = std::vector<bool>(4),
                    .covariance = std::vector<double>(16, 1.0)};
  EXPECT_EQ(found_together(problem, p, K, known).unknowns.size(), 4U);
  known.on_edge[2] = true;
  EXPECT_EQ(found_together(problem, p, K, known).unknowns.size(), 2U);
  known.on_edge[2] = false;
  known.reason[3] = "not to be told";
  const FoundTogether found = found_together(problem, p, K, known);
  ASSERT_EQ(found.unknowns.size(), 2U);
  EXPECT_EQ(found.unknowns[1].kind, FoundKind::coefficient);
  EXPECT_EQ(found.covariance.size(), 4U);
}

}  // namespace trochoid::identification::found_test
