#include <trochoid/numerics/dominant_eigenvalue.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace trochoid::numerics {

namespace {

struct Ritz {
  std::complex<double> value;
  Eigen::VectorXcd coordinates;
  double residual = 0.0;
};

Ritz ritz(const Eigen::MatrixXd& H, Eigen::Index k, double next) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(H.topLeftCorner(k, k));
  Eigen::Index best = 0;
  for (Eigen::Index i = 1; i < k; ++i) {
    const bool larger =
        std::abs(solver.eigenvalues()[i]) > std::abs(solver.eigenvalues()[best]);
    best = larger ? i : best;
  }
  Ritz r{solver.eigenvalues()[best], solver.eigenvectors().col(best), 0.0};
  if (r.value.imag() < 0) {
    r.value = std::conj(r.value);
    r.coordinates = r.coordinates.conjugate().eval();
  }
  r.residual = next * std::abs(r.coordinates[k - 1]);
  return r;
}

/// A start that no symmetry of a map makes special, the same each time.
Eigen::VectorXd start_vector(Eigen::Index n) {
  Eigen::VectorXd v(n);
  double x = 0.37;
  for (Eigen::Index i = 0; i < n; ++i) {
    x = std::fmod(x + 0.6180339887498949, 1.0);
    v[i] = x - 0.3;
  }
  return v.normalized();
}

}  // namespace

DominantEigenvalue dominant_eigenvalue(const LinearMap& map, std::size_t size,
                                       double tolerance) {
  const auto n = static_cast<Eigen::Index>(size);
  Eigen::MatrixXd V(n, std::min<Eigen::Index>(n, 24) + 1);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n + 1, n);
  V.col(0) = start_vector(n);
  Eigen::Index check = std::min<Eigen::Index>(n, 9);
  Ritz last;
  Ritz found;
  Eigen::Index k = 0;
  while (k < n) {
    if (k + 1 >= V.cols()) {
      V.conservativeResize(Eigen::NoChange, std::min(n, 2 * V.cols()) + 1);
    }
    map(std::span(V.col(k).data(), size), std::span(V.col(k + 1).data(), size));
    Eigen::Ref<Eigen::VectorXd> w = V.col(k + 1);
    const double before = w.norm();
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough
      const Eigen::VectorXd h = V.leftCols(k + 1).transpose() * w;
      w.noalias() -= V.leftCols(k + 1) * h;
      H.col(k).head(k + 1) += h;
    }
    const double next = w.norm();
    H(k + 1, k) = next;
    ++k;
    const bool ended = k == n || next <= 1e-14 * before;
    if (!ended) {
      w /= next;
    }
    if (k < check && !ended) {
      continue;
    }
    found = ritz(H, k, ended ? 0.0 : next);
    const double scale = std::abs(found.value);
    if (ended || found.residual <= tolerance * scale ||
        (found.residual <= 1e-2 * scale && k > 9 &&
         std::abs(found.value - last.value) <= 0.1 * tolerance * scale)) {
      break;
    }
    last = found;
    check = k + std::max<Eigen::Index>(3, k / 4);
  }
  DominantEigenvalue result{.value = found.value,
                            .vector = std::vector<std::complex<double>>(size),
                            .residual = found.residual,
                            .steps = static_cast<int>(k)};
  Eigen::Map<Eigen::VectorXcd>(result.vector.data(), n) =
      V.leftCols(k) * found.coordinates;
  return result;
}

}  // namespace trochoid::numerics
