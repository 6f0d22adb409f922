#include "even_basis.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <functional>
#include <numbers>

namespace trochoid::structure {

namespace {

/// Derivatives 0, 1, 2 of 1 - cos(k x).
double shape(double k, double x, int derivative) {
  switch (derivative) {
    case 0:
      return 1 - std::cos(k * x);
    case 1:
      return k * std::sin(k * x);
    default:
      return k * k * std::cos(k * x);
  }
}

/// Integrals of products of derivatives over the length.
Eigen::MatrixXd integrals(const Eigen::VectorXd& k, double length, int p, int q) {
  Eigen::MatrixXd out(k.size(), k.size());
  const int panels = 40;
  for (Eigen::Index i = 0; i < k.size(); ++i) {
    for (Eigen::Index j = 0; j < k.size(); ++j) {
      out(i, j) = 0;
      for (int panel = 0; panel < panels; ++panel) {
        out(i, j) += boost::math::quadrature::gauss<double, 10>::integrate(
            [&](double x) { return shape(k[i], x, p) * shape(k[j], x, q); },
            length * panel / panels, length * (panel + 1) / panels);
      }
    }
  }
  return out;
}

}  // namespace

double even_basis_deflection(double length, double height, double nu, std::size_t terms,
                             double x) {
  const auto n = static_cast<Eigen::Index>(terms);
  const Eigen::VectorXd one = Eigen::VectorXd::LinSpaced(n, 1, static_cast<double>(n));
  const Eigen::VectorXd kx = one * (2 * std::numbers::pi / length);
  const Eigen::VectorXd ky = (one.array() - 0.5) * (std::numbers::pi / height);
  const auto X = [&](int p, int q) { return integrals(kx, length, p, q); };
  const auto Y = [&](int p, int q) { return integrals(ky, height, p, q); };
  const Eigen::MatrixXd x22 = X(2, 2), x00 = X(0, 0), x20 = X(2, 0), x11 = X(1, 1);
  const Eigen::MatrixXd y22 = Y(2, 2), y00 = Y(0, 0), y20 = Y(2, 0), y11 = Y(1, 1);
  Eigen::MatrixXd K(n * n, n * n);
  Eigen::VectorXd f(n * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) {
      f[i * n + k] = shape(kx[i], x, 0) * shape(ky[k], height, 0);
      for (Eigen::Index j = 0; j < n; ++j) {
        for (Eigen::Index m = 0; m < n; ++m) {
          K(i * n + k, j * n + m) =
              x22(i, j) * y00(k, m) + x00(i, j) * y22(k, m) +
              nu * (x20(i, j) * y20(m, k) + x20(j, i) * y20(k, m)) +
              2 * (1 - nu) * x11(i, j) * y11(k, m);
        }
      }
    }
  }
  return f.dot(K.llt().solve(f));
}

}  // namespace trochoid::structure
