#include <trochoid/surface/scatter.h>

#include <trochoid/numerics/dense.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace trochoid::surface {

namespace {

using numerics::Matrix;
using Values = std::vector<double>;

constexpr std::size_t fewest_levels = 4;
constexpr std::size_t most_levels = 48;       // of heights, and of places
constexpr std::size_t most_cells = 400;       // of both
constexpr double same_scatter_height = 1e-9;  // [m]

/// Levels of a quantity: its distinct values, or bins where these are very many.
template <class Of>
Sharing levels_of(std::span<const Reading> readings, double apart, const Of& of) {
  Values sorted;
  for (const Reading& r : readings) {
    sorted.push_back(of(r));
  }
  std::sort(sorted.begin(), sorted.end());
  Values starts;
  for (const double v : sorted) {
    if (starts.empty() || v - starts.back() > apart) {
      starts.push_back(v);
    }
  }
  const double from = sorted.front();
  const double reach = sorted.back() - from;
  const auto bins = std::min(most_levels, static_cast<std::size_t>(reach / apart));
  const bool scan = starts.size() < fewest_levels && bins >= 2 * fewest_levels;
  if (starts.size() > most_levels || scan) {
    starts.clear();
    for (std::size_t i = 0; i < bins; ++i) {
      starts.push_back(from +
                       reach * static_cast<double>(i) / static_cast<double>(bins));
    }
  }
  Sharing sharing{.levels = starts.size()};
  for (const Reading& r : readings) {
    const auto after = std::upper_bound(starts.begin(), starts.end(), of(r));
    sharing.level.push_back(static_cast<std::size_t>(after - starts.begin()) - 1);
  }
  return sharing;
}

Sharing cells_of(const Sharing& a, const Sharing& b) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> known;
  Sharing cells;
  for (std::size_t i = 0; i < a.level.size(); ++i) {
    const auto [at, is_new] = known.try_emplace({a.level[i], b.level[i]}, known.size());
    cells.level.push_back(at->second);
  }
  cells.levels = known.size();
  return cells;
}

/// Z^T R, the readings of each row counted: shape (levels, columns).
Matrix sums_over_levels(const Sharing& sharing, const Rows& rows) {
  Matrix sums = numerics::zeros(sharing.levels, rows.columns);
  for (std::size_t i = 0; i < rows.count.size(); ++i) {
    for (std::size_t c = 0; c < rows.columns; ++c) {
      sums(sharing.level[i], c) += rows.count[i] * rows.values[i * rows.columns + c];
    }
  }
  return sums;
}

/// Z_a^T Z_b: readings in both levels.
Matrix shared_counts(const Sharing& a, const Sharing& b,
                     std::span<const double> count) {
  Matrix counts = numerics::zeros(a.levels, b.levels);
  for (std::size_t i = 0; i < count.size(); ++i) {
    counts(a.level[i], b.level[i]) += count[i];
  }
  return counts;
}

Values plain_products(const Rows& rows) {
  const std::size_t n = rows.columns;
  Values G(n * n);
  for (std::size_t i = 0; i < rows.count.size(); ++i) {
    const double* row = rows.values.data() + i * n;
    for (std::size_t a = 0; a < n; ++a) {
      const double weighted = rows.count[i] * row[a];
      for (std::size_t b = a; b < n; ++b) {
        G[a * n + b] += weighted * row[b];
      }
    }
  }
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      G[a * n + b] = G[b * n + a];
    }
  }
  return G;
}

double square_of(const Matrix& A) {
  double sum = 0.0;
  for (const double x : A.values) {
    sum += x * x;
  }
  return sum;
}

/// A of the smaller columns, solved for the columns of B.
Matrix solved(const Matrix& A, const Matrix& B) {
  const numerics::Lu factors = numerics::lu(A);
  Matrix X = numerics::zeros(B.rows, B.columns);
  for (std::size_t c = 0; c < B.columns; ++c) {
    numerics::solve(factors, std::span(B.values).subspan(c * B.rows, B.rows),
                    std::span(X.values).subspan(c * B.rows, B.rows));
  }
  return X;
}

/// What is left of sums over levels once a fit has taken its part.
class Leftover {
 public:
  Leftover(const Rows& rows, std::span<const double> prior, const Values& G)
      : rows_(rows), gram_(numerics::zeros(prior.size(), prior.size())) {
    for (std::size_t a = 0; a < prior.size(); ++a) {
      for (std::size_t b = 0; b < prior.size(); ++b) {
        gram_(a, b) = G[a * rows.columns + b] + (a == b ? prior[a] : 0.0);
      }
    }
  }
  /// Z_a^T M Z_b.
  [[nodiscard]] Matrix between(const Sharing& a, const Sharing& b) const {
    Matrix out = shared_counts(a, b, rows_.count);
    const Matrix from = sums_over_levels(a, rows_);
    const Matrix to = sums_over_levels(b, rows_);
    const std::size_t n = gram_.rows;
    Matrix right = numerics::zeros(n, b.levels);
    for (std::size_t c = 0; c < n; ++c) {
      for (std::size_t k = 0; k < b.levels; ++k) {
        right(c, k) = to(k, c);
      }
    }
    const Matrix part = solved(gram_, right);
    for (std::size_t i = 0; i < a.levels; ++i) {
      for (std::size_t k = 0; k < b.levels; ++k) {
        for (std::size_t c = 0; c < n; ++c) {
          out(i, k) -= from(i, c) * part(c, k);
        }
      }
    }
    return out;
  }

 private:
  const Rows& rows_;
  Matrix gram_;
};

