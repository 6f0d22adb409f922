#include <trochoid/correction/plant.h>

namespace trochoid::correction {

Plant held_by_actuator(const structure::ActuatorDynamics& actuator,
                       const structure::Mode& table) noexcept {
  return {actuator, table, table.stiffness, table.damping};
}

std::complex<double> response(const Plant& plant, double omega) noexcept {
  const std::complex<double> spring(plant.k_s, plant.c_s * omega);
  return structure::response(plant.actuator, omega) * spring *
         structure::receptance(plant.table, omega);
}

Harmonics table_response(const Plant& plant, const PeriodicMotion& command,
                         double Omega, int n_max) {
  const auto* given = std::get_if<Harmonics>(&command);
  Harmonics out = given != nullptr ? *given : harmonics_of(command, n_max);
  out.mean *= response(plant, 0.0).real();
  double n = 0;
  for (auto& c : out.c) {
    n += 1;
    c *= response(plant, n * Omega);
  }
  return out;
}

dynamics::Drive drive_of(const Plant& plant, std::size_t mode) noexcept {
  const auto a = structure::equation_coefficients(plant.actuator);
  return {mode, a[0], a[1], a[2], plant.k_s, plant.c_s};
}

}  // namespace trochoid::correction
