#include <trochoid/dynamics/multiplier.h>

#include <trochoid/numerics/dominant_eigenvalue.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics {

Multiplier multiplier_with(const Directional& directional, const System& system,
                           double Omega, double factor, double tolerance) {
  const PeriodMap map(directional, system, Omega, {.factor = factor});
  const auto found = numerics::dominant_eigenvalue(
      [&](std::span<const double> in, std::span<double> out) { map.apply(in, out); },
      map.size(), tolerance);
  return {.value = found.value, .error = 0.0, .factor = factor};
}

Multiplier multiplier(const Directional& directional, const System& system,
                      double Omega, double tolerance) {
  const double first = tolerance < 1e-4 ? 0.8 : 0.64;
  constexpr double growth = 1.25;
  constexpr double most = 4.0;
  double factor = first;
  Multiplier last =
      multiplier_with(directional, system, Omega, factor, 0.1 * tolerance);
  while (true) {
    factor *= growth;
    Multiplier next =
        multiplier_with(directional, system, Omega, factor, 0.1 * tolerance);
    next.error = std::abs(std::abs(next.value) - std::abs(last.value));
    const double scale = std::max(1.0, std::abs(next.value));
    if (next.error <= tolerance * scale || factor > most) {
      return next;
    }
    last = next;
  }
}

}  // namespace trochoid::dynamics
