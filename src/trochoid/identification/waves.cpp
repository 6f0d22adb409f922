#include <trochoid/identification/waves.h>

#include <trochoid/base/index.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {
namespace {

/// Angles of which all waves stay in a near cache.
constexpr std::size_t stretch = 128;

/// What a wave adds to those before it, of its own square: with less, products of waves lose
/// more of the basis than rounding.
constexpr double least_added = 1e-3;

/// Waves at some angles, wave by wave, shape (terms, angles).
void fill_stretch(std::span<const double> angle, std::size_t terms,
                  std::vector<double>& out) {
  const std::size_t n = angle.size();
  out.resize(terms * n);
  std::fill_n(out.begin(), n, 1.0);
  if (terms < 3) return;
  double* const c1 = &out[n];
  double* const s1 = c1 + n;
  for (std::size_t g = 0; g < n; ++g) {
    c1[g] = std::cos(angle[g]);
    s1[g] = std::sin(angle[g]);
  }
  for (std::size_t k = 3; k + 1 < terms; k += 2) {
    const double* const c = &out[(k - 2) * n];
    const double* const s = c + n;
    double* const next = &out[k * n];
    for (std::size_t g = 0; g < n; ++g) next[g] = c[g] * c1[g] - s[g] * s1[g];
    for (std::size_t g = 0; g < n; ++g) next[n + g] = s[g] * c1[g] + c[g] * s1[g];
  }
}

/// Products of the first waves with more of them, from the sums of waves: of squares of the
/// weights S, shape (rows, terms).
std::vector<double> products_of_waves(std::span<const double> S, std::size_t rows,
                                      std::size_t terms) {
  const auto cosine = [&](std::size_t m) { return m == 0 ? S[0] : S[2 * m - 1]; };
  const auto sine = [&](std::size_t m) { return m == 0 ? 0.0 : S[2 * m]; };
  std::vector<double> out(rows * terms);
  for (std::size_t i = 0; i < rows; ++i) {
    const std::size_t k = (i + 1) / 2;
    const bool sine_i = i > 0 && i % 2 == 0;
    for (std::size_t j = 0; j < terms; ++j) {
      const std::size_t m = (j + 1) / 2;
      const bool sine_j = j > 0 && j % 2 == 0;
      const std::size_t apart = k > m ? k - m : m - k;
      const double sign = k >= m ? 1.0 : -1.0;  // of the sine of the difference
      double& to = out[i * terms + j];
      if (sine_i == sine_j) {
        to = 0.5 * (cosine(apart) + (sine_i ? -1.0 : 1.0) * cosine(k + m));
      } else {
        to = 0.5 * (sine(k + m) + (sine_i ? sign : -sign) * sine(apart));
      }
    }
  }
  return out;
}

/// Sums of the waves over squares of the weights.
std::vector<double> sums_of_waves(const WeightedAngles& at, std::size_t terms) {
  std::vector<double> squares;
  squares.reserve(at.weight.size());
  for (const double w : at.weight) squares.push_back(w * w);
  return wave_products(at.angle, {squares, squares.size()}, terms);
}

/// L of G = L L^T, in place in its lower triangle; what is above it becomes zero.
/// @return whether every wave adds enough to those before it
bool cholesky(std::vector<double>& G, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) {
    double* const row = &G[j * n];
    for (std::size_t k = 0; k < j; ++k) {
      const double* const other = &G[k * n];
      double sum = row[k];
      for (std::size_t i = 0; i < k; ++i) sum -= row[i] * other[i];
      row[k] = sum / other[k];
    }
    double pivot = row[j];
    for (std::size_t i = 0; i < j; ++i) pivot -= row[i] * row[i];
    if (!(pivot > least_added * row[j])) return false;
    row[j] = std::sqrt(pivot);
    std::fill(row + j + 1, row + n, 0.0);
  }
  return true;
}

/// L^-1 B in place, B row-major, shape (n, columns).
void solve_lower(std::span<const double> L, std::size_t n, std::size_t columns,
                 std::vector<double>& B) {
  for (std::size_t k = 0; k < n; ++k) {
    double* const to = &B[k * columns];
    for (std::size_t i = 0; i < k; ++i) {
      const double l = L[k * n + i];
      const double* const from = &B[i * columns];
      for (std::size_t c = 0; c < columns; ++c) to[c] -= l * from[c];
    }
    for (std::size_t c = 0; c < columns; ++c) to[c] /= L[k * n + k];
  }
}

WaveBasis basis_by_reflections(const WeightedAngles& at, std::size_t terms) {
  std::vector<double> A(at.angle.size() * terms);
  for (std::size_t g = 0; g < at.angle.size(); ++g) {
    const std::span<double> row = std::span(A).subspan(g * terms, terms);
    fill_waves(at.angle[g], row);
    for (double& wave : row) wave *= at.weight[g];
  }
  WaveBasis out;
  out.columns = numerics::orthonormal(A, static_cast<int>(terms), 0.0);
  out.size = out.columns.size() / at.angle.size();
  return out;
}

/// Columns times some weights of their rows.
std::vector<double> weighted(const numerics::Columns& X, std::span<const double> weight,
                             int power) {
  std::vector<double> out;
  out.reserve(X.count() * X.rows);
  for (std::size_t c = 0; c < X.count(); ++c) {
    const std::span<const double> x = X[c];
    for (std::size_t g = 0; g < x.size(); ++g) {
      out.push_back((power == 2 ? weight[g] * weight[g] : weight[g]) * x[g]);
    }
  }
  return out;
}

