#include "textbook.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::benchmarks {

namespace {

constexpr double turn = 2 * std::numbers::pi;

double chip(const force::Setup& setup, std::size_t j, double theta) {
  const std::size_t n = setup.cutter.pitch.size();
  const auto R = [&](std::size_t k) {
    return setup.cutter.profile.D / 2 + setup.runout.radial_offsets[k];
  };
  const double feed = static_cast<double>(n) * setup.cut.f_z / turn;
  double h = R(j);
  double theta_p = 0.0;
  for (std::size_t m = 1; m <= n; ++m) {
    const std::size_t k = (j + n - m) % n;
    theta_p += setup.cutter.pitch[k];
    double x = theta_p;
    for (int step = 0; step < 5; ++step) {  // eq. 10 of the paper
      const double A = feed * std::cos(theta) / R(k);
      x -= (std::sin(x - theta_p) + A * x) / (std::cos(x - theta_p) + A);
    }
    const double left = R(k) * std::cos(x - theta_p) - feed * x * std::sin(theta);
    h = std::min(h, R(j) - left);
  }
  return std::max(h, 0.0);
}

}  // namespace

std::vector<force::Vector3> textbook_forces(const force::Setup& setup,
                                            const force::LinearEdge& K,
                                            std::span<const double> phi, int slices) {
  const double lag_per_z = 2 * std::tan(setup.cutter.helix) / setup.cutter.lag_diameter;
  const double dz = setup.cut.a_p / slices;
  const double dS = dz / std::cos(setup.cutter.helix);
  std::vector<force::Vector3> out(phi.size());
  for (std::size_t i = 0; i < phi.size(); ++i) {
    double psi = 0.0;
    for (std::size_t j = 0; j < setup.cutter.pitch.size(); ++j) {
      for (int s = 0; s < slices; ++s) {
        const double theta = phi[i] - psi - lag_per_z * (s + 0.5) * dz;
        const double h = chip(setup, j, theta);
        if (h > 1e-15) {
          const double t = K.K_tc * h * dz + K.K_te * dS;
          const double r = K.K_rc * h * dz + K.K_re * dS;
          out[i][0] += -t * std::cos(theta) - r * std::sin(theta);
          out[i][1] += t * std::sin(theta) - r * std::cos(theta);
          out[i][2] -= K.K_ac * h * dz + K.K_ae * dS;
        }
      }
      psi += setup.cutter.pitch[j];
    }
  }
  return out;
}

}  // namespace trochoid::benchmarks
