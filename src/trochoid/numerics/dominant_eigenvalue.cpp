#include <trochoid/numerics/dominant_eigenvalue.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace trochoid::numerics {

namespace {

constexpr Eigen::Index first_check = 9;

struct Ritz {
  std::complex<double> value;
  Eigen::VectorXcd coordinates;
  double residual = 0.0;
};

Ritz ritz(const Eigen::MatrixXd& H, Eigen::Index k, double next) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(H.topLeftCorner(k, k));
  const auto& values = solver.eigenvalues();
  Eigen::Index best = 0;
  for (Eigen::Index i = 1; i < k; ++i) {
    best = std::abs(values[i]) > std::abs(values[best]) ? i : best;
  }
  Ritz r{values[best], solver.eigenvectors().col(best), 0.0};
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

/// What of a vector lies along others.
struct Projection {
  Eigen::VectorXd along;
  double left = 0.0;   ///< length of the rest
  bool ended = false;  ///< nothing is left
};

/// @param[in,out] w  then the rest, of length one unless nothing is left
Projection orthogonalize(const Eigen::Ref<const Eigen::MatrixXd>& V,
                         Eigen::Ref<Eigen::VectorXd> w) {
  const double before = w.norm();
  Projection p{V.transpose() * w, 0.0, false};
  w.noalias() -= V * p.along;
  p.left = w.norm();
  if (p.left < 0.7 * before) {  // twice is enough, and needed only here
    const Eigen::VectorXd more = V.transpose() * w;
    w.noalias() -= V * more;
    p.along += more;
    p.left = w.norm();
  }
  p.ended = p.left <= 1e-14 * before;
  if (!p.ended) {
    w /= p.left;
  }
  return p;
}

}  // namespace

DominantEigenvalue dominant_eigenvalue(const LinearMap& map, std::size_t size,
                                       double tolerance) {
  const auto n = static_cast<Eigen::Index>(size);
  Eigen::Index room = std::min<Eigen::Index>(n, 24);
  Eigen::MatrixXd V(n, room + 1);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(room + 1, room);
  V.col(0) = start_vector(n);
  Eigen::Index check = std::min<Eigen::Index>(n, first_check);
  Ritz last;
  Ritz found;
  Eigen::Index k = 0;
  while (k < n) {
    if (k == room) {
      room = std::min(n, 2 * room);
      V.conservativeResize(Eigen::NoChange, room + 1);
      H.conservativeResizeLike(Eigen::MatrixXd::Zero(room + 1, room));
    }
    map(std::span(V.col(k).data(), size), std::span(V.col(k + 1).data(), size));
    const Projection p = orthogonalize(V.leftCols(k + 1), V.col(k + 1));
    H.col(k).head(k + 1) = p.along;
    H(k + 1, k) = p.left;
    ++k;
    const bool ended = k == n || p.ended;
    if (k < check && !ended) {
      continue;
    }
    found = ritz(H, k, ended ? 0.0 : p.left);
    const double scale = std::abs(found.value);
    if (ended || found.residual <= tolerance * scale ||
        (found.residual <= 1e-2 * scale && k > first_check &&
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
