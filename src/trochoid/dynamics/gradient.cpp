#include <trochoid/dynamics/gradient.h>

#include <cmath>

namespace trochoid::dynamics {

Matrix2 directional_gradient(const force::Terms& law, double h, double theta,
                             double sin_kappa, double cos_kappa) noexcept {
  std::array<double, 3> k = force::column_slopes(law.form, h, sin_kappa);
  for (std::size_t q = 0; q < k.size(); ++q) {
    k[q] *= law.K[q];  // D-5, D-6
  }
  const double s = std::sin(theta);
  const double c = std::cos(theta);
  const double radial = k[1] * sin_kappa + k[2] * cos_kappa;
  const auto [F_x, F_y] = force::in_plane(k[0], radial, s, c);  // F-3
  return {F_x * s, F_x * c, F_y * s, F_y * c};                  // D-7
}

}  // namespace trochoid::dynamics
