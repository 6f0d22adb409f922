#include <trochoid/dynamics/multiplier.h>

#include <trochoid/numerics/dominant_eigenvalue.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics {

Multiplier multiplier_of(PeriodMap& map, double factor, double tolerance) {
  const auto found = numerics::dominant_eigenvalue(
      [&](std::span<const double> in, std::span<double> out) { map.apply(in, out); },
      map.size(), tolerance);
  return {.value = found.value, .error = 0.0, .factor = factor};
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
  while (true) {
    factor *= more_nodes;
    Multiplier next = with(factor);
    next.error = std::abs(std::abs(next.value) - std::abs(last.value));
    const double scale = std::max(1.0, std::abs(next.value));
    if (next.error <= tolerance * scale || factor > most) {
      return next;
    }
    last = next;
  }
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
