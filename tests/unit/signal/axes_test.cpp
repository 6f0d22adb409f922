#include <gtest/gtest.h>
#include <trochoid/signal/axes.h>

#include <cmath>
#include <set>

namespace trochoid::signal::axes_test {

using Vector3 = std::array<double, 3>;

Vector3 times(const Matrix3& A, const Vector3& x) {
  Vector3 y{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) y[i] += A[i][j] * x[j];
  }
  return y;
}

// [S-3]
TEST(Axes, AreAllFortyEightSignedPermutations) {
  const auto all = axes_candidates();
  EXPECT_EQ(all.size(), 48u);
  std::set<Matrix3> different(all.begin(), all.end());
  EXPECT_EQ(different.size(), 48u);
  const Matrix3 identity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  EXPECT_EQ(all.front(), identity);
  for (const auto& Q : all) {  // orthogonal
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        double dot = 0.0;
        for (std::size_t k = 0; k < 3; ++k) dot += Q[i][k] * Q[j][k];
        EXPECT_EQ(dot, i == j ? 1.0 : 0.0);
      }
    }
  }
}

TEST(Axes, HaveNamesThatReadBack) {
  const Matrix3 Q = {{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}};
  EXPECT_EQ(axes_names(Q), (std::array<std::string, 3>{"y", "x", "-z"}));
  for (const auto& candidate : axes_candidates()) {
    const auto names = axes_names(candidate);
    EXPECT_EQ(axes_matrix(names), candidate);
  }
  EXPECT_FALSE(axes_matrix(std::array<std::string, 3>{"x", "x", "z"}));
  EXPECT_FALSE(axes_matrix(std::array<std::string, 2>{"x", "y"}));
}

TEST(Axes, AreConvertedToTheForceOnTheTool) {
  const Matrix3 M = {{{0, -2, 0}, {1, 0, 0.1}, {0, 0, 3}}};
  const Vector3 force = {10, 20, 30};
  const auto reading = times(M, force);
  const auto back =
      force_on_tool({std::vector{reading[0]}, {reading[1]}, {reading[2]}}, M);
  ASSERT_TRUE(back);
  for (std::size_t q = 0; q < 3; ++q) EXPECT_NEAR((*back)[0][q], force[q], 1e-12);
  const Matrix3 flat = {{{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
  EXPECT_FALSE(force_on_tool({std::vector{1.0}, {1.0}, {1.0}}, flat));
  EXPECT_THROW(force_on_tool({std::vector{1.0}, {}, {1.0}}, M), std::invalid_argument);
}

/// Force of one edge point on a cylinder, F-3: columns t, r, a.
Vector3 edge_force(double theta, const Vector3& K) {
  const double s = std::sin(theta);
  const double c = std::cos(theta);
  return {-K[0] * c - K[1] * s, K[0] * s - K[1] * c, -K[2]};
}

TEST(AxesClasses, HoldEveryCandidateOnce) {
  std::set<Matrix3> seen;
  for (const auto& one : axes_classes()) {
    for (const auto& reading : one.readings) seen.insert(reading.Q);
  }
  EXPECT_EQ(seen.size(), 48u);
}

TEST(AxesClasses, ReadTheSameRecordWithTurnedCoefficients) {
  const Vector3 K = {700, 200, 90};
  for (const auto& one : axes_classes()) {
    for (double theta = 0.1; theta < 3.0; theta += 0.4) {
      const auto expected = times(one.readings[0].Q, edge_force(theta, K));
      for (const auto& reading : one.readings) {
        const auto channels =
            times(reading.Q, edge_force(theta, times(reading.turn, K)));
        for (std::size_t q = 0; q < 3; ++q) {
          EXPECT_NEAR(channels[q], expected[q], 1e-9);
        }
      }
    }
  }
}

TEST(AxesClasses, HaveOneReadingWithPositiveCoefficients) {
  for (const Vector3& K : {Vector3{700, 200, 90}, {-200, 700, -90}, {-3, -2, 1}}) {
    int positive = 0;
    const auto classes = axes_classes();
    for (const auto& reading : classes[2].readings) {
      const auto turned = times(reading.turn, K);
      positive += turned[0] > 0 && turned[1] > 0 && turned[2] > 0 ? 1 : 0;
    }
    EXPECT_EQ(positive, 1);
  }
}

}  // namespace trochoid::signal::axes_test
