#include <trochoid/correction/estimator.h>
#include <trochoid/correction/online.h>

#include <cmath>
#include <cstdint>

#include "bytes.h"

namespace {

using trochoid::fuzz::Bytes;
using trochoid::fuzz::demand;

/// Defaults, changed where the bytes say so.
TrochoidOnlineConfig online_config(Bytes& bytes) {
  TrochoidOnlineConfig c;
  trochoid_online_defaults(&c);
  c.least_samples = 2;
  double* const numbers[] = {
      &c.window_start_rev, &c.window_rev, &c.gain,          &c.gain_low,
      &c.gain_high,        &c.gain_step,  &c.rate,          &c.feed_per_tooth_m,
      &c.difference_m,     &c.exponent,   &c.least_force_N, &c.deadband};
  const auto which = bytes.next<std::uint16_t>();
  for (unsigned i = 0; i < 12; ++i) {
    if ((which >> i & 1U) != 0) bytes.fill(*numbers[i]);
  }
  c.measure = which >> 12U & 1U;
  c.wait_turns = which >> 13U;
  return c;
}

/// A model of numbers about one, in which the bytes set some.
TrochoidEstimatorConfig estimator_config(Bytes& bytes) {
  TrochoidEstimatorConfig c;
  trochoid_estimator_defaults(&c);
  c.least_samples = 2;
  const auto which = bytes.next<std::uint32_t>();
  c.teeth = static_cast<std::int32_t>(which & 15U);
  c.harmonics = static_cast<std::int32_t>(which >> 4U & 15U);
  c.wait_turns = which >> 8U & 3U;
  c.settled_turns = (which >> 10U & 3U) + 1;
  for (int j = 0; j < TROCHOID_ESTIMATOR_TEETH; ++j) {
    c.start_rev[j] = c.teeth > 0 ? static_cast<double>(j) / c.teeth : 0.0;
    for (int k = 0; k < TROCHOID_ESTIMATOR_WAVES; ++k) {
      c.wave_model[j][k] = 2e4 * std::cos(1.3 * (j + 1) * (k + 1));
    }
    for (int i = 0; i < TROCHOID_ESTIMATOR_TEETH; ++i) {
      c.runout_model[j][i] = i == j ? 3e4 : -1e4;
    }
  }
  double* const numbers[] = {
      &c.most_m, &c.step_m,   &c.rate,          &c.trust,        &c.forgetting,
      &c.noise,  &c.deadband, &c.least_force_N, &c.event_change, &c.start_rev[1]};
  for (unsigned i = 0; i < 10; ++i) {
    if ((which >> (12U + i) & 1U) != 0) bytes.fill(*numbers[i]);
  }
  for (unsigned set = which >> 22U & 7U; set > 0; --set) {
    const auto at = bytes.next<std::uint8_t>();
    bytes.fill((at & 128U) != 0 ? c.wave_model[at & 7U][at >> 3U & 15U]
                                : c.runout_model[at & 7U][at >> 3U & 7U]);
  }
  return c;
}

void sample(TrochoidOnline& online, TrochoidEstimator& estimator, double angle,
            double force, bool active) {
  const auto gain = trochoid_online_sample(&online, angle, force, active ? 1 : 0);
  demand(gain.gain >= online.config.gain_low && gain.gain <= online.config.gain_high);
  demand(gain.difference >= 0.0 && gain.difference <= 1.0);
  demand(std::fabs(gain.residual_m) <= online.config.feed_per_tooth_m);
  demand(gain.force_N[0] >= 0.0 && gain.force_N[1] >= 0.0);
  const auto waves =
      trochoid_estimator_sample(&estimator, angle, force, active ? 1 : 0);
  if (waves.turn == TROCHOID_TURN_NOT_READY) return;
  // No wave of a sum that stays below most_m is larger than 4/pi of it.
  const double most = 1.3 * estimator.config.most_m;
  for (int n = 0; n < TROCHOID_WAVE_HARMONICS; ++n) {
    demand(std::fabs(waves.cosine_m[n]) <= most && std::fabs(waves.sine_m[n]) <= most);
  }
  demand(waves.difference >= 0.0 && waves.difference <= 1.0);
  demand(std::isfinite(waves.change_m));
  demand(waves.tooth >= 0 && waves.tooth <= estimator.config.teeth);
}

}  // namespace

/// Whatever the forces, gain and waves stay within their limits.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes{data, size};
  const auto of_gain = online_config(bytes);
  const auto of_waves = estimator_config(bytes);
  TrochoidOnline online;
  TrochoidEstimator estimator;
  const bool learns =
      trochoid_estimator_init(&estimator, &of_waves) == TROCHOID_ESTIMATOR_ACCEPTED;
  if (trochoid_online_init(&online, &of_gain) != TROCHOID_ONLINE_ACCEPTED) return 0;
  double force[TROCHOID_ESTIMATOR_TEETH] = {100, 80, 90, 120, 70, 95, 105, 60};
  const int teeth = learns ? of_waves.teeth : 2;
  double angle = 0.3;
  while (bytes.left > 0) {
    const auto what = bytes.next<std::uint8_t>();
    if ((what & 1U) != 0) {  // one sample of anything
      angle = (what & 2U) != 0 ? bytes.next<double>() : angle;
      sample(online, estimator, angle, bytes.next<double>(), (what & 4U) != 0);
      angle = std::fabs(angle) < 1e6 ? angle : 0.0;
      continue;
    }
    if ((what & 2U) != 0) {  // a tooth from now on
      force[what >> 5U] =
          (what & 4U) != 0 ? bytes.next<double>() : 0.5 * bytes.next<std::uint8_t>();
    }
    for (int i = 0; i < 34; ++i) {  // a little more than a turn
      angle += 0.03;
      const auto flute = static_cast<int>((angle - std::floor(angle)) * teeth);
      sample(online, estimator, angle, force[flute % TROCHOID_ESTIMATOR_TEETH],
             (what & 8U) == 0);
    }
  }
  return 0;
}
