#include <trochoid/base/units.h>
#include <trochoid/structure/actuator.h>
#include <trochoid/structure/second_order.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>

namespace trochoid::structure {

ActuatorDynamics from_time_constants(double gain, double T1, double T2) noexcept {
  return {.gain = gain, .sum = T1 + T2, .product = T1 * T2};  // M-8
}

ActuatorDynamics from_frequency(double gain, double frequency, double zeta) noexcept {
  const double omega = unit::turn * frequency;
  return {.gain = gain, .sum = 2 * zeta / omega, .product = 1 / (omega * omega)};
}

double natural_frequency(const ActuatorDynamics& actuator) noexcept {
  return 1 / std::sqrt(actuator.product);
}

double damping_ratio(const ActuatorDynamics& actuator) noexcept {
  return actuator.sum / (2 * std::sqrt(actuator.product));
}

std::optional<std::array<double, 2>> time_constants(
    const ActuatorDynamics& actuator) noexcept {
  const double discriminant = actuator.sum * actuator.sum - 4 * actuator.product;
  if (discriminant < 0) {
    return std::nullopt;
  }
  const double longer = (actuator.sum + std::sqrt(discriminant)) / 2;  // M-9
  return std::array<double, 2>{longer, actuator.product / longer};
}

std::array<double, 3> equation_coefficients(const ActuatorDynamics& actuator) noexcept {
  return {1 / actuator.gain, actuator.sum / actuator.gain,
          actuator.product / actuator.gain};  // M-10
}

std::complex<double> response(const ActuatorDynamics& actuator, double omega) noexcept {
  return actuator.gain / std::complex<double>(1 - actuator.product * omega * omega,
                                              actuator.sum * omega);  // M-8
}

double step_response(const ActuatorDynamics& actuator, double t) noexcept {
  if (t <= 0) {
    return 0.0;
  }
  const double a = actuator.sum / (2 * actuator.product);
  const Decay decay = decaying(a, 1 / actuator.product, t);
  return actuator.gain * (1 - decay.C - a * decay.D);  // M-11
}

double half_power_frequency(const ActuatorDynamics& actuator) noexcept {
  // M-12 with q = P omega^2: q^2 - 2 b q - 1 = 0
  const double b = 1 - actuator.sum * actuator.sum / (2 * actuator.product);
  const double q = b > 0 ? b + std::hypot(b, 1.0) : 1 / (std::hypot(b, 1.0) - b);
  return std::sqrt(q / actuator.product) / unit::turn;
}

double lag_frequency(const ActuatorDynamics& actuator, double lag) {
  if (!(lag > 0 && lag < std::numbers::pi)) {
    throw std::invalid_argument("lag_frequency: the lag must be inside (0, pi)");
  }
  // S omega = tan(lag) (1 - P omega^2), kept free of the pole of the tangent
  const double s = std::sin(lag);
  const double c = std::cos(lag);
  const double A = s * actuator.product;
  const double B = c * actuator.sum;
  const double root = std::sqrt(B * B + 4 * A * s);
  const double omega = B > 0 ? 2 * s / (B + root) : (root - B) / (2 * A);
  return omega / unit::turn;
}

double low_frequency_delay(const ActuatorDynamics& actuator) noexcept {
  return actuator.sum;
}

double rise_time(const ActuatorDynamics& actuator, double part) {
  if (!(part > 0 && part < 1)) {
    throw std::invalid_argument("rise_time: the part must be inside (0, 1)");
  }
  const ActuatorDynamics unit{1.0, actuator.sum, actuator.product};
  const auto above = [&](double t) { return step_response(unit, t) - part; };
  // A part below 1 is first reached on the rise,
  // which is monotone up to the first peak.
  double end = std::sqrt(unit.product) / 16;
  while (above(end) < 0) {
    end *= 1.25;
  }
  std::uintmax_t most = 100;
  const auto bracket = boost::math::tools::toms748_solve(
      above, 0.0, end, boost::math::tools::eps_tolerance<double>(50), most);
  return (bracket.first + bracket.second) / 2;
}

}  // namespace trochoid::structure