/// E by columns, of a basis that has them.
std::vector<double> by_columns(const WaveBasis& basis) {
  const std::size_t u = basis.columns.size() / basis.size;
  std::vector<double> out(basis.columns.size());
  for (std::size_t g = 0; g < u; ++g) {
    for (std::size_t k = 0; k < basis.size; ++k) {
      out[k * u + g] = basis.columns[g * basis.size + k];
    }
  }
  return out;
}

}  // namespace

void fill_waves(double angle, std::span<double> out) noexcept {
  out[0] = 1.0;
  double c = 1.0;
  double s = 0.0;
  const double c1 = std::cos(angle);
  const double s1 = std::sin(angle);
  for (std::size_t k = 1; k + 1 < out.size(); k += 2) {
    const double next = c * c1 - s * s1;
    s = s * c1 + c * s1;
    c = next;
    out[k] = c;
    out[k + 1] = s;
  }
}

std::vector<double> wave_products(std::span<const double> angle,
                                  const numerics::Columns& X, std::size_t terms) {
  const std::size_t count = X.count();
  std::vector<double> out(terms * count, 0.0);
  std::vector<double> part(out.size());
  std::vector<double> waves;
  for (std::size_t from = 0; from < angle.size(); from += stretch) {
    const std::size_t n = std::min(stretch, angle.size() - from);
    fill_stretch(angle.subspan(from, n), terms, waves);
    numerics::inner_products({waves, n}, {X.values.subspan(from), n, X.stride}, part);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += part[i];
  }
  return out;
}

std::vector<double> sum_of_waves(std::span<const double> angle,
                                 std::span<const double> a) {
  std::vector<double> out(angle.size(), 0.0);
  std::vector<double> waves;
  for (std::size_t from = 0; from < angle.size(); from += stretch) {
    const std::size_t n = std::min(stretch, angle.size() - from);
    fill_stretch(angle.subspan(from, n), a.size(), waves);
    numerics::add_combination({waves, n}, a, 1.0, std::span(out).subspan(from, n));
  }
  return out;
}

WaveBasis wave_basis(const WeightedAngles& at, int harmonics) {
  const std::size_t terms = 2 * base::index(harmonics) + 1;
  std::vector<double> G =
      products_of_waves(sums_of_waves(at, 2 * terms - 1), terms, terms);
  if (!cholesky(G, terms)) return basis_by_reflections(at, terms);
  return {terms, std::move(G), {}};
}

std::vector<double> coordinates(const WaveBasis& basis, const WeightedAngles& at,
                                const numerics::Columns& X) {
  if (!basis.by_root()) {
    const std::vector<double> E = by_columns(basis);
    const std::vector<double> wX = weighted(X, at.weight, 1);
    std::vector<double> out(basis.size * X.count());
    numerics::inner_products({E, X.rows}, {wX, X.rows}, out);
    return out;
  }
  const std::vector<double> wX = weighted(X, at.weight, 2);
  std::vector<double> out = wave_products(at.angle, {wX, X.rows}, basis.size);
  solve_lower(basis.root, basis.size, X.count(), out);
  return out;
}

std::vector<double> amplitudes(const WaveBasis& basis, std::span<const double> c,
                               std::size_t columns) {
  const std::size_t n = basis.size;
  std::vector<double> out(c.begin(), c.end());
  for (std::size_t k = n; k-- > 0;) {  // L^T a = c
    double* const own = &out[k * columns];
    for (std::size_t q = 0; q < columns; ++q) own[q] /= basis.root[k * n + k];
    for (std::size_t i = 0; i < k; ++i) {
      const double l = basis.root[k * n + i];
      for (std::size_t q = 0; q < columns; ++q) out[i * columns + q] -= l * own[q];
    }
  }
  return out;
}

std::vector<double> from_coordinates(const WaveBasis& basis, const WeightedAngles& at,
                                     std::span<const double> c) {
  if (basis.by_root()) return sum_of_waves(at.angle, amplitudes(basis, c, 1));
  std::vector<double> out;
  out.reserve(at.angle.size());
  for (std::size_t g = 0; g < at.angle.size(); ++g) {
    out.push_back(
        numerics::dot(c, std::span(basis.columns).subspan(g * basis.size, basis.size)) /
        at.weight[g]);
  }
  return out;
}

std::vector<double> band_by_waves(const WaveBasis& basis, const WeightedAngles& at,
                                  std::size_t terms) {
  const std::size_t n = basis.size;
  if (basis.by_root()) {
    std::vector<double> out(n * terms, 0.0);
    if (terms > n) {
      out = products_of_waves(sums_of_waves(at, n + terms - 1), n, terms);
      solve_lower(basis.root, n, terms, out);
    }
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t m = 0; m < std::min(n, terms); ++m) {
        out[k * terms + m] = basis.root[m * n + k];
      }
    }
    return out;
  }
  std::vector<double> E = by_columns(basis);
  const std::size_t u = at.angle.size();
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t g = 0; g < u; ++g) E[k * u + g] *= at.weight[g];
  }
  const std::vector<double> by_wave = wave_products(at.angle, {E, u}, terms);
  std::vector<double> out(n * terms);
  for (std::size_t m = 0; m < terms; ++m) {
    for (std::size_t k = 0; k < n; ++k) out[k * terms + m] = by_wave[m * n + k];
  }
  return out;
}

}  // namespace trochoid::identification
