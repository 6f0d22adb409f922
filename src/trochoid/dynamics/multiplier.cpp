#include <trochoid/dynamics/multiplier.h>

#include <trochoid/numerics/dominant_eigenvalue.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trochoid::dynamics {

Multiplier multiplier_of(PeriodMap& map, double factor, double tolerance,
                         int expected) {
  const auto found = numerics::dominant_eigenvalue(
      [&](std::span<const double> in, std::span<double> out) { map.apply(in, out); },
      map.size(), tolerance, expected);
  Multiplier mu{
      .value = found.value, .error = 0.0, .factor = factor, .steps = found.steps};
  if (map.smooth()) {
    std::vector<double> disturbance(map.size());
    for (std::size_t i = 0; i < disturbance.size(); ++i) {
      disturbance[i] = found.vector[i].real() + found.vector[i].imag();
    }
    const double e = map.unresolved(disturbance);
    mu.error = std::max((30 * e + 1e-3) * e * std::abs(mu.value), 1e-16);  // D-14
  }
  return mu;
}

Multiplier multiplier_with(const Directional& directional, const System& system,
                           double Omega, double factor, double tolerance) {
  PeriodMap map(directional, system, Omega, {.factor = factor});
  return multiplier_of(map, factor, tolerance);
}

Multiplier settled(const std::function<Multiplier(double factor)>& with,
                   double tolerance) {
  constexpr double most = 4.0;
  double factor = tolerance < 1e-4 ? 0.8 : 0.64;
  Multiplier last = with(factor);
  const bool compared = last.error == 0;  // with fewer nodes
  while (compared || last.error > tolerance * std::max(1.0, std::abs(last.value))) {
    if (factor > most) {
      break;
    }
    factor *= more_nodes;
    Multiplier next = with(factor);
    if (compared) {
      next.error = std::abs(std::abs(next.value) - std::abs(last.value));
      if (next.error <= tolerance * std::max(1.0, std::abs(next.value))) {
        return next;
      }
    }
    last = next;
  }
  return last;
}

Multiplier multiplier(const Directional& directional, const System& system,
                      double Omega, double tolerance) {
  return settled(
      [&](double factor) {
        return multiplier_with(directional, system, Omega, factor, 0.1 * tolerance);
      },
      tolerance);
}

}  // namespace trochoid::dynamics
