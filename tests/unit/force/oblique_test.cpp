#include <trochoid/base/units.h>
#include <trochoid/force/oblique.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace trochoid::force::oblique_test {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Another way to F-19, by vectors: x across the edge along the cut, y off the surface,
/// z along the edge. The force on the rake face leans by the friction angle towards the
/// chip, which flows at eta = i; its part in the shear plane is the stress times the area.
ObliqueCoefficients by_vectors(const OrthogonalCut& cut, double i) {
  const double a = cut.alpha_n;
  const Vector normal = {std::cos(a), -std::sin(a), 0};
  const Vector flow = {std::cos(i) * std::sin(a), std::cos(i) * std::cos(a),
                       std::sin(i)};
  Vector F{};
  for (std::size_t k = 0; k < 3; ++k) {
    F[k] = std::cos(cut.beta_a) * normal[k] + std::sin(cut.beta_a) * flow[k];
  }
  const Vector shear = {std::cos(cut.phi_c), -std::sin(cut.phi_c), 0};
  const double in_plane = std::hypot(dot(F, shear), F[2]);
  const double area = 1 / (std::sin(cut.phi_c) * std::cos(i));  // of a chip of 1 by 1
  const double size = cut.tau_s * area / in_plane;
  return {.K_tc = size * dot(F, {std::cos(i), 0, std::sin(i)}),
          .K_rc = size * F[1],
          .K_ac = size * dot(F, {std::sin(i), 0, -std::cos(i)})};
}

TEST(Oblique, AgreesWithTheForceAsAVector) {  // [F-19]
  for (const double helix : {0.0, 10.0, 30.0, 55.0}) {
    for (const double rake : {-8.0, 0.0, 12.0}) {
      for (const double friction : {15.0, 25.0, 35.0}) {
        const OrthogonalCut cut{.tau_s = 613 * unit::MPa,
                                .phi_c = 28 * unit::deg,
                                .beta_a = friction * unit::deg,
                                .alpha_n = rake * unit::deg};
        const auto found = oblique_coefficients(cut, helix * unit::deg);
        const auto expected = by_vectors(cut, helix * unit::deg);
        EXPECT_NEAR(found.K_tc, expected.K_tc, 1e-12 * expected.K_tc);
        EXPECT_NEAR(found.K_rc, expected.K_rc, 1e-12 * expected.K_tc);
        EXPECT_NEAR(found.K_ac, expected.K_ac, 1e-12 * expected.K_tc);
      }
    }
  }
}

/// Merchant's circle: the cutting and the thrust force of an edge that is not inclined.
TEST(Oblique, IsMerchantsCircleWithoutInclination) {
  const OrthogonalCut cut{.tau_s = 400e6, .phi_c = 0.5, .beta_a = 0.6, .alpha_n = 0.1};
  const auto K = oblique_coefficients(cut, 0.0);
  const double along = K.K_tc * std::cos(0.5) - K.K_rc * std::sin(0.5);
  EXPECT_NEAR(along, 400e6 / std::sin(0.5), 1e-3);
  EXPECT_NEAR(std::atan2(K.K_rc, K.K_tc), 0.6 - 0.1, 1e-12);
  EXPECT_NEAR(K.K_ac, 0.0, 1e-3);
}

TEST(ShearAngle, IsOfTheSpeedsOfTheChip) {  // [F-17]
  // The chip leaves at r v; across the shear plane its speed and that of the work are one.
  const double phi = shear_angle(0.6, 0.2);
  EXPECT_NEAR(0.6, std::sin(phi) / std::cos(phi - 0.2), 1e-12);
  EXPECT_GT(shear_angle(6.0, 0.2), std::numbers::pi / 2);
}

TEST(MeanChip, OfASlot) {  // [F-18]
  EXPECT_NEAR(mean_chip(0.1, 0, std::numbers::pi), 0.2 / std::numbers::pi, 1e-15);
  EXPECT_NEAR(mean_chip(0.1, 0.3, 0.3 + 1e-4), 0.1 * std::sin(0.30005), 1e-10);
}

}  // namespace trochoid::force::oblique_test
