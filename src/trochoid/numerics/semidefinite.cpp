#include <trochoid/numerics/semidefinite.h>

#include <algorithm>
#include <cmath>

namespace trochoid::numerics {

namespace {

using Values = std::vector<double>;

/// Of a correlation: what is left of a variance is rounding.
constexpr double rounding = 1e-12;
/// Of a correlation that the root does not give back.
constexpr double most_lost = 1e-6;
/// Of the largest: pivots as large as this are as good, and rounding, which is not the same
/// everywhere, must not choose among them.
constexpr double as_good = 0.9;

/// Correlations; a variance of zero has none.
Values correlations(std::span<const double> C, std::span<const double> sd) {
  const std::size_t n = sd.size();
  Values R(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double both = sd[i] * sd[j];
      R[i * n + j] = both > 0 ? 0.5 * (C[i * n + j] + C[j * n + i]) / both : 0.0;
    }
  }
  return R;
}

/// Sum of the products of two rows up to a column.
double product(std::span<const double> a, std::span<const double> b, std::size_t end) {
  double sum = 0.0;
  for (std::size_t k = 0; k < end; ++k) {
    sum += a[k] * b[k];
  }
  return sum;
}

Values root_of_correlations(std::span<const double> R, std::size_t n) {
  Values L(n * n, 0.0);
  Values left(n);
  std::vector<bool> used(n, false);
  const auto row = [&](std::size_t i) { return std::span(L).subspan(i * n, n); };
  for (std::size_t i = 0; i < n; ++i) {
    left[i] = R[i * n + i];
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double largest = *std::ranges::max_element(left);
    if (largest <= rounding) {
      break;
    }
    const auto pivot = static_cast<std::size_t>(
        std::ranges::find_if(left, [&](double v) { return v >= as_good * largest; }) -
        left.begin());
    used[pivot] = true;
    const double diagonal = std::sqrt(left[pivot]);
    row(pivot)[k] = diagonal;
    left[pivot] = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      if (!used[i]) {
        row(i)[k] = (R[i * n + pivot] - product(row(i), row(pivot), k)) / diagonal;
        left[i] -= row(i)[k] * row(i)[k];
      }
    }
  }
  return L;
}

}  // namespace

std::optional<Values> semidefinite_root(std::span<const double> C, std::size_t n) {
  Values sd(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(C[i * n + i] >= 0)) {
      return std::nullopt;
    }
    sd[i] = std::sqrt(C[i * n + i]);
  }
  const Values R = correlations(C, sd);
  Values L = root_of_correlations(R, n);
  const auto row = [&](std::size_t i) { return std::span(L).subspan(i * n, n); };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      if (std::abs(R[i * n + j] - product(row(i), row(j), n)) > most_lost) {
        return std::nullopt;
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (double& value : row(i)) {
      value *= sd[i];
    }
  }
  return L;
}

}  // namespace trochoid::numerics
