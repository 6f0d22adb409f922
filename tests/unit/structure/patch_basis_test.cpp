#include <trochoid/structure/patch_basis.h>

#include <gtest/gtest.h>
#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::structure::patch_basis_test {

namespace {

/// A sum of shapes with some fixed coefficients.
double combination(const std::vector<double>& shapes) {
  double sum = 0.0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    sum += std::sin(1.0 + static_cast<double>(i)) * shapes[i];
  }
  return sum;
}

const PatchBasis basis({0.0, 0.3, 0.5, 2.0}, 7, {.end = false});

double w(double x) {
  return combination(basis.values(x));
}

/// Derivative by differences of fourth order, within one patch.
double derivative(double x, std::size_t order, double d) {
  if (order == 0) {
    return w(x);
  }
  return order == 1
             ? (8 * (w(x + d) - w(x - d)) - (w(x + 2 * d) - w(x - 2 * d))) / (12 * d)
             : (16 * (w(x + d) + w(x - d)) - (w(x + 2 * d) + w(x - 2 * d)) -
                30 * w(x)) /
                   (12 * d * d);
}

/// Exact for the polynomials of one patch.
double integral(double from, double to, const auto& f) {
  return boost::math::quadrature::gauss<double, 10>::integrate(f, from, to);
}

}  // namespace

TEST(PatchBasis, HasAsManyShapesAsThePolynomialsLeave) {  // [B-5]
  // Degree 7: 8 coefficients on each of 3 patches, less 2 at each of 2 inner nodes and
  // at each clamped end.
  EXPECT_EQ(basis.size(), 3 * 8 - 2 * 2 - 2);
  EXPECT_EQ(PatchBasis({0.0, 0.3, 0.5, 2.0}, 7, {}).size(), 3 * 8 - 2 * 2 - 4);
  EXPECT_EQ(PatchBasis({0.0, 2.0}, 3, {.end = false}).size(), 2);
  EXPECT_EQ(PatchBasis({0.0, 2.0}, 3, {.start = false, .end = false}).size(), 4);
}

TEST(PatchBasis, IsClampedAndBendsWithoutKinks) {  // [B-5]
  EXPECT_NEAR(w(0.0), 0, 1e-15);
  EXPECT_NEAR(w(1e-6), 0, 1e-9);
  for (const double node : {0.3, 0.5}) {
    const double d = 1e-5;
    EXPECT_NEAR(w(node - 1e-12), w(node), 1e-10);
    const double before = (w(node - d / 2) - w(node - 3 * d / 2)) / d;
    const double after = (w(node + 3 * d / 2) - w(node + d / 2)) / d;
    EXPECT_NEAR(before, after, 1e-2 * std::abs(before) + 1e-2);
  }
}

TEST(PatchBasis, IntegralsOfProductsAreThoseOfTheShapes) {  // [B-5] [B-6]
  const std::size_t n = basis.size();
  for (std::size_t p = 0; p < 3; ++p) {
    for (std::size_t q = 0; q < 3; ++q) {
      const auto G = basis.gram(p, q);
      double got = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
          got += std::sin(1.0 + static_cast<double>(i)) * G[i * n + j] *
                 std::sin(1.0 + static_cast<double>(j));
        }
      }
      double want = 0.0;
      for (std::size_t k = 1; k < basis.nodes().size(); ++k) {
        const double from = basis.nodes()[k - 1];
        const double to = basis.nodes()[k];
        const double d = 2e-3 * (to - from);
        want += integral(from, to, [&](double x) {
          return derivative(x, p, d) * derivative(x, q, d);
        });
      }
      EXPECT_NEAR(got, want, 1e-6 * std::abs(want)) << p << q;
    }
  }
}

TEST(PatchBasis, MeansAreThoseOfTheShapes) {  // [B-5]
  for (const auto& [from, to] :
       {std::pair{0.0, 2.0}, {0.1, 0.2}, {0.2, 0.9}, {1.9, 2.0}}) {
    double want = 0.0;
    for (std::size_t k = 1; k < basis.nodes().size(); ++k) {
      const double low = std::max(from, basis.nodes()[k - 1]);
      const double high = std::min(to, basis.nodes()[k]);
      want += low < high ? integral(low, high, w) / (to - from) : 0.0;
    }
    EXPECT_NEAR(combination(basis.means(from, to)), want, 1e-12);
  }
  EXPECT_EQ(combination(basis.means(0.7, 0.7)), w(0.7));
}

}  // namespace trochoid::structure::patch_basis_test
