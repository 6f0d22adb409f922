#include <trochoid/correction/controller.h>
#include <trochoid/correction/controller_memory.h>
#include <trochoid/correction/online.h>

#include <math.h>

namespace {

using trochoid::correction::backwards;
using trochoid::correction::clamped;
using trochoid::correction::fraction;
using trochoid::correction::largest_gap;
using trochoid::correction::most_counted;
using trochoid::correction::most_force;
using trochoid::correction::most_turns;
using trochoid::correction::within;

int32_t refusal(const TrochoidOnlineConfig& c) {
  if (c.teeth != 2) {
    return TROCHOID_ONLINE_REFUSED_TEETH;
  }
  if (!within(c.window_start_rev, -1.0, 1.0) || !within(c.window_rev, 0.01, 0.5) ||
      c.least_samples < 2 || c.least_samples > most_counted ||
      (c.measure != TROCHOID_MEASURE_PEAK && c.measure != TROCHOID_MEASURE_MEAN)) {
    return TROCHOID_ONLINE_REFUSED_WINDOW;
  }
  if (!within(c.gain_low, -1e6, 1e6) || !within(c.gain_high, c.gain_low, 1e6) ||
      !within(c.gain, c.gain_low, c.gain_high) || !within(c.gain_step, 1e-9, 1e6)) {
    return TROCHOID_ONLINE_REFUSED_GAIN;
  }
  if (!within(c.feed_per_tooth_m, 1e-9, 1.0) ||
      !within(fabs(c.difference_m), 1e-9, 1.0) || !within(c.exponent, 0.0, 0.95)) {
    return TROCHOID_ONLINE_REFUSED_CHIP;
  }
  return within(c.rate, 1e-3, 1.5) && within(c.least_force_N, 1e-6, most_force) &&
                 within(c.deadband, 0.0, 0.99) && c.wait_turns >= 0 &&
                 c.wait_turns <= 1000
             ? TROCHOID_ONLINE_ACCEPTED
             : TROCHOID_ONLINE_REFUSED_LEARNING;
}

/// What else may stand in the memory: finite, and within its limits.
bool sound_state(const TrochoidOnline& o) {
  constexpr double most_sum = most_force * most_counted;
  for (int flute = 0; flute < 2; ++flute) {
    if (!within(o.largest_N[flute], 0.0, most_force) ||
        !within(o.sum_N[flute], 0.0, most_sum) ||
        !within(o.result.force_N[flute], 0.0, most_force) || o.samples[flute] < 0) {
      return false;
    }
  }
  return within(o.result.gain, o.config.gain_low, o.config.gain_high) &&
         within(o.result.difference, 0.0, 1.0) &&
         within(fabs(o.result.residual_m), 0.0, o.config.feed_per_tooth_m) &&
         within(o.angle_rev, 0.0, 1.0);
}

void begin_turn(TrochoidOnline& o) {
  for (int flute = 0; flute < 2; ++flute) {
    o.largest_N[flute] = 0.0;
    o.sum_N[flute] = 0.0;
    o.samples[flute] = 0;
  }
  o.gaps = 0;
  o.passive = 0;
  o.begun = 1;
}

double flute_force(const TrochoidOnline& o, int flute) {
  return o.config.measure == TROCHOID_MEASURE_PEAK || o.samples[flute] == 0
             ? o.largest_N[flute]
             : o.sum_N[flute] / o.samples[flute];
}

void learn(TrochoidOnline& o) {
  const TrochoidOnlineConfig& c = o.config;
  const double most = fmax(o.result.force_N[0], o.result.force_N[1]);
  const double power = 1.0 / (1.0 - c.exponent);
  const double q1 = pow(o.result.force_N[0] / most, power);
  const double q2 = pow(o.result.force_N[1] / most, power);
  o.result.residual_m = c.feed_per_tooth_m * ((q1 - q2) / (q1 + q2));  // L-5
  if (o.result.difference <= c.deadband) {
    o.result.turn = TROCHOID_TURN_EQUAL;
    return;
  }
  const double change = c.rate * o.result.residual_m / c.difference_m;
  o.result.gain = clamped(o.result.gain + clamped(change, -c.gain_step, c.gain_step),
                          c.gain_low, c.gain_high);  // L-6
  o.result.turn = TROCHOID_TURN_LEARNT;
  o.result.learnt += o.result.learnt < most_counted ? 1 : 0;
  o.waiting = c.wait_turns;
}

/// Judges the turn that is complete.
void end_turn(TrochoidOnline& o) {
  const TrochoidOnlineConfig& c = o.config;
  const bool full =
      o.gaps == 0 && o.samples[0] >= c.least_samples && o.samples[1] >= c.least_samples;
  if (!full) {
    o.result.turn = TROCHOID_TURN_GAPS;
    return;
  }
  for (int flute = 0; flute < 2; ++flute) {
    o.result.force_N[flute] = flute_force(o, flute);
  }
  const double most = fmax(o.result.force_N[0], o.result.force_N[1]);
  const double least = fmin(o.result.force_N[0], o.result.force_N[1]);
  o.result.difference = most > 0.0 ? (most - least) / most : 0.0;
  if (o.passive != 0) {
    o.result.turn = TROCHOID_TURN_PASSIVE;
  } else if (o.waiting > 0) {
    --o.waiting;
    o.result.turn = TROCHOID_TURN_WAITED;
  } else if (most < c.least_force_N) {
    o.result.turn = TROCHOID_TURN_NO_CUT;
  } else {
    learn(o);
  }
}

/// Adds a sample to the window it lies in, if any.
void add(TrochoidOnline& o, double angle, double force) {
  const int flute = angle < 0.5 ? 0 : 1;
  if (angle - 0.5 * flute >= o.config.window_rev) {
    return;
  }
  const double magnitude = fabs(force);
  o.largest_N[flute] = fmax(o.largest_N[flute], magnitude);
  if (o.samples[flute] < most_counted) {  // the mean is of those that are counted
    o.sum_N[flute] += magnitude;
    ++o.samples[flute];
  }
}

}  // namespace

