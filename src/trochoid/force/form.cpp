#include <trochoid/force/form.h>

#include <cmath>

namespace trochoid::force {

ColumnWeights column_weights(const Form& form, double h, double sin_kappa,
                             double dS) noexcept {
  const double edge = form.edge ? dS : 0.0;
  if (!form.power) {
    const double w = h * sin_kappa;  // F-1
    return {{w, w, w}, edge};
  }
  const auto& m = form.m;
  const double x = std::log(h * sin_kappa / h_0);
  const auto w = [x](double exponent) { return h_0 * std::exp((1 - exponent) * x); };
  const double t = w(m[0]);  // F-2
  return {{t, m[1] == m[0] ? t : w(m[1]), m[2] == m[0] ? t : w(m[2])}, edge};
}

std::array<double, 3> column_slopes(const Form& form, double h,
                                    double sin_kappa) noexcept {
  if (!form.power) {
    return {sin_kappa, sin_kappa, sin_kappa};
  }
  const double ratio = h * sin_kappa / h_0;
  std::array<double, 3> slope{};
  for (std::size_t q = 0; q < slope.size(); ++q) {
    slope[q] = (1 - form.m[q]) * sin_kappa * std::pow(ratio, -form.m[q]);
  }
  return slope;
}

}  // namespace trochoid::force
