#include <trochoid/correction/controller.h>
#include <trochoid/correction/estimator.h>
#include <trochoid/correction/online.h>

#include <cmath>
#include <cstdint>
#include <cstring>

#include "bytes.h"

namespace {

using trochoid::fuzz::Bytes;
using trochoid::fuzz::demand;
using trochoid::fuzz::step_s;
using trochoid::fuzz::turn_a_step;

/// Controller, gain and waves of one host.
struct Host {
  TrochoidController controller;
  TrochoidOnline online;
  TrochoidEstimator estimator;
  double turns = 0.3;
};

/// What the bytes may spoil: the three memories, one after the other.
constexpr std::size_t memory =
    sizeof(TrochoidController) + sizeof(TrochoidOnline) + sizeof(TrochoidEstimator);
static_assert(memory <= 0xFFFF);

TrochoidControllerConfig controller_config() {
  TrochoidControllerConfig c;
  trochoid_controller_defaults(&c);
  c.points = 16;
  for (int i = 0; i < c.points; ++i) c.table_m[i] = i < 8 ? 5e-6 : -5e-6;
  c.start_m = 30e-6;
  c.fade_s = 0.01;
  return c;
}

TrochoidEstimatorConfig estimator_config() {
  TrochoidEstimatorConfig c;
  trochoid_estimator_defaults(&c);
  c.least_samples = 2;
  c.settled_turns = 1;
  for (int j = 0; j < c.teeth; ++j) {
    for (int k = 0; k < 2 * c.harmonics; ++k) {
      c.wave_model[j][k] = 2e4 * std::cos(1.3 * (j + 1) * (k + 1));
    }
    for (int i = 0; i < c.teeth; ++i) c.runout_model[j][i] = i == j ? 3e4 : -1e4;
  }
  return c;
}

void step(Host& host, bool enable) {
  const double before = host.turns;
  host.turns += turn_a_step;
  const int flute = static_cast<int>(4.0 * (host.turns - std::floor(host.turns)));
  const double force = 100.0 + 10.0 * flute;
  const auto gain =
      trochoid_online_sample(&host.online, host.turns, force, enable ? 1 : 0);
  demand(std::isfinite(gain.gain) && std::isfinite(gain.residual_m));
  demand(gain.difference >= 0.0 && gain.difference <= 1.0);
  const auto waves =
      trochoid_estimator_sample(&host.estimator, host.turns, force, enable ? 1 : 0);
  TrochoidControllerInput in{};
  in.position_rev = host.turns;
  in.index_position_rev = std::floor(host.turns);
  in.speed_rps = turn_a_step / step_s;
  in.gain = gain.gain;
  in.dt_s = step_s;
  in.index = std::floor(host.turns) > std::floor(before) ? 1 : 0;
  in.enable = enable ? 1 : 0;
  for (int n = 0; n < TROCHOID_WAVE_HARMONICS; ++n) {
    demand(std::isfinite(waves.cosine_m[n]) && std::isfinite(waves.sine_m[n]));
    in.cosine_m[n] = waves.cosine_m[n];
    in.sine_m[n] = waves.sine_m[n];
  }
  const auto r = trochoid_controller_step(&host.controller, &in);
  // The window may be what was overwritten: then what it holds now counts.
  const TrochoidControllerConfig& c = host.controller.config;
  demand(r.state == TROCHOID_NOT_READY
             ? r.command_m == 0.0
             : r.command_m >= c.lower_m && r.command_m <= c.upper_m);
  demand(r.fade >= 0.0 && r.fade <= 1.0 && r.angle_rev >= 0.0 && r.angle_rev < 1.0);
  demand(std::isfinite(r.speed_rps) && std::isfinite(r.gain));
}

/// Learnt, and running.
Host running_host() {
  Host host;
  const auto controller = controller_config();
  demand(trochoid_controller_init(&host.controller, &controller) == TROCHOID_ACCEPTED);
  TrochoidOnlineConfig online;
  trochoid_online_defaults(&online);
  online.least_samples = 2;
  demand(trochoid_online_init(&host.online, &online) == TROCHOID_ONLINE_ACCEPTED);
  const auto estimator = estimator_config();
  demand(trochoid_estimator_init(&host.estimator, &estimator) ==
         TROCHOID_ESTIMATOR_ACCEPTED);
  for (int i = 0; i < 200; ++i) step(host, true);
  demand(host.controller.state == TROCHOID_RUNNING);
  demand(host.online.result.learnt > 0 && host.estimator.result.learnt > 0);
  return host;
}

/// Up to eight bytes, where two bytes say.
void spoil(Host& host, Bytes& bytes) {
  std::size_t at = bytes.next<std::uint16_t>() % memory;
  const std::size_t length = bytes.next<std::uint8_t>() % 8 + 1;
  const auto value = bytes.next<std::uint64_t>();
  const auto write = [&](void* place, std::size_t size) {
    if (at < size) {
      std::memcpy(static_cast<char*>(place) + at, &value,
                  length < size - at ? length : size - at);
      at = memory;
    } else if (at != memory) {
      at -= size;
    }
  };
  write(&host.controller, sizeof host.controller);
  write(&host.online, sizeof host.online);
  write(&host.estimator, sizeof host.estimator);
}

}  // namespace

/// Whatever overwrites its memory: the command stays finite and in the window.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Host running = running_host();
  Host host = running;
  Bytes bytes{data, size};
  for (int i = 0; i < 24 || bytes.left > 0; ++i) {
    const auto what = bytes.next<std::uint8_t>();
    for (int spoilt = what % 4; spoilt > 0; --spoilt) spoil(host, bytes);
    step(host, (what & 4U) == 0);
  }
  return 0;
}