void trochoid_online_defaults(TrochoidOnlineConfig* config) {
  if (config == nullptr) {
    return;
  }
  *config = TrochoidOnlineConfig{};
  config->teeth = 2;
  config->measure = TROCHOID_MEASURE_PEAK;
  config->least_samples = 8;
  config->wait_turns = 1;
  config->window_rev = 0.5;
  config->gain_high = 1.0;
  config->gain_step = 1.0;
  config->rate = 1.0;
  config->feed_per_tooth_m = 50e-6;
  config->difference_m = 26e-6;
  config->exponent = 0.3;
  config->least_force_N = 1.0;
  config->deadband = 0.005;
}

int32_t trochoid_online_init(TrochoidOnline* online,
                             const TrochoidOnlineConfig* config) {
  if (online == nullptr) {
    return TROCHOID_ONLINE_REFUSED_POINTER;
  }
  if (config == nullptr) {
    online->ready = 0;
    return TROCHOID_ONLINE_REFUSED_POINTER;
  }
  const TrochoidOnlineConfig own = *config;  // it may begin anew with its own
  *online = TrochoidOnline{};
  online->config = own;
  const int32_t refused = refusal(own);
  if (refused == TROCHOID_ONLINE_ACCEPTED) {
    online->result.gain = own.gain;
    online->ready = TROCHOID_READY;
  }
  return refused;
}

TrochoidOnlineResult trochoid_online_sample(TrochoidOnline* online, double angle_rev,
                                            double force_N, int32_t active) {
  TrochoidOnlineResult nothing = {};
  nothing.turn = TROCHOID_TURN_NOT_READY;
  if (online == nullptr || online->ready != TROCHOID_READY) {
    return nothing;
  }
  TrochoidOnline& o = *online;
  if (refusal(o.config) != TROCHOID_ONLINE_ACCEPTED || !sound_state(o)) {
    o.ready = 0;
    o.result = nothing;
    return nothing;
  }
  o.result.turn = TROCHOID_TURN_OPEN;
  if (!within(angle_rev, -most_turns, most_turns) ||
      !within(force_N, -most_force, most_force)) {
    o.gaps = 1;
    return o.result;
  }
  const double angle = fraction(angle_rev - o.config.window_start_rev);
  double moved = angle - o.angle_rev;
  moved -= floor(moved + 0.5);
  const bool wraps = moved >= 0.0 && angle < o.angle_rev;
  if (o.begun != 0 && (moved > largest_gap || moved < -backwards)) {
    o.gaps = 1;
  }
  if (wraps) {
    if (o.begun != 0) {
      end_turn(o);
    }
    begin_turn(o);
  }
  o.angle_rev = angle;
  if (o.begun != 0) {
    o.passive = active != 0 ? o.passive : 1;
    add(o, angle, force_N);
  }
  return o.result;
}

TrochoidOnlineResult trochoid_online_batch(TrochoidOnline* online,
                                           const double* angle_rev,
                                           const double* force_N, int32_t count,
                                           int32_t active) {
  TrochoidOnlineResult last = {};
  last.turn = TROCHOID_TURN_NOT_READY;
  if (online == nullptr || angle_rev == nullptr || force_N == nullptr) {
    return last;
  }
  int32_t turn = TROCHOID_TURN_OPEN;
  last = online->result;
  for (int32_t i = 0; i < count; ++i) {
    last = trochoid_online_sample(online, angle_rev[i], force_N[i], active);
    turn = last.turn != TROCHOID_TURN_OPEN ? last.turn : turn;
  }
  last.turn = online->ready == TROCHOID_READY ? turn : TROCHOID_TURN_NOT_READY;
  return last;
}

const char* trochoid_turn_name(int32_t turn) {
  switch (turn) {
    case TROCHOID_TURN_OPEN:
      return "open";
    case TROCHOID_TURN_LEARNT:
      return "learnt";
    case TROCHOID_TURN_EQUAL:
      return "equal";
    case TROCHOID_TURN_WAITED:
      return "waited";
    case TROCHOID_TURN_NO_CUT:
      return "no cut";
    case TROCHOID_TURN_GAPS:
      return "gaps";
    case TROCHOID_TURN_PASSIVE:
      return "passive";
    default:
      return "not ready";
  }
}

const char* trochoid_online_refusal_reason(int32_t refusal) {
  switch (refusal) {
    case TROCHOID_ONLINE_ACCEPTED:
      return "accepted";
    case TROCHOID_ONLINE_REFUSED_POINTER:
      return "a null pointer";
    case TROCHOID_ONLINE_REFUSED_TEETH:
      return "teeth: 2 only";
    case TROCHOID_ONLINE_REFUSED_WINDOW:
      return "window_start_rev -1 to 1, window_rev 0.01 to 0.5, "
             "least_samples 2 to 1000000, measure 0 or 1";
    case TROCHOID_ONLINE_REFUSED_GAIN:
      return "gain_low <= gain <= gain_high within 1e6, gain_step 1e-9 to 1e6";
    case TROCHOID_ONLINE_REFUSED_CHIP:
      return "feed_per_tooth_m and |difference_m| 1e-9 to 1, exponent 0 to 0.95";
    case TROCHOID_ONLINE_REFUSED_LEARNING:
      return "rate 1e-3 to 1.5, least_force_N 1e-6 to 1e9, deadband 0 to 0.99, "
             "wait_turns 0 to 1000";
    default:
      return "unknown";
  }
}
