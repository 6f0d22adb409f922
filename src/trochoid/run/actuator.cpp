#include <trochoid/run/commands.h>

#include <trochoid/base/units.h>
#include <trochoid/run/vibration.h>

#include <fmt/core.h>

#include <cmath>
#include <utility>

namespace trochoid::run {

results::ActuatorResult actuator(const cases::Case& given) {
  files::StepFile file = given.machine.step->step.get();
  results::ActuatorResult r{.heading = heading_of(given),
                            .record = std::move(file.record),
                            .command = std::move(file.command)};
  r.fit = structure::identify_actuator(r.record);
  base::add(r.heading.warnings, std::move(file.notes));
  r.heading.ok = r.fit.ok;
  if (!r.fit.ok) {
    r.heading.message = r.fit.reason;
    return r;
  }
  add_actuator_warnings(r.record, r.fit, r.heading.warnings);
  const structure::ActuatorDynamics& found = r.fit.dynamics;
  r.heading.message = fmt::format(
      "Gain {:.3g}, natural frequency {:.3g} Hz, damping ratio {:.2g}. The step is met to "
      "{:.2g} um rms ({} samples).",
      found.gain, 1 / std::sqrt(found.product) / unit::Hz,
      found.sum / (2 * std::sqrt(found.product)), r.fit.rms / unit::um,
      r.record.time.size());
  return r;
}

}  // namespace trochoid::run
