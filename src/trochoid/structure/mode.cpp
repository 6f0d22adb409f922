#include <trochoid/base/units.h>
#include <trochoid/structure/mode.h>
#include <trochoid/structure/second_order.h>

#include <cmath>
#include <stdexcept>

namespace trochoid::structure {

namespace {

bool bad(const std::optional<double>& value, bool zero_allowed = false) {
  return value &&
         (!std::isfinite(*value) || *value < 0 || (*value == 0 && !zero_allowed));
}

}  // namespace

double natural_frequency(const Mode& mode) noexcept {
  return std::sqrt(mode.stiffness / mode.mass);  // M-1
}

double damping_ratio(const Mode& mode) noexcept {
  return mode.damping / (2 * std::sqrt(mode.stiffness * mode.mass));  // M-1
}

Mode completed(const ModeGiven& given) {
  const int known = int{given.mass.has_value()} + int{given.stiffness.has_value()} +
                    int{given.frequency.has_value()};
  if (known != 2 || given.damping.has_value() == given.damping_ratio.has_value()) {
    throw std::invalid_argument(
        "completed: two of mass, stiffness and frequency and one damping are needed");
  }
  if (bad(given.mass) || bad(given.stiffness) || bad(given.frequency) ||
      bad(given.damping, true) || bad(given.damping_ratio, true)) {
    throw std::invalid_argument("completed: a value of the mode is out of range");
  }
  Mode mode;
  const double omega = unit::turn * given.frequency.value_or(0.0);
  mode.mass = given.mass ? *given.mass : *given.stiffness / (omega * omega);
  mode.stiffness = given.stiffness ? *given.stiffness : *given.mass * omega * omega;
  mode.damping = given.damping
                     ? *given.damping
                     : 2 * *given.damping_ratio * std::sqrt(mode.stiffness * mode.mass);
  return mode;
}

Motion free_vibration(const Mode& mode, Motion start, double t) noexcept {
  const double a = mode.damping / (2 * mode.mass);
  const double wn2 = mode.stiffness / mode.mass;
  const Decay decay = decaying(a, wn2, t);
  // M-2; the velocity is its derivative
  return {.x = start.x * decay.C + (start.v + a * start.x) * decay.D,
          .v = start.v * decay.C - (wn2 * start.x + a * start.v) * decay.D};
}

std::complex<double> receptance(const Mode& mode, double omega) noexcept {
  return 1.0 / std::complex<double>(mode.stiffness - mode.mass * omega * omega,
                                    mode.damping * omega);  // M-3
}

}  // namespace trochoid::structure
