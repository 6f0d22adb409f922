#include <trochoid/correction/controller.h>

#include <cmath>
#include <cstdint>

#include "bytes.h"

namespace {

using trochoid::fuzz::Bytes;
using trochoid::fuzz::demand;

/// Defaults, changed where the bytes say so: bytes alone are never a configuration.
TrochoidControllerConfig config_of(Bytes& bytes, std::uint32_t which) {
  TrochoidControllerConfig c;
  trochoid_controller_defaults(&c);
  c.table_m[0] = 10e-6;
  c.table_m[1] = -20e-6;
  double* const numbers[] = {
      &c.table_m[0],   &c.phase_rev,        &c.lead_s,        &c.period_s,
      &c.max_step_s,   &c.lower_m,          &c.upper_m,       &c.start_m,
      &c.slew_m_per_s, &c.fade_s,           &c.ramp_s,        &c.gain_time_s,
      &c.filter_rev,   &c.min_speed_rps,    &c.max_speed_rps, &c.speed_change,
      &c.index_turns,  &c.position_tol_rev, &c.wrap_rev};
  for (unsigned i = 0; i < 19; ++i) {
    if ((which >> i & 1U) != 0) bytes.fill(*numbers[i]);
  }
  c.recovery = static_cast<std::int32_t>(which >> 30);
  return c;
}

/// A step of a spindle that turns well, changed where the bytes say so.
TrochoidControllerInput input_of(Bytes& bytes, double& turns, double more) {
  const auto which = bytes.next<std::uint8_t>();
  const double before = turns;
  turns += more;
  TrochoidControllerInput in{};
  in.position_rev = turns;
  in.index_position_rev = std::floor(turns);
  in.speed_rps = more / trochoid::fuzz::step_s;
  in.gain = 1.0;
  in.dt_s = trochoid::fuzz::step_s;
  in.enable = 1;
  in.index = std::floor(turns) > std::floor(before) ? 1 : 0;
  if ((which & 1U) != 0) bytes.fill(in.position_rev);
  if ((which & 2U) != 0) bytes.fill(in.index_position_rev);
  if ((which & 4U) != 0) bytes.fill(in.speed_rps);
  if ((which & 8U) != 0) bytes.fill(in.gain);
  if ((which & 16U) != 0) bytes.fill(in.dt_s);
  in.index ^= (which & 32U) != 0 ? 1 : 0;
  in.enable ^= (which & 64U) != 0 ? 1 : 0;
  if ((which & 128U) != 0) {  // waves, or the inhibit input
    const auto k = bytes.next<std::uint8_t>();
    in.inhibit = (k & 128U) != 0 ? 1 : 0;
    double* const waves = (k & 64U) != 0 ? in.cosine_m : in.sine_m;
    if ((k & 32U) != 0) bytes.fill(waves[k % TROCHOID_WAVE_HARMONICS]);
  }
  return in;
}

}  // namespace

/// Whatever the inputs, the command stays in the window and its slope within the limit.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes{data, size};
  const auto which = bytes.next<std::uint32_t>();
  const bool fast = (which >> 29U & 1U) != 0;  // runs within 50 steps
  TrochoidControllerConfig c = config_of(bytes, which);
  if (fast) {
    c.fade_s = 0.01;
    c.table_m[1] = 10e-6;  // two points at this speed: slower than the limit
  }
  TrochoidController controller;
  if (trochoid_controller_init(&controller, &c) != TROCHOID_ACCEPTED) return 0;
  double before = c.start_m;
  double turns = 0.3;
  for (int i = 0; i < 60 || bytes.left > 0; ++i) {
    const auto in = input_of(bytes, turns, fast ? trochoid::fuzz::turn_a_step : 0.02);
    const auto r = trochoid_controller_step(&controller, &in);
    const double dt = in.dt_s > 0.0 ? std::fmin(in.dt_s, c.max_step_s) : 0.0;
    demand(r.command_m >= c.lower_m && r.command_m <= c.upper_m);
    demand(std::fabs(r.command_m - before) <= c.slew_m_per_s * dt);
    demand(r.fade >= 0.0 && r.fade <= 1.0 && r.angle_rev >= 0.0 && r.angle_rev < 1.0);
    demand(std::isfinite(r.speed_rps) && std::isfinite(r.gain));
    before = r.command_m;
  }
  return 0;
}
