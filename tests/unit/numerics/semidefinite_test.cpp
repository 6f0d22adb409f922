#include <trochoid/numerics/semidefinite.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trochoid::numerics::semidefinite_test {

using Values = std::vector<double>;

Values square_of(const Values& L, std::size_t n) {
  Values C(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) {
        C[i * n + j] += L[i * n + k] * L[j * n + k];
      }
    }
  }
  return C;
}

void expect_root(const Values& C, std::size_t n) {
  const auto L = semidefinite_root(C, n);
  ASSERT_TRUE(L);
  const Values back = square_of(*L, n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      EXPECT_NEAR(back[i * n + j], C[i * n + j],
                  1e-11 * std::sqrt(C[i * n + i] * C[j * n + j]))
          << i << " " << j;
    }
  }
}

TEST(SemidefiniteRoot, SquaredIsTheCovariance) {  // [U-2]
  expect_root({4, 2, -1, 2, 9, 3, -1, 3, 5}, 3);
}

TEST(SemidefiniteRoot, TakesUnitsThatAreFarApart) {
  expect_root({4e12, 1.2, 1.2, 9e-12}, 2);
}

TEST(SemidefiniteRoot, IsTheSameWhateverRoundingMakesOfEqualPivots) {
  // On some machines one of these variances is the larger one, on others another.
  const Values C = {4, 2, -1, 2, 9, 3, -1, 3, 5};
  const auto L = semidefinite_root(C, 3);
  ASSERT_TRUE(L);
  for (std::size_t k = 0; k < C.size(); ++k) {
    Values rounded = C;
    rounded[k] *= 1 + 1e-15;
    const auto other = semidefinite_root(rounded, 3);
    ASSERT_TRUE(other);
    for (std::size_t i = 0; i < L->size(); ++i) {
      EXPECT_NEAR((*other)[i], (*L)[i], 1e-12) << k << " " << i;
    }
  }
}

TEST(SemidefiniteRoot, IsThereForEveryRank) {
  // b b^T + d d^T of rank two, and a number without any error.
  const Values b = {1, 2, -3, 0};
  const Values d = {0.5, -1, 0.25, 0};
  Values C;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      C.push_back(b[i] * b[j] + d[i] * d[j]);
    }
  }
  expect_root(C, 4);
  expect_root({1, 1, 1, 1}, 2);
  expect_root({0, 0, 0, 0}, 2);
}

TEST(SemidefiniteRoot, IsNoneOfWhatIsNoCovariance) {
  EXPECT_FALSE(semidefinite_root(Values{1, 2, 2, 1}, 2));
  EXPECT_FALSE(semidefinite_root(Values{-1, 0, 0, 1}, 2));
  EXPECT_FALSE(semidefinite_root(Values{1, .9, -.9, .9, 1, .9, -.9, .9, 1}, 3));
}

}  // namespace trochoid::numerics::semidefinite_test
