#include <trochoid/dynamics/oscillator.h>

#include <trochoid/dynamics/nodes.h>

#include <cmath>

namespace trochoid::dynamics {

std::array<double, 4> free_motion(const ChipMode& mode, double t) noexcept {
  const double sigma = 0.5 * mode.damping / mode.mass;
  const double square = mode.stiffness / mode.mass;  // omega_0^2
  const double rest = square - sigma * sigma;
  const double root = std::sqrt(std::abs(rest));
  double C = 0.0;  // both with the decay
  double S = 0.0;
  if (root * t < 1e-6) {
    C = std::exp(-sigma * t);
    S = C * t;
  } else if (rest > 0) {
    const double decay = std::exp(-sigma * t);
    C = decay * std::cos(root * t);
    S = decay * std::sin(root * t) / root;
  } else {
    const double slow = std::exp((root - sigma) * t);
    const double fast = std::exp(-(root + sigma) * t);
    C = 0.5 * (slow + fast);
    S = 0.5 * (slow - fast) / root;
  }
  return {C + sigma * S, S, -square * S, C - sigma * S};  // D-3
}

DrivenMotion driven_motion(const ChipMode& mode, int n, double duration) {
  const ElementNodes& nodes = element_nodes(n);
  const std::size_t count = nodes.t.size();
  const double half = 0.5 * duration;
  DrivenMotion motion{
      std::vector<double>(count * count), std::vector<double>(count * count), {}};
  motion.free.push_back({1.0, 0.0, 0.0, 1.0});
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double to = nodes.t[i + 1];
    const auto step = free_motion(mode, half * (to - nodes.t[i]));
    const double* before = &motion.eta[i * count];
    double* after = &motion.eta[(i + 1) * count];
    const double* velocity_before = &motion.velocity[i * count];
    double* velocity = &motion.velocity[(i + 1) * count];
    for (std::size_t k = 0; k < count; ++k) {
      after[k] = step[0] * before[k] + step[1] * velocity_before[k];
      velocity[k] = step[2] * before[k] + step[3] * velocity_before[k];
    }
    for (std::size_t g = i * gauss_count; g < (i + 1) * gauss_count; ++g) {
      const double* row = &nodes.at_gauss[g * count];
      const auto kernel = free_motion(mode, half * (to - nodes.gauss_t[g]));
      const double weight = half * nodes.gauss_w[g] / mode.mass;
      for (std::size_t k = 0; k < count; ++k) {
        after[k] += weight * kernel[1] * row[k];  // D-4
        velocity[k] += weight * kernel[3] * row[k];
      }
    }
    motion.free.push_back(free_motion(mode, half * (to + 1)));
  }
  return motion;
}

}  // namespace trochoid::dynamics
