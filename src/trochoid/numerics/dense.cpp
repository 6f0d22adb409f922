#include <trochoid/numerics/dense.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <unsupported/Eigen/MatrixFunctions>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::numerics {

namespace {

using Dense = Eigen::MatrixXd;
using ConstColumnMap = Eigen::Map<const Dense>;
using Vector = Eigen::Map<Eigen::VectorXd>;
using ConstVector = Eigen::Map<const Eigen::VectorXd>;

Eigen::Index index(std::size_t i) {
  return static_cast<Eigen::Index>(i);
}

ConstColumnMap columns_of(const Matrix& A) {
  return {A.values.data(), index(A.rows), index(A.columns)};
}

Matrix plain(const Dense& A) {
  return {static_cast<std::size_t>(A.rows()),
          static_cast<std::size_t>(A.cols()),
          {A.data(), A.data() + A.size()}};
}

double sum_of_sizes(std::span<const double> column) {
  double sum = 0.0;
  for (const double value : column) sum += std::abs(value);
  return sum;
}

using Complex = std::complex<double>;

/// Of unit length, by two steps of inverse iteration.
std::vector<Complex> hessenberg_vector(const ConstColumnMap& H, Complex eigenvalue) {
  const Eigen::Index n = H.rows();
  const double size = H.cwiseAbs().maxCoeff();
  const double least = size > 0 ? 1e-16 * size : 1.0;
  Eigen::MatrixXcd U = H.cast<Complex>();
  U.diagonal().array() -= eigenvalue;
  Eigen::VectorXcd y = Eigen::VectorXcd::Ones(n);
  std::vector<char> exchanged(static_cast<std::size_t>(n));
  for (int step = 0; step < 2; ++step) {
    for (Eigen::Index k = 0; k + 1 < n; ++k) {
      char& swapped = exchanged[static_cast<std::size_t>(k)];
      const Eigen::Index rest = n - k - 1;
      if (step == 0) {  // the factor takes the place of what it takes away
        swapped = std::norm(U(k + 1, k)) > std::norm(U(k, k)) ? 1 : 0;
        if (swapped != 0) U.row(k).tail(rest + 1).swap(U.row(k + 1).tail(rest + 1));
        U(k + 1, k) = U(k, k) == 0.0 ? 0.0 : U(k + 1, k) / U(k, k);
        U.row(k + 1).tail(rest) -= U(k + 1, k) * U.row(k).tail(rest);
      } else {
        if (swapped != 0) std::swap(y(k), y(k + 1));
        y(k + 1) -= U(k + 1, k) * y(k);
      }
    }
    for (Eigen::Index k = n; k-- > 0;) {
      const Complex above = (U.row(k).tail(n - k - 1) * y.tail(n - k - 1)).value();
      y(k) = (y(k) - above) / (std::abs(U(k, k)) < least ? least : U(k, k));
    }
    y /= y.norm();
  }
  return {y.data(), y.data() + n};
}

}  // namespace

void add_product(double factor, std::span<const double> A, std::span<const double> x,
                 std::span<double> y) noexcept {
  const ConstColumnMap a(A.data(), index(y.size()), index(x.size()));
  Vector(y.data(), a.rows()).noalias() += factor * a * ConstVector(x.data(), a.cols());
}

void transposed_product(std::span<const double> A, std::span<const double> x,
                        std::span<double> y) noexcept {
  const ConstColumnMap a(A.data(), index(x.size()), index(y.size()));
  Vector(y.data(), a.cols()).noalias() =
      a.transpose() * ConstVector(x.data(), a.rows());
}

Lu lu(const Matrix& A) {
  const Eigen::PartialPivLU<Dense> own(columns_of(A));
  const auto& place = own.permutationP().indices();
  return {plain(own.matrixLU()), {place.data(), place.data() + place.size()}};
}

void solve(const Lu& lu, std::span<const double> b, std::span<double> x) noexcept {
  for (std::size_t i = 0; i < b.size(); ++i) {
    x[static_cast<std::size_t>(lu.place[i])] = b[i];
  }
  const ConstColumnMap factors = columns_of(lu.factors);
  Vector out(x.data(), factors.rows());
  factors.triangularView<Eigen::UnitLower>().solveInPlace(out);
  factors.triangularView<Eigen::Upper>().solveInPlace(out);
}

double reciprocal_condition(const Matrix& A, const Lu& lu) {
  const std::size_t n = A.rows;
  std::vector<double> unit(n);
  std::vector<double> column(n);
  double of_A = 0.0;
  double of_inverse = 0.0;
  for (std::size_t j = 0; j < n; ++j) {
    of_A = std::max(of_A, sum_of_sizes(std::span(A.values).subspan(j * n, n)));
    unit[j] = 1.0;
    solve(lu, unit, column);
    unit[j] = 0.0;
    const double size = sum_of_sizes(column);
    if (!std::isfinite(size)) return 0.0;
    of_inverse = std::max(of_inverse, size);
  }
  return 1.0 / (of_A * of_inverse);
}

std::vector<std::complex<double>> eigenvalues(const Matrix& A) {
  const Eigen::EigenSolver<Dense> solver(columns_of(A), false);
  const auto& values = solver.eigenvalues();
  return {values.data(), values.data() + values.size()};
}

Eigenpair largest_eigenpair(const Matrix& A) {
  const Eigen::EigenSolver<Dense> solver(columns_of(A));
  const auto& values = solver.eigenvalues();
  Eigen::Index best = 0;
  for (Eigen::Index i = 1; i < values.size(); ++i) {
    best = std::abs(values[i]) > std::abs(values[best]) ? i : best;
  }
  // Of a conjugate pair the first is above the real axis; its column and that of the
  // other are the real and the imaginary part of its vector.
  const Dense& columns = solver.pseudoEigenvectors();
  const bool real = values[best].imag() == 0;
  Eigenpair out{values[best], std::vector<std::complex<double>>(A.rows)};
  const double length =
      real ? columns.col(best).norm()
           : std::hypot(columns.col(best).norm(), columns.col(best + 1).norm());
  for (std::size_t i = 0; i < A.rows; ++i) {
    const double imaginary = real ? 0.0 : columns(index(i), best + 1);
    out.vector[i] = {columns(index(i), best) / length, imaginary / length};
  }
  return out;
}

Eigenpair largest_hessenberg_pair(const Matrix& H) {
  const ConstColumnMap h = columns_of(H);
  const Eigen::Index n = h.rows();
  Eigen::RealSchur<Dense> schur(n);
  schur.computeFromHessenberg(h, Dense::Identity(n, n), false);
  const Dense& T = schur.matrixT();
  Complex best = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    Complex value = T(i, i);
    if (i + 1 < n && T(i + 1, i) != 0) {  // a conjugate pair
      const double half = 0.5 * (T(i, i) - T(i + 1, i + 1));
      const Complex root = std::sqrt(Complex(half * half + T(i, i + 1) * T(i + 1, i)));
      value = T(i + 1, i + 1) + half + Complex(root.real(), std::abs(root.imag()));
      ++i;
    }
    best = std::abs(value) > std::abs(best) || i == 0 ? value : best;
  }
  return {best, hessenberg_vector(h, best)};
}

Matrix exponential(const Matrix& A) {
  return plain(Dense(columns_of(A)).exp());
}

}  // namespace trochoid::numerics
