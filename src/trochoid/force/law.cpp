#include <trochoid/force/columns.h>
#include <trochoid/force/forces.h>

#include <cmath>
#include <stdexcept>

namespace trochoid::force {

int coefficient_count(const Law& law) {
  return std::holds_alternative<LinearEdge>(law) ? 6 : 3;
}

std::vector<double> coefficients(const Law& law) {
  if (const auto* k = std::get_if<LinearEdge>(&law)) {
    return {k->K_tc, k->K_rc, k->K_ac, k->K_te, k->K_re, k->K_ae};
  }
  const auto& k = std::get<Power>(law);
  return {k.K_t1, k.K_r1, k.K_a1};
}

Law with_coefficients(const Law& law, std::span<const double> K) {
  if (K.size() != static_cast<std::size_t>(coefficient_count(law))) {
    throw std::invalid_argument("a force law was given " + std::to_string(K.size()) +
                                " coefficients instead of " +
                                std::to_string(coefficient_count(law)));
  }
  if (std::holds_alternative<LinearEdge>(law)) {
    return LinearEdge{K[0], K[1], K[2], K[3], K[4], K[5]};
  }
  Power power = std::get<Power>(law);
  power.K_t1 = K[0];
  power.K_r1 = K[1];
  power.K_a1 = K[2];
  return power;
}

ColumnWeights column_weights(const Law& law, double h, double sin_kappa,
                             double dS) noexcept {
  if (std::holds_alternative<LinearEdge>(law)) {
    const double w = h * sin_kappa;  // F-1
    return {{w, w, w}, dS};
  }
  const Power& power = *std::get_if<Power>(&law);
  const double x = std::log(h * sin_kappa / h_0);
  const auto w = [x](double m) { return h_0 * std::exp((1 - m) * x); };  // F-2
  const double t = w(power.m_t);
  return {{t, power.m_r == power.m_t ? t : w(power.m_r),
           power.m_a == power.m_t ? t : w(power.m_a)},
          0.0};
}

}  // namespace trochoid::force