/// Variances that solve E v = q, those that come out negative left out one by one.
Values nonnegative(const Matrix& E, std::span<const double> q) {
  std::vector<std::size_t> in(q.size());
  for (std::size_t i = 0; i < in.size(); ++i) {
    in[i] = i;
  }
  Values v(q.size());
  while (!in.empty()) {
    Matrix part = numerics::zeros(in.size(), in.size());
    Matrix right = numerics::zeros(in.size(), 1);
    for (std::size_t a = 0; a < in.size(); ++a) {
      right(a, 0) = q[in[a]];
      for (std::size_t b = 0; b < in.size(); ++b) {
        part(a, b) = E(in[a], in[b]);
      }
    }
    const Values x = solved(part, right).values;
    const auto worst = std::min_element(x.begin() + 1, x.end());
    std::fill(v.begin(), v.end(), 0.0);
    for (std::size_t a = 0; a < in.size(); ++a) {
      v[in[a]] = x[a];
    }
    if (worst == x.end() || *worst >= 0) {
      break;
    }
    in.erase(in.begin() + (worst - x.begin()));
  }
  return v;
}

}  // namespace

std::vector<Sharing> sharing_of(std::span<const Reading> readings, double feed) {
  const Sharing heights = levels_of(readings, same_scatter_height,
                                    [](const Reading& r) { return r.height; });
  const Sharing places =
      levels_of(readings, 1.5 * feed, [](const Reading& r) { return r.x; });
  std::vector<Sharing> all;
  for (const Sharing* sharing : {&heights, &places}) {
    // Of one row a level, nobody can say what is shared.
    if (sharing->levels >= fewest_levels && 2 * sharing->levels <= readings.size()) {
      all.push_back(*sharing);
    }
  }
  if (heights.levels > 1 && places.levels > 1) {
    const Sharing cells = cells_of(heights, places);
    if (cells.levels >= 2 * fewest_levels && cells.levels <= most_cells &&
        2 * cells.levels < readings.size()) {
      all.push_back(cells);
    }
  }
  return all;
}

std::vector<double> weighted_products(const Rows& rows, const Scatter& scatter) {
  Values G = plain_products(rows);
  const std::size_t n = rows.columns;
  std::vector<std::size_t> in;
  std::size_t levels = 0;
  for (std::size_t l = 0; l < scatter.ratio.size(); ++l) {
    if (scatter.ratio[l] > 0) {
      in.push_back(l);
      levels += scatter.sharings[l].levels;
    }
  }
  if (in.empty()) {
    return G;
  }
  // (D + Z V Z^T)^-1 = D^-1 - D^-1 Z (V^-1 + Z^T D^-1 Z)^-1 Z^T D^-1
  Matrix K = numerics::zeros(levels, levels);
  Matrix S = numerics::zeros(levels, n);
  std::size_t row = 0;
  for (const std::size_t a : in) {
    const Sharing& of = scatter.sharings[a];
    const Matrix sums = sums_over_levels(of, rows);
    std::size_t column = 0;
    for (const std::size_t b : in) {
      const Matrix counts = shared_counts(of, scatter.sharings[b], rows.count);
      for (std::size_t i = 0; i < counts.rows; ++i) {
        for (std::size_t k = 0; k < counts.columns; ++k) {
          K(row + i, column + k) = counts(i, k);
        }
      }
      column += counts.columns;
    }
    for (std::size_t i = 0; i < of.levels; ++i) {
      K(row + i, row + i) += 1 / scatter.ratio[a];
      for (std::size_t c = 0; c < n; ++c) {
        S(row + i, c) = sums(i, c);
      }
    }
    row += of.levels;
  }
  const Matrix X = solved(K, S);
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) {
      for (std::size_t i = 0; i < levels; ++i) {
        G[a * n + b] -= S(i, a) * X(i, b);
      }
    }
  }
  return G;
}

Scatter estimate_scatter(const Rows& rows, std::span<const double> prior,
                         std::vector<Sharing> sharings, double within,
                         double readings) {
  const std::size_t n = prior.size();
  const Values G = plain_products(rows);
  const Leftover leftover(rows, prior, G);
  const std::size_t k = sharings.size();
  Matrix E = numerics::zeros(k + 1, k + 1);
  Values q(k + 1);
  const double freedom = std::max(1.0, readings - static_cast<double>(n));
  E(0, 0) = freedom;
  q[0] = within + G[n * rows.columns + n];
  Scatter scatter{.freedom = {freedom}};
  for (std::size_t a = 0; a < k; ++a) {
    const Matrix own = leftover.between(sharings[a], sharings[a]);
    double trace = 0.0;
    for (std::size_t i = 0; i < own.rows; ++i) {
      trace += own(i, i);
    }
    E(0, a + 1) = trace;
    E(a + 1, 0) = trace;
    E(a + 1, a + 1) = square_of(own);
    for (std::size_t b = 0; b < a; ++b) {
      E(a + 1, b + 1) = square_of(leftover.between(sharings[a], sharings[b]));
      E(b + 1, a + 1) = E(a + 1, b + 1);
    }
    const Matrix sums = sums_over_levels(sharings[a], rows);
    for (std::size_t i = 0; i < sums.rows; ++i) {
      q[a + 1] += sums(i, n) * sums(i, n);
    }
    scatter.freedom.push_back(std::max(1.0, trace * trace / E(a + 1, a + 1)));
  }
  const Values v = nonnegative(E, q);
  scatter.s2 = v[0];
  for (std::size_t a = 0; a < k; ++a) {
    scatter.ratio.push_back(v[0] > 0 ? v[a + 1] / v[0] : 0.0);
  }
  scatter.sharings = std::move(sharings);
  return scatter;
}

}  // namespace trochoid::surface
