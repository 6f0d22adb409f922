#include <trochoid/dynamics/gradient.h>

#include <trochoid/force/columns.h>

#include <cmath>

namespace trochoid::dynamics {

Matrix2 directional_gradient(const force::Law& law, double h, double theta,
                             double sin_kappa, double cos_kappa) noexcept {
  std::array<double, 3> k{};
  if (const auto* linear = std::get_if<force::LinearEdge>(&law)) {
    k = {linear->K_tc * sin_kappa, linear->K_rc * sin_kappa, linear->K_ac * sin_kappa};
  } else if (const auto* power = std::get_if<force::Power>(&law)) {
    const double ratio = h * sin_kappa / force::h_0;
    const auto slope = [&](double K, double m) {
      return K * (1 - m) * sin_kappa * std::pow(ratio, -m);  // D-6
    };
    k = {slope(power->K_t1, power->m_t), slope(power->K_r1, power->m_r),
         slope(power->K_a1, power->m_a)};
  }
  const double s = std::sin(theta);
  const double c = std::cos(theta);
  const double radial = k[1] * sin_kappa + k[2] * cos_kappa;
  const double F_x = -c * k[0] - s * radial;  // F-3
  const double F_y = s * k[0] - c * radial;
  return {F_x * s, F_x * c, F_y * s, F_y * c};  // D-7
}

}  // namespace trochoid::dynamics
