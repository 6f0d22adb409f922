#include <trochoid/numerics/combinations.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trochoid::numerics {

namespace {

/// Weights below this, of columns of length one, are rounding.
constexpr double least_weight = 1e-6;

/// Places of the columns that hold anything.
std::vector<std::size_t> columns_in_use(std::span<const double> A, std::size_t n) {
  std::vector<std::size_t> out;
  for (std::size_t c = 0; c < n; ++c) {
    bool used = false;
    for (std::size_t i = c; i < A.size() && !used; i += n) used = A[i] != 0.0;
    if (used) out.push_back(c);
  }
  return out;
}

std::vector<double> some_columns(std::span<const double> A, std::size_t n,
                                 std::span<const std::size_t> columns) {
  std::vector<double> out;
  out.reserve(A.size() / n * columns.size());
  for (std::size_t row = 0; row < A.size(); row += n) {
    for (const std::size_t c : columns) out.push_back(A[row + c]);
  }
  return out;
}

/// Projection onto the row space, of columns of length one.
std::vector<double> row_projection(const LeastSquares& solved, std::size_t n) {
  std::vector<double> P(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) P[i * n + i] = 1.0;
  for (std::size_t k = 0; k + n <= solved.null_space.size(); k += n) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        P[i * n + j] -= solved.null_space[k + i] * solved.null_space[k + j];
      }
    }
  }
  return P;
}

/// @brief Reduced echelon form of the rows of P, in place.
/// @return the pivots, ascending; row i is that of pivot i
std::vector<std::size_t> echelon(std::vector<double>& P, std::size_t n) {
  std::vector<std::size_t> pivots;
  for (std::size_t c = 0; c < n && pivots.size() < n; ++c) {
    const std::size_t top = pivots.size();
    std::size_t best = top;
    for (std::size_t i = top; i < n; ++i) {
      if (std::abs(P[i * n + c]) > std::abs(P[best * n + c])) best = i;
    }
    if (std::abs(P[best * n + c]) < least_weight) continue;
    std::swap_ranges(&P[best * n], &P[best * n] + n, &P[top * n]);
    const double pivot = P[top * n + c];
    for (std::size_t j = 0; j < n; ++j) P[top * n + j] /= pivot;
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = P[i * n + c];
      if (i == top || factor == 0.0) continue;
      for (std::size_t j = 0; j < n; ++j) P[i * n + j] -= factor * P[top * n + j];
    }
    pivots.push_back(c);
  }
  return pivots;
}

}  // namespace

bool Combinations::alone(std::size_t i) const noexcept {
  const std::size_t n = x.size();
  const auto others = std::count_if(&weights[i * n], &weights[i * n] + n,
                                    [](double w) { return w != 0.0; });
  return others == 1;
}

Combinations known_combinations(std::span<const double> A, int n,
                                std::span<const double> b, double rank_tolerance) {
  const auto count = static_cast<std::size_t>(n);
  if (n < 1 || A.size() != b.size() * count) {
    throw std::invalid_argument("known_combinations: shapes do not agree");
  }
  Combinations out;
  out.x.assign(count, 0.0);
  out.residual.assign(b.begin(), b.end());
  for (const double r : b) out.rss += r * r;
  const auto used = columns_in_use(A, count);
  if (used.empty()) return out;
  const std::size_t m = used.size();
  const LeastSquares all = least_squares(some_columns(A, count, used),
                                         static_cast<int>(m), b, rank_tolerance);
  std::vector<double> P = row_projection(all, m);
  const auto pivots = echelon(P, m);
  for (const std::size_t p : pivots) out.pivots.push_back(used[p]);
  const LeastSquares solved =
      least_squares(some_columns(A, count, out.pivots), static_cast<int>(pivots.size()),
                    b, rank_tolerance * least_weight);
  out.weights.assign(pivots.size() * count, 0.0);
  for (std::size_t i = 0; i < pivots.size(); ++i) {
    for (std::size_t j = 0; j < m; ++j) {
      const double w = P[i * m + j];
      if (std::abs(w) < least_weight) continue;
      out.weights[i * count + used[j]] = w * all.norms[j] / all.norms[pivots[i]];
    }
    out.weights[i * count + out.pivots[i]] = 1.0;
    out.x[out.pivots[i]] = solved.x[i];
  }
  out.value = solved.x;
  out.covariance = solved.inverse_gram;
  const auto r = static_cast<std::size_t>(std::max(all.rank, 1));
  out.condition = all.singular_values[0] / all.singular_values[r - 1];
  out.rss = solved.rss;
  out.residual = solved.residual;
  return out;
}

}  // namespace trochoid::numerics
