#include <trochoid/dynamics/element_response.h>

#include <trochoid/dynamics/oscillator.h>

#include <optional>
#include <span>

namespace trochoid::dynamics {

namespace {

using numerics::Matrix;

/// @param eta  row-major, shape (n, n)
void add_compliance(double factor, std::span<const double> eta, std::size_t n,
                    Matrix& block) {
  if (block.values.empty()) {
    if (factor == 0) return;
    block = numerics::zeros(n, n);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) block(i, k) += factor * eta[i * n + k];
  }
}

void add_mode(ElementResponse& response, const DrivenMotion& motion, std::size_t r,
              const std::array<double, 2>& direction, std::size_t count) {
  const std::size_t n = motion.end_velocity.size();
  const std::span<const double> at_end = std::span(motion.eta).last(n);
  for (std::size_t c = 0; c < count; ++c) {
    const double along = direction[c];
    for (std::size_t i = 0; i < n; ++i) {
      response.free(c * n + i, 2 * r) = along * motion.free[i][0];
      response.free(c * n + i, 2 * r + 1) = along * motion.free[i][1];
      response.ends(2 * r, c * n + i) = along * at_end[i];
      response.ends(2 * r + 1, c * n + i) = along * motion.end_velocity[i];
    }
    for (std::size_t b = 0; b < count; ++b) {
      add_compliance(along * direction[b], motion.eta, n,
                     response.compliance[2 * c + b]);
    }
  }
}

}  // namespace

ElementResponse element_response(const std::vector<ChipMode>& modes,
                                 const Components& components, int degree,
                                 double duration) {
  const std::size_t values =
      degree > 0 ? components.count * (static_cast<std::size_t>(degree) + 1) : 0;
  const std::size_t states = 2 * modes.size();
  ElementResponse response{degree,
                           duration,
                           numerics::zeros(values, states),
                           numerics::zeros(states, states),
                           numerics::zeros(states, values),
                           {}};
  std::optional<DrivenMotion> motion;
  for (std::size_t r = 0; r < modes.size(); ++r) {
    const bool alike = motion && modes[r].mass == modes[r - 1].mass &&
                       modes[r].damping == modes[r - 1].damping &&
                       modes[r].stiffness == modes[r - 1].stiffness;
    if (!alike && degree > 0) {
      motion = driven_motion(modes[r], degree, duration);
    }
    if (motion) {
      add_mode(response, *motion, r, components.modes[r], components.count);
    }
    const auto over = free_motion(modes[r], duration);
    for (std::size_t i = 0; i < 4; ++i) {
      response.over(2 * r + i / 2, 2 * r + i % 2) = over[i];
    }
  }
  return response;
}

}  // namespace trochoid::dynamics
