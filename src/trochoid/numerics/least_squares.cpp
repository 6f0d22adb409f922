#include <trochoid/numerics/least_squares.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace trochoid::numerics {
namespace {

using Dense = Eigen::MatrixXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using DenseVector = Eigen::VectorXd;
using Qr = Eigen::ColPivHouseholderQR<Dense>;

/// Added to the unit diagonal of normal equations, so that a dependent column ends in
/// zero and not in a division by rounding.
constexpr double ridge = 1e-14;

void check_shape(std::size_t entries, int n, std::size_t rows) {
  if (n < 1 || entries != static_cast<std::size_t>(n) * rows) {
    throw std::invalid_argument("least squares: a matrix of " +
                                std::to_string(entries) + " entries has not " +
                                std::to_string(rows) + " rows of " + std::to_string(n));
  }
}

DenseVector inverse_or_zero(const DenseVector& norms) {
  return norms.unaryExpr([](double v) { return v > 0.0 ? 1.0 / v : 0.0; });
}

/// The most unknowns that are solved for without asking for memory.
constexpr int few = 16;
using FewByFew =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, few, few>;
using Few = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, few, 1>;

template <class Matrix, class Column>
void solve_scaled_as(const Eigen::Ref<const Dense>& gram, Eigen::Ref<Dense> right) {
  const Column scale = gram.diagonal().unaryExpr(
      [](double v) { return v > 0.0 ? 1.0 / std::sqrt(v) : 0.0; });
  Matrix unit = scale.asDiagonal() * gram * scale.asDiagonal();
  unit.diagonal().array() += ridge;
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    if (scale[i] == 0.0) unit(i, i) = 1.0;
  }
  const Eigen::LDLT<Matrix> factors(unit);
  for (Eigen::Index j = 0; j < right.cols(); ++j) {
    const Column scaled = scale.cwiseProduct(right.col(j));
    right.col(j) = scale.cwiseProduct(factors.solve(scaled));
  }
}

/// @param[in]     gram   symmetric
/// @param[in,out] right  right sides, become solutions
void solve_scaled(const Eigen::Ref<const Dense>& gram,
                  // A Ref that is written to goes by value.
                  Eigen::Ref<Dense> right) {  // NOLINT(performance-*)
  if (gram.rows() <= few) {
    solve_scaled_as<FewByFew, Few>(gram, right);
  } else {
    solve_scaled_as<Dense, DenseVector>(gram, right);
  }
}

/// @brief Take B to H_k B, H_k the reflection number k of Q = H_0 H_1 ...
///
/// Eigen's product with Q takes them in blocks: seconds to compile, and faster only for
/// more than 48 columns.
void reflect(const Qr& qr, Eigen::Index k, Eigen::Ref<Dense> B) {
  const Eigen::Index rest = B.rows() - k;
  Eigen::VectorXd workspace(B.cols());
  B.bottomRows(rest).applyHouseholderOnTheLeft(qr.matrixQR().col(k).tail(rest - 1),
                                               qr.hCoeffs()[k], workspace.data());
}

/// Basic solution of the least-squares problem with the right-hand side given.
DenseVector solved(const Qr& qr, DenseVector right) {
  const Eigen::Index rank = qr.nonzeroPivots();
  for (Eigen::Index k = 0; k < rank; ++k) reflect(qr, k, right);
  DenseVector x = DenseVector::Zero(qr.cols());
  x.head(rank) = right.head(rank);
  qr.matrixQR()
      .topLeftCorner(rank, rank)
      .triangularView<Eigen::Upper>()
      .solveInPlace(x.head(rank));
  return qr.colsPermutation() * x;
}

