#include <trochoid/structure/ritz.h>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace trochoid::structure {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Sparse = Eigen::SparseMatrix<double>;

Eigen::Index index(std::size_t i) {
  return static_cast<Eigen::Index>(i);
}

/// The five integrals of B-6 for one pair of line shapes.
struct Entry {
  std::size_t j = 0;
  std::array<double, 5> g{};  ///< 22, 00, 20, 02, 11
};
using Entries = std::vector<std::vector<Entry>>;  ///< [i]: those with j that meet i

Entries entries(const PatchBasis& basis, std::span<const double> weights = {}) {
  const std::size_t n = basis.size();
  const std::array<std::vector<double>, 5> G = {
      basis.gram(2, 2, weights), basis.gram(0, 0, weights), basis.gram(2, 0, weights),
      basis.gram(0, 2, weights), basis.gram(1, 1, weights)};
  Entries out(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      Entry e{.j = j, .g = {}};
      bool any = false;
      for (std::size_t q = 0; q < G.size(); ++q) {
        e.g[q] = G[q][i * n + j];
        any = any || e.g[q] != 0;
      }
      if (any) {
        out[i].push_back(e);
      }
    }
  }
  return out;
}

double stiffness(const Entry& x, const Entry& y, double nu) {
  const auto& a = x.g;
  const auto& b = y.g;
  return a[0] * b[1] + a[1] * b[0] + nu * (a[2] * b[3] + a[3] * b[2]) +
         2 * (1 - nu) * a[4] * b[4];  // B-6
}

/// Lower triangle of the stiffness matrix.
Sparse assemble(const PatchBasis& x, const PatchBasis& y, double nu,
                std::span<const double> rigidity) {
  const Entries in_x = entries(x);
  const Entries in_y = entries(y, rigidity);  // B-9
  const std::size_t m = y.size();
  Sparse K(index(x.size() * m), index(x.size() * m));
  std::vector<Eigen::Triplet<double>> triplets;
  for (std::size_t i = 0; i < in_x.size(); ++i) {
    for (const Entry& a : in_x[i]) {
      for (std::size_t k = 0; k < m; ++k) {
        for (const Entry& b : in_y[k]) {
          const std::size_t row = a.j * m + b.j;
          const std::size_t column = i * m + k;
          if (row >= column) {
            triplets.emplace_back(index(row), index(column), stiffness(a, b, nu));
          }
        }
      }
    }
  }
  K.setFromTriplets(triplets.begin(), triplets.end());
  return K;
}

}  // namespace

struct RitzSystem::Factor {
  Eigen::VectorXd scale;  ///< makes the diagonal 1: the shapes differ much in size
  Eigen::SimplicialLLT<Sparse> llt;
};

RitzSystem::RitzSystem(PatchBasis x, PatchBasis y, double poisson_ratio,
                       std::span<const double> rigidity)
    : x_(std::move(x)), y_(std::move(y)) {
  Sparse K = assemble(x_, y_, poisson_ratio, rigidity);
  auto factor = std::make_shared<Factor>();
  factor->scale = K.diagonal().cwiseSqrt().cwiseInverse();
  K = factor->scale.asDiagonal() * K * factor->scale.asDiagonal();
  factor->llt.compute(K);
  if (factor->llt.info() != Eigen::Success) {
    throw std::invalid_argument("the plate has no stiffness");
  }
  factor_ = std::move(factor);
}

std::vector<double> RitzSystem::reduced(std::span<const double> fx,
                                        std::span<const double> fy) const {
  const std::size_t loads = fy.size() / y_.size();
  const Eigen::Map<const Eigen::VectorXd> X(fx.data(), index(fx.size()));
  std::vector<double> out(loads * size());
  for (std::size_t j = 0; j < loads; ++j) {
    const Eigen::Map<const Eigen::VectorXd> Y(fy.data() + j * y_.size(),
                                              index(y_.size()));
    Eigen::VectorXd f(index(size()));
    Eigen::Map<Rows>(f.data(), X.size(), Y.size()).noalias() = X * Y.transpose();
    Eigen::Map<Eigen::VectorXd> z(out.data() + j * size(), index(size()));
    z = factor_->llt.permutationP() * f.cwiseProduct(factor_->scale);
    factor_->llt.matrixL().solveInPlace(z);
  }
  return out;
}

std::vector<double> products(std::span<const double> a, std::span<const double> b,
                             std::size_t n) {
  const Eigen::Map<const Rows> A(a.data(), index(a.size() / n), index(n));
  const Eigen::Map<const Rows> B(b.data(), index(b.size() / n), index(n));
  std::vector<double> out(static_cast<std::size_t>(A.rows() * B.rows()));
  Eigen::Map<Rows>(out.data(), A.rows(), B.rows()).noalias() = A * B.transpose();
  return out;
}

}  // namespace trochoid::structure
