#include <trochoid/force/oblique.h>

#include <cmath>

namespace trochoid::force {

double shear_angle(double ratio, double alpha) noexcept {
  return std::atan2(ratio * std::cos(alpha), 1 - ratio * std::sin(alpha));  // F-17
}

double mean_chip(double f_z, double from, double to) noexcept {
  return f_z * (std::cos(from) - std::cos(to)) / (to - from);  // F-18
}

ObliqueCoefficients oblique_coefficients(const OrthogonalCut& cut, double i) noexcept {
  const double eta = i;
  const double beta_n = std::atan(std::tan(cut.beta_a) * std::cos(eta));
  const double across = std::tan(eta) * std::sin(beta_n);
  const double c = std::hypot(std::cos(cut.phi_c + beta_n - cut.alpha_n), across);
  const double size = cut.tau_s / (std::sin(cut.phi_c) * c);
  const double along = std::cos(beta_n - cut.alpha_n);
  return {.K_tc = size * (along + std::tan(i) * across),  // F-19
          .K_rc = size * std::sin(beta_n - cut.alpha_n) / std::cos(i),
          .K_ac = size * (along * std::tan(i) - across)};
}

}  // namespace trochoid::force