void fill_singular(const Dense& R, double rank_tolerance, LeastSquares& out) {
  // R is square: what would first make it so need not be compiled.
  const Eigen::JacobiSVD<Dense, Eigen::NoQRPreconditioner> svd(R, Eigen::ComputeFullV);
  const DenseVector& s = svd.singularValues();
  out.singular_values.assign(s.data(), s.data() + s.size());
  const double limit = rank_tolerance * s[0];
  while (out.rank < s.size() && s[out.rank] > limit) ++out.rank;
  const double smallest = s[s.size() - 1];
  out.condition =
      smallest > 0.0 ? s[0] / smallest : std::numeric_limits<double>::infinity();
  for (Eigen::Index j = out.rank; j < R.cols(); ++j) {
    const DenseVector v = svd.matrixV().col(j);
    out.null_space.insert(out.null_space.end(), v.data(), v.data() + v.size());
  }
}

template <class Matrix>
LeastSquares by_reflections(const Matrix& a, const DenseVector& right,
                            double rank_tolerance) {
  const Eigen::Index m = a.rows();
  const Eigen::Index n = a.cols();
  LeastSquares out;
  const DenseVector norms = a.colwise().norm();
  out.norms.assign(norms.data(), norms.data() + n);
  const DenseVector scale = inverse_or_zero(norms);
  Dense scaled = Dense::Zero(std::max<Eigen::Index>(m, n), n);
  scaled.topRows(m) = a * scale.asDiagonal();
  DenseVector padded = DenseVector::Zero(scaled.rows());
  padded.head(m) = right;

  const Qr qr(scaled);  // I-1
  const Dense R = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  fill_singular(R * qr.colsPermutation().transpose(), rank_tolerance, out);  // I-6

  const DenseVector x = scale.cwiseProduct(solved(qr, std::move(padded)));
  const DenseVector residual = right - a * x;
  out.x.assign(x.data(), x.data() + n);
  out.residual.assign(residual.data(), residual.data() + m);
  out.rss = residual.squaredNorm();
  if (out.rank == n) {
    Dense inverse = Dense::Identity(n, n);
    R.triangularView<Eigen::Upper>().solveInPlace(inverse);
    const Dense half = scale.asDiagonal() * (qr.colsPermutation() * inverse);
    out.inverse_gram.resize(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    Eigen::Map<RowMajor>(out.inverse_gram.data(), n, n) = half * half.transpose();
  }
  return out;
}

/// Beyond this condition the normal equations lose what is asked of them: their relative
/// error is this squared times rounding.
constexpr double worst_condition = 3e3;

/// (L L^T)^-1 right, L row-major in the lower triangle of a scaled gram.
struct Normal {
  DenseVector scale;
  Eigen::LLT<Dense> factors;

  explicit Normal(const Dense& gram)
      : scale(inverse_or_zero(gram.diagonal().cwiseSqrt())),
        factors(scale.asDiagonal() * gram * scale.asDiagonal()) {}

  [[nodiscard]] DenseVector solve(const DenseVector& right) const {
    return scale.cwiseProduct(factors.solve(scale.cwiseProduct(right)));
  }
};

std::span<const double> as_span(const DenseVector& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

DenseVector products_with(const Columns& A, std::span<const double> b) {
  DenseVector out(static_cast<Eigen::Index>(A.count()));
  inner_products(A, {b, A.rows}, {out.data(), A.count()});
  return out;
}

}  // namespace

LeastSquares least_squares(std::span<const double> A, int n, std::span<const double> b,
                           double rank_tolerance) {
  check_shape(A.size(), n, b.size());
  const auto m = static_cast<Eigen::Index>(b.size());
  return by_reflections(Eigen::Map<const RowMajor>(A.data(), m, n),
                        Eigen::Map<const DenseVector>(b.data(), m), rank_tolerance);
}

LeastSquares least_squares(const Columns& A, std::span<const double> b,
                           double rank_tolerance) {
  check_shape(A.values.size(), static_cast<int>(A.count()), b.size());
  const auto n = static_cast<Eigen::Index>(A.count());
  Dense gram(n, n);  // symmetric
  inner_products(A, A, {gram.data(), A.count() * A.count()});
  const Normal normal(gram);
  LeastSquares out;
  if (normal.scale.minCoeff() > 0.0 && normal.factors.info() == Eigen::Success) {
    fill_singular(normal.factors.matrixU(), rank_tolerance, out);  // I-6
  }
  if (out.rank < n || !(out.condition < worst_condition)) {
    const auto m = static_cast<Eigen::Index>(b.size());
    return by_reflections(Eigen::Map<const Dense>(A.values.data(), m, n),
                          Eigen::Map<const DenseVector>(b.data(), m), rank_tolerance);
  }
  const DenseVector norms = gram.diagonal().cwiseSqrt();
  out.norms.assign(norms.begin(), norms.end());
  out.x.assign(A.count(), 0.0);
  out.residual.assign(b.begin(), b.end());
  for (int step = 0; step < 2; ++step) {  // I-1
    const DenseVector dx = normal.solve(products_with(A, out.residual));
    add_combination(A, as_span(dx), -1.0, out.residual);
    Eigen::Map<DenseVector>(out.x.data(), n) += dx;
  }
  out.rss = Eigen::Map<const DenseVector>(out.residual.data(),
                                          static_cast<Eigen::Index>(b.size()))
                .squaredNorm();
  const Dense half = normal.factors.matrixL().solve(Dense(normal.scale.asDiagonal()));
  out.inverse_gram.resize(A.count() * A.count());
  Eigen::Map<Dense>(out.inverse_gram.data(), n, n) = half.transpose() * half;
  return out;
}

std::vector<double> project_out(std::span<const double> A, int n, std::span<double> B,
                                int k) {
  if (k == 0) return {};
  check_shape(B.size(), k, B.size() / static_cast<std::size_t>(k));
  check_shape(A.size(), n, B.size() / static_cast<std::size_t>(k));
  const auto m = static_cast<Eigen::Index>(B.size()) / k;
  const Eigen::Map<const RowMajor> a(A.data(), m, n);
  Eigen::Map<RowMajor> b(B.data(), m, k);
  const Dense gram = a.transpose() * a;
  Dense right = a.transpose() * b;
  solve_scaled(gram, right);
  const RowMajor x = right;
  b.noalias() -= a * x;
  return {x.data(), x.data() + x.size()};
}

std::vector<double> project_out(const Columns& A, std::span<const double> gram,
                                std::span<double> B) {
  const auto n = static_cast<Eigen::Index>(A.count());
  const std::size_t k = B.size() / A.rows;
  Dense right(n, static_cast<Eigen::Index>(k));
  for (std::size_t j = 0; j < k; ++j) {
    right.col(static_cast<Eigen::Index>(j)) =
        products_with(A, B.subspan(j * A.rows, A.rows));
  }
  solve_scaled(Eigen::Map<const Dense>(gram.data(), n, n), right);
  std::vector<double> x(right.data(), right.data() + right.size());
  for (std::size_t j = 0; j < k; ++j) {
    add_combination(A, std::span<const double>(x).subspan(j * A.count(), A.count()),
                    -1.0, B.subspan(j * A.rows, A.rows));
  }
  return x;
}

double solve_normal(std::span<const double> G, std::span<const double> g,
                    std::span<double> x) {
  const auto n = static_cast<Eigen::Index>(g.size());
  const Eigen::Map<const Dense> gram(G.data(), n, n);  // symmetric
  const Eigen::Map<const DenseVector> right(g.data(), n);
  Eigen::Map<DenseVector> solution(x.data(), n);
  solution = right;
  solve_scaled(gram, solution);
  return right.dot(solution);
}

std::vector<double> orthonormal(std::span<const double> A, int n, double tolerance) {
  const auto m = static_cast<Eigen::Index>(A.size()) / n;
  Qr qr(Eigen::Map<const RowMajor>(A.data(), m, n));
  qr.setThreshold(tolerance);
  Dense q = Dense::Identity(m, qr.rank());
  for (Eigen::Index k = q.cols(); k-- > 0;) reflect(qr, k, q.rightCols(q.cols() - k));
  std::vector<double> out(static_cast<std::size_t>(q.size()));
  Eigen::Map<RowMajor>(out.data(), m, q.cols()) = q;
  return out;
}

}  // namespace trochoid::numerics
