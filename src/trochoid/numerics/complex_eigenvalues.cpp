#include <trochoid/numerics/complex_eigenvalues.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

// Eigenvalues alone need neither vectors nor the triangular form that Eigen computes for them.
// The matrices here have about twelve rows, and there are 100,000 of them in a diagram.

namespace trochoid::numerics {

namespace {

using Complex = std::complex<double>;
using ComplexDense = Eigen::MatrixXcd;

/// The operator of C++ also looks for infinities.
Complex times(Complex a, Complex b) noexcept {
  return {a.real() * b.real() - a.imag() * b.imag(),
          a.real() * b.imag() + a.imag() * b.real()};
}

double size_of(Complex a) noexcept {
  return std::abs(a.real()) + std::abs(a.imag());
}

/// A square matrix, row-major.
struct Square {
  std::vector<Complex> a;
  std::size_t n = 0;

  Complex* row(std::size_t i) noexcept { return &a[i * n]; }
  Complex& at(std::size_t i, std::size_t j) noexcept { return a[i * n + j]; }
};

/// Make zeros below the subdiagonal by elimination with row pivots; eigenvalues stay.
void reduce_to_hessenberg(Square& A) {
  const std::size_t n = A.n;
  std::vector<Complex> factor(n);
  for (std::size_t m = 1; m + 1 < n; ++m) {
    std::size_t pivot = m;
    for (std::size_t i = m + 1; i < n; ++i) {
      if (size_of(A.at(i, m - 1)) > size_of(A.at(pivot, m - 1))) pivot = i;
    }
    if (size_of(A.at(pivot, m - 1)) == 0.0) continue;
    if (pivot != m) {
      std::swap_ranges(A.row(m), A.row(m) + n, A.row(pivot));
      for (std::size_t i = 0; i < n; ++i) std::swap(A.at(i, m), A.at(i, pivot));
    }
    const Complex* above = A.row(m);
    for (std::size_t i = m + 1; i < n; ++i) {
      Complex* row = A.row(i);
      factor[i] = row[m - 1] / above[m - 1];
      row[m - 1] = 0.0;
      for (std::size_t j = m; j < n; ++j) row[j] -= times(factor[i], above[j]);
    }
    for (std::size_t r = 0; r < n; ++r) {
      Complex* row = A.row(r);
      Complex sum = row[m];
      for (std::size_t i = m + 1; i < n; ++i) sum += times(factor[i], row[i]);
      row[m] = sum;
    }
  }
}

/// Rows or columns from the first up to and with the last.
struct Window {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// The eigenvalue of the last two rows that is nearer to the last entry (Wilkinson).
Complex shift_of(Square& H, const Window& w) {
  const Complex d = H.at(w.last, w.last);
  const Complex half = 0.5 * (H.at(w.last - 1, w.last - 1) - d);
  const Complex off = times(H.at(w.last - 1, w.last), H.at(w.last, w.last - 1));
  Complex root = std::sqrt(times(half, half) + off);
  if (half.real() * root.real() + half.imag() * root.imag() < 0) root = -root;
  const Complex sum = half + root;
  return size_of(sum) > 0 ? d - off / sum : d;
}

/// A rotation of two rows: (c, s; -s*, c).
struct Rotation {
  double c = 1.0;
  Complex s = 0.0;
};

/// The rotation that makes b zero, and a what both come to.
Rotation rotation_of(Complex& a, Complex& b) {
  const double size_b = std::norm(b);
  if (size_b == 0.0) return {};
  const double size_a = std::norm(a);
  const double length = std::sqrt(size_a + size_b);
  if (size_a == 0.0) {
    const Rotation out{0.0, std::conj(b) / std::sqrt(size_b)};
    a = length;
    b = 0.0;
    return out;
  }
  const double c = std::sqrt(size_a) / length;
  const Complex unit = a / std::sqrt(size_a);
  const Rotation out{c, times(unit, std::conj(b)) / length};
  a = unit * length;
  b = 0.0;
  return out;
}

/// H - shift = Q R, then H = R Q + shift, within the window.
void qr_step(Square& H, const Window& w, Complex shift, std::vector<Rotation>& turned) {
  for (std::size_t k = w.first; k <= w.last; ++k) H.at(k, k) -= shift;
  for (std::size_t k = w.first; k < w.last; ++k) {
    Complex* upper = H.row(k);
    Complex* lower = H.row(k + 1);
    const auto [c, s] = turned[k] = rotation_of(upper[k], lower[k]);
    for (std::size_t j = k + 1; j <= w.last; ++j) {
      const Complex x = upper[j];
      upper[j] = c * x + times(s, lower[j]);
      lower[j] = c * lower[j] - times(std::conj(s), x);
    }
  }
  for (std::size_t r = w.first; r <= w.last; ++r) {
    Complex* row = H.row(r);
    for (std::size_t k = std::max(w.first + 1, r) - 1; k < w.last; ++k) {
      const auto& [c, s] = turned[k];
      const Complex x = row[k];
      row[k] = c * x + times(std::conj(s), row[k + 1]);
      row[k + 1] = c * row[k + 1] - times(s, x);
    }
  }
  for (std::size_t k = w.first; k <= w.last; ++k) H.at(k, k) += shift;
}

/// Where the block that ends at `last` begins: what is above it is coupled to it by nothing.
std::size_t begin_of_block(Square& H, std::size_t last) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  std::size_t first = last;
  while (first > 0) {
    const double beside =
        size_of(H.at(first - 1, first - 1)) + size_of(H.at(first, first));
    if (size_of(H.at(first, first - 1)) <= epsilon * beside) break;
    --first;
  }
  return first;
}

/// @return empty where the steps do not end
std::vector<Complex> eigenvalues_of_hessenberg(Square& H) {
  constexpr int most_steps = 60;  // for one eigenvalue
  constexpr int unusual = 10;     // after so many a shift that breaks a circle
  std::vector<Complex> out;
  std::vector<Rotation> turned(H.n);
  std::size_t left = H.n;
  for (int steps = 0; left > 0; ++steps) {
    const Window w{begin_of_block(H, left - 1), left - 1};
    if (w.first == w.last) {
      out.push_back(H.at(w.last, w.last));
      --left;
      steps = -1;
      continue;
    }
    if (steps == most_steps) return {};
    const bool circle = steps > 0 && steps % unusual == 0;
    const Complex shift =
        circle ? Complex(size_of(H.at(w.last, w.last - 1)), 0.0) : shift_of(H, w);
    qr_step(H, w, shift, turned);
  }
  return out;
}

Eigen::Map<const ComplexDense> square(std::span<const Complex> A, std::size_t n) {
  if (n == 0 || A.size() != n * n) {
    throw std::invalid_argument("complex_eigenvalues: the matrix is not (n, n), n > 0");
  }
  const auto size = static_cast<Eigen::Index>(n);
  return {A.data(), size, size};
}

}  // namespace

std::vector<Complex> complex_eigenvalues(std::span<const Complex> A, std::size_t n) {
  const auto map = square(A, n);
  Square H{{A.begin(), A.end()},
           n};  // row-major: the transpose has the same eigenvalues
  reduce_to_hessenberg(H);
  std::vector<Complex> out = eigenvalues_of_hessenberg(H);
  if (!out.empty()) return out;
  const Eigen::ComplexEigenSolver<ComplexDense> solver(map, false);
  const auto& values = solver.eigenvalues();
  return {values.data(), values.data() + values.size()};
}

double eigenvalue_bound(std::span<const Complex> A, std::size_t n) {
  const auto map = square(A, n);
  const ComplexDense second = map * map;
  const ComplexDense fourth = second * second;
  const Eigen::MatrixXd size = fourth.cwiseAbs2().cwiseSqrt();
  const double columns = size.colwise().sum().maxCoeff();
  const double rows = size.rowwise().sum().maxCoeff();
  return std::sqrt(std::sqrt(std::min({columns, rows, size.norm()})));
}

}  // namespace trochoid::numerics
