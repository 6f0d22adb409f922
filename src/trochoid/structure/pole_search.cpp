#include <trochoid/numerics/dense.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/structure/pole_search.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

constexpr int rounds = 15;
/// Poles that move by less than this part of themselves stand.
constexpr double settled_poles = 1e-9;
constexpr double first_damping = 0.01;
constexpr double renewed_damping = 0.1;
constexpr double pole_rank_tolerance = 1e-13;
constexpr Complex i{0.0, 1.0};

/// The lines of a response, scaled to about one.
struct Lines {
  std::vector<Complex> s;  ///< i omega/omega_max
  std::vector<Complex> f;  ///< M-4, scaled: H = f * receptance
  std::vector<Complex> H;  ///< over its largest magnitude
  double omega_max = 1.0;
  double H_max = 1.0;
  double f_max = 1.0;
};

Lines scaled(const FrequencyResponse& response) {
  Lines lines;
  lines.omega_max = response.omega.back();
  lines.f_max = std::abs(factor(response.kind, lines.omega_max));
  for (const Complex& H : response.H) {
    lines.H_max = std::max(lines.H_max == 1.0 ? 0.0 : lines.H_max, std::abs(H));
  }
  if (lines.H_max == 0.0) {
    lines.H_max = 1.0;
  }
  for (std::size_t n = 0; n < response.omega.size(); ++n) {
    lines.s.push_back(i * (response.omega[n] / lines.omega_max));
    lines.f.push_back(factor(response.kind, response.omega[n]) / lines.f_max);
    lines.H.push_back(response.H[n] / lines.H_max);
  }
  return lines;
}

/// The partial fractions of one line: two real
/// coefficients a pair, then the residual terms.
std::vector<Complex> fractions(Complex s, const std::vector<Complex>& poles,
                               bool residual_terms) {
  std::vector<Complex> row;
  for (const Complex& p : poles) {
    const Complex one = 1.0 / (s - p);
    const Complex other = 1.0 / (s - std::conj(p));
    row.push_back(one + other);
    row.push_back(i * (one - other));
  }
  if (residual_terms) {
    row.emplace_back(1.0);
    row.push_back(1.0 / (s * s));
  }
  return row;
}

/// min |A x - b| over complex rows, real x.
numerics::LeastSquares solve(const std::vector<Complex>& A, std::size_t columns,
                             const std::vector<Complex>& b) {
  std::vector<double> rows(2 * A.size());
  std::vector<double> right(2 * b.size());
  for (std::size_t n = 0; n < b.size(); ++n) {
    for (std::size_t k = 0; k < columns; ++k) {
      rows[2 * n * columns + k] = A[n * columns + k].real();
      rows[(2 * n + 1) * columns + k] = A[n * columns + k].imag();
    }
    right[2 * n] = b[n].real();
    right[2 * n + 1] = b[n].imag();
  }
  return numerics::least_squares(rows, static_cast<int>(columns), right,
                                 pole_rank_tolerance);
}

/// Zeros of 1 + sum of c * fractions: eigenvalues of the poles less what c adds.
std::vector<Complex> zeros(const std::vector<Complex>& poles, const double* c) {
  const std::size_t n = 2 * poles.size();
  numerics::Matrix M = numerics::zeros(n, n);
  for (std::size_t r = 0; r < n; r += 2) {
    const Complex p = poles[r / 2];
    M(r, r) = p.real();
    M(r, r + 1) = p.imag();
    M(r + 1, r) = -p.imag();
    M(r + 1, r + 1) = p.real();
    for (std::size_t k = 0; k < n; ++k) {
      M(r, k) -= 2 * c[k];
    }
  }
  const std::vector<Complex> all = numerics::eigenvalues(M);
  std::vector<Complex> found;
  for (const Complex& z : all) {
    if (z.imag() > 0) {
      found.emplace_back(-std::abs(z.real()), z.imag());
    }
  }
  // Two real zeros are no vibration: look again where the slower one is.
  for (std::size_t k = 0; k < n && found.size() < poles.size(); ++k) {
    if (all[k].imag() == 0) {
      const double at = std::clamp(std::abs(all[k].real()), 0.01, 1.0);
      found.emplace_back(-renewed_damping * at, at);
    }
  }
  // Where a response holds next to nothing the zeros may be no numbers: those poles stay.
  while (found.size() < poles.size()) {
    found.push_back(poles[found.size()]);
  }
  return found;
}

/// One round of M-5.
std::vector<Complex> relocated(const Lines& lines, const std::vector<Complex>& poles,
                               bool residual_terms) {
  const std::size_t own = 2 * poles.size();
  const std::size_t columns = 2 * own + (residual_terms ? 2 : 0);
  std::vector<Complex> A;
  A.reserve(columns * lines.s.size());
  for (std::size_t n = 0; n < lines.s.size(); ++n) {
    const auto row = fractions(lines.s[n], poles, residual_terms);
    for (const Complex& value : row) {
      A.push_back(value * lines.f[n]);
    }
    for (std::size_t k = 0; k < own; ++k) {
      A.push_back(-lines.H[n] * row[k]);
    }
  }
  const auto fit = solve(A, columns, lines.H);
  return zeros(poles, fit.x.data() + (columns - own));
}

Poles with_residues(const Lines& lines, const std::vector<Complex>& poles,
                    bool residual_terms) {
  const std::size_t columns = 2 * poles.size() + (residual_terms ? 2 : 0);
  std::vector<Complex> A;
  double sum = 0.0;
  for (std::size_t n = 0; n < lines.s.size(); ++n) {
    for (const Complex& value : fractions(lines.s[n], poles, residual_terms)) {
      A.push_back(value * lines.f[n]);
    }
    sum += std::norm(lines.H[n]);
  }
  const auto fit = solve(A, columns, lines.H);
  Poles out;
  out.explained = sum > 0 ? 1 - fit.rss / sum : 0.0;
  const double scale = lines.H_max / lines.f_max * lines.omega_max;
  for (std::size_t r = 0; r < poles.size(); ++r) {
    out.pairs.push_back({.p = poles[r] * lines.omega_max,
                         .R = Complex(fit.x[2 * r], fit.x[2 * r + 1]) * scale});
  }
  return out;
}

}  // namespace

Poles find_poles(const FrequencyResponse& response, int count, bool residual_terms) {
  const Lines lines = scaled(response);
  const double low = lines.s.front().imag();
  std::vector<Complex> poles;
  for (int r = 0; r < count; ++r) {
    const double at = low + (1 - low) * (r + 0.5) / count;
    poles.emplace_back(-first_damping * at, at);
  }
  double moved = 1.0;
  for (int round = 0; round < rounds && moved > settled_poles; ++round) {
    std::vector<Complex> next = relocated(lines, poles, residual_terms);
    moved = 0.0;
    for (std::size_t r = 0; r < poles.size(); ++r) {
      moved = std::max(moved, std::abs(next[r] - poles[r]) / std::abs(next[r]));
    }
    poles = std::move(next);
  }
  Poles out = with_residues(lines, poles, residual_terms);
  const auto peak = [&](const Pole& pole) {
    return std::abs(pole.R) / std::abs(pole.p.real()) *
           std::abs(factor(response.kind, std::abs(pole.p)));
  };
  std::stable_sort(out.pairs.begin(), out.pairs.end(),
                   [&](const Pole& a, const Pole& b) { return peak(a) > peak(b); });
  return out;
}

}  // namespace trochoid::structure
