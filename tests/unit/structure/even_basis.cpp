#include "even_basis.h"

#include <trochoid/numerics/dense.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <vector>

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

using numerics::Matrix;

/// Integrals of products of derivatives over the length.
Matrix integrals(const std::vector<double>& k, double length, int p, int q) {
  Matrix out = numerics::zeros(k.size(), k.size());
  const int panels = 40;
  for (std::size_t i = 0; i < k.size(); ++i) {
    for (std::size_t j = 0; j < k.size(); ++j) {
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
  const std::size_t n = terms;
  std::vector<double> kx(n);
  std::vector<double> ky(n);
  for (std::size_t m = 0; m < n; ++m) {
    const double number = static_cast<double>(m) + 1;
    kx[m] = 2 * number * std::numbers::pi / length;
    ky[m] = (number - 0.5) * std::numbers::pi / height;
  }
  const auto X = [&](int p, int q) { return integrals(kx, length, p, q); };
  const auto Y = [&](int p, int q) { return integrals(ky, height, p, q); };
  const Matrix x22 = X(2, 2), x00 = X(0, 0), x20 = X(2, 0), x11 = X(1, 1);
  const Matrix y22 = Y(2, 2), y00 = Y(0, 0), y20 = Y(2, 0), y11 = Y(1, 1);
  Matrix K = numerics::zeros(n * n, n * n);
  std::vector<double> f(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      f[i * n + k] = shape(kx[i], x, 0) * shape(ky[k], height, 0);
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t m = 0; m < n; ++m) {
          K(i * n + k, j * n + m) =
              x22(i, j) * y00(k, m) + x00(i, j) * y22(k, m) +
              nu * (x20(i, j) * y20(m, k) + x20(j, i) * y20(k, m)) +
              2 * (1 - nu) * x11(i, j) * y11(k, m);
        }
      }
    }
  }
  std::vector<double> w(n * n);
  numerics::solve(numerics::lu(K), f, w);
  return std::inner_product(f.begin(), f.end(), w.begin(), 0.0);
}

}  // namespace trochoid::structure
