#include <trochoid/correction/controller.h>
#include <trochoid/correction/online.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace {

void demand(bool condition) {
  if (!condition) std::abort();
}

/// Takes the next bytes as they are; zeros when there are no more.
struct Bytes {
  const std::uint8_t* data;
  std::size_t left;

  template <class T>
  void fill(T& value) {
    const std::size_t n = left < sizeof value ? left : sizeof value;
    std::memset(&value, 0, sizeof value);
    std::memcpy(&value, data, n);
    data += n;
    left -= n;
  }
};

/// Defaults, changed where the bytes say so: bytes alone are never a configuration.
TrochoidControllerConfig config_of(Bytes& bytes) {
  TrochoidControllerConfig c;
  trochoid_controller_defaults(&c);
  c.table_m[0] = 10e-6;
  c.table_m[1] = -20e-6;
  double* const numbers[] = {&c.table_m[0],   &c.phase_rev,     &c.lead_s,
                             &c.period_s,     &c.max_step_s,    &c.lower_m,
                             &c.upper_m,      &c.start_m,       &c.slew_m_per_s,
                             &c.fade_s,       &c.ramp_s,        &c.gain_time_s,
                             &c.filter_rev,   &c.min_speed_rps, &c.max_speed_rps,
                             &c.speed_change, &c.index_turns,   &c.position_tol_rev};
  std::uint32_t which = 0;
  bytes.fill(which);
  for (unsigned i = 0; i < 18; ++i) {
    if ((which >> i & 1U) != 0) bytes.fill(*numbers[i]);
  }
  c.recovery = static_cast<std::int32_t>(which >> 30);
  return c;
}

/// A step of a spindle that turns well, changed where the bytes say so.
TrochoidControllerInput input_of(Bytes& bytes, double& turns) {
  std::uint8_t which = 0;
  bytes.fill(which);
  const double before = turns;
  turns += 0.02;
  TrochoidControllerInput in{turns, std::floor(turns), 20.0, 1.0, 1e-3, 0, 1, 0};
  in.index = std::floor(turns) > std::floor(before) ? 1 : 0;
  if ((which & 1U) != 0) bytes.fill(in.position_rev);
  if ((which & 2U) != 0) bytes.fill(in.index_position_rev);
  if ((which & 4U) != 0) bytes.fill(in.speed_rps);
  if ((which & 8U) != 0) bytes.fill(in.gain);
  if ((which & 16U) != 0) bytes.fill(in.dt_s);
  in.index ^= (which & 32U) != 0 ? 1 : 0;
  in.enable ^= (which & 64U) != 0 ? 1 : 0;
  in.inhibit = (which & 128U) != 0 ? 1 : 0;
  return in;
}

}  // namespace

/// Whatever the inputs, the command stays in the window and its slope within the limit.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes{data, size};
  const TrochoidControllerConfig c = config_of(bytes);
  TrochoidController controller;
  if (trochoid_controller_init(&controller, &c) != TROCHOID_ACCEPTED) return 0;
  TrochoidOnlineConfig learning;
  trochoid_online_defaults(&learning);
  TrochoidOnline online;
  demand(trochoid_online_init(&online, &learning) == TROCHOID_ONLINE_ACCEPTED);
  double before = c.start_m;
  double turns = 0.3;
  for (int i = 0; i < 400 || bytes.left > 0; ++i) {
    const TrochoidControllerInput in = input_of(bytes, turns);
    const auto r = trochoid_controller_step(&controller, &in);
    const double dt = in.dt_s > 0.0 ? std::fmin(in.dt_s, c.max_step_s) : 0.0;
    demand(r.command_m >= c.lower_m && r.command_m <= c.upper_m);
    demand(std::fabs(r.command_m - before) <= c.slew_m_per_s * dt);
    demand(r.fade >= 0.0 && r.fade <= 1.0 && r.angle_rev >= 0.0 && r.angle_rev < 1.0);
    demand(std::isfinite(r.speed_rps) && std::isfinite(r.gain));
    before = r.command_m;
    const auto learnt = trochoid_online_sample(&online, in.position_rev, in.speed_rps,
                                               r.state == TROCHOID_RUNNING ? 1 : 0);
    demand(learnt.gain >= 0.0 && learnt.gain <= 1.0);
  }
  return 0;
}
