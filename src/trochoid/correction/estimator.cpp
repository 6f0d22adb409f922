#include <trochoid/correction/controller_memory.h>
#include <trochoid/correction/estimator.h>
#include <trochoid/correction/estimator_update.h>

#include <math.h>

namespace {

using trochoid::correction::backwards;
using trochoid::correction::fraction;
using trochoid::correction::largest_gap;
using trochoid::correction::most_counted;
using trochoid::correction::most_force;
using trochoid::correction::most_turns;
using trochoid::correction::within;

bool sound_windows(const TrochoidEstimatorConfig& c) {
  for (int32_t j = 0; j < c.teeth; ++j) {
    const double next = j + 1 < c.teeth ? c.start_rev[j + 1] : c.start_rev[0] + 1.0;
    if (!within(c.start_rev[j], -1.0, 2.0) || !(next - c.start_rev[j] >= 0.01)) {
      return false;
    }
  }
  return c.least_samples >= 2 && c.least_samples <= most_counted;
}

bool sound_model(const TrochoidEstimatorConfig& c) {
  double largest = 0.0;
  for (int32_t j = 0; j < c.teeth; ++j) {
    for (int32_t k = 0; k < 2 * c.harmonics; ++k) {
      if (!within(c.wave_model[j][k], -1e9, 1e9)) {
        return false;
      }
      largest = fmax(largest, fabs(c.wave_model[j][k]));
    }
    for (int32_t i = 0; i < c.teeth; ++i) {
      if (!within(c.runout_model[j][i], -1e9, 1e9)) {
        return false;
      }
    }
  }
  return largest > 0.0 && within(c.trust, 1e-6, 100.0) && within(c.noise, 1e-9, 10.0);
}

int32_t refusal(const TrochoidEstimatorConfig& c) {
  if (c.teeth < 2 || c.teeth > TROCHOID_ESTIMATOR_TEETH || c.harmonics < 1 ||
      c.harmonics > TROCHOID_WAVE_HARMONICS) {
    return TROCHOID_ESTIMATOR_REFUSED_TEETH;
  }
  if (!sound_windows(c)) {
    return TROCHOID_ESTIMATOR_REFUSED_WINDOWS;
  }
  if (!sound_model(c)) {
    return TROCHOID_ESTIMATOR_REFUSED_MODEL;
  }
  return within(c.most_m, 1e-9, 1.0) && within(c.step_m, 1e-9, 1.0) &&
                 within(c.rate, 1e-3, 1.5) && within(c.forgetting, 0.5, 1.0) &&
                 within(c.least_force_N, 1e-6, most_force) &&
                 within(c.deadband, 0.0, 0.99) && within(c.event_change, 0.0, 10.0) &&
                 c.wait_turns >= 0 && c.wait_turns <= 1000 && c.settled_turns >= 1 &&
                 c.settled_turns <= 100000
             ? TROCHOID_ESTIMATOR_ACCEPTED
             : TROCHOID_ESTIMATOR_REFUSED_LEARNING;
}

/// What a sample needs: numbers of teeth and waves within the arrays, and waves that the
/// controller may have. Looked at at every sample, as it is short.
bool sound_command(const TrochoidEstimator& e) {
  const TrochoidEstimatorConfig& c = e.config;
  if (c.teeth < 2 || c.teeth > TROCHOID_ESTIMATOR_TEETH || c.harmonics < 1 ||
      c.harmonics > TROCHOID_WAVE_HARMONICS || !within(e.angle_rev, 0.0, 1.0)) {
    return false;
  }
  for (int32_t n = 0; n < TROCHOID_WAVE_HARMONICS; ++n) {
    if (!within(e.result.cosine_m[n], -2.0, 2.0) ||
        !within(e.result.sine_m[n], -2.0, 2.0)) {
      return false;
    }
  }
  return true;
}

/// Finite, so that a turn may be learnt from.
bool sound_state(const TrochoidEstimator& e) {
  constexpr double far = 1e30;
  const int32_t terms = 2 * e.config.harmonics + 1;
  for (int32_t a = 0; a < terms; ++a) {
    for (int32_t b = 0; b < terms; ++b) {
      if (!within(e.P[a][b], -far, far)) {
        return false;
      }
    }
    if (!within(e.most_P[a], 0.0, far) || !(e.P[a][a] >= 0.0) ||
        (a > 0 && !within(e.wave[a - 1], -far, far))) {
      return false;
    }
  }
  for (int32_t j = 0; j < e.config.teeth; ++j) {
    for (int32_t a = 0; a < terms; ++a) {
      if (!within(e.theta[j][a], -far, far)) {
        return false;
      }
    }
    if (!within(e.reference[j], -far, far) ||
        !within(e.largest_N[j], 0.0, most_force)) {
      return false;
    }
  }
  return within(e.result.difference, 0.0, 1.0) && e.odd >= 0 && e.odd < 2 &&
         refusal(e.config) == TROCHOID_ESTIMATOR_ACCEPTED;
}

void begin_turn(TrochoidEstimator& e) {
  for (int32_t j = 0; j < e.config.teeth; ++j) {
    e.largest_N[j] = 0.0;
    e.samples[j] = 0;
  }
  e.gaps = 0;
  e.passive = 0;
  e.begun = 1;
}

/// Adds a sample to the window it lies in.
void add(TrochoidEstimator& e, double angle, double force) {
  const TrochoidEstimatorConfig& c = e.config;
  int32_t flute = 0;
  for (int32_t j = 1; j < c.teeth; ++j) {
    flute = angle >= c.start_rev[j] - c.start_rev[0] ? j : flute;
  }
  e.largest_N[flute] = fmax(e.largest_N[flute], fabs(force));
  e.samples[flute] += e.samples[flute] < most_counted ? 1 : 0;
}

bool full(const TrochoidEstimator& e) {
  for (int32_t j = 0; j < e.config.teeth; ++j) {
    if (e.samples[j] < e.config.least_samples) {
      return false;
    }
  }
  return e.gaps == 0;
}

/// Nothing is commanded any more until it is begun anew, nor by who reads its memory.
TrochoidEstimatorResult not_ready(TrochoidEstimator* e) {
  TrochoidEstimatorResult nothing = {};
  nothing.turn = TROCHOID_TURN_NOT_READY;
  if (e != nullptr) {
    e->ready = 0;
    e->result = nothing;
  }
  return nothing;
}

/// Judges the turn that is complete.
void end_turn(TrochoidEstimator& e) {
  e.result.event = TROCHOID_TOOL_UNCHANGED;
  if (!full(e)) {
    e.result.turn = TROCHOID_TURN_GAPS;
    return;
  }
  double most = 0.0;
  double least = most_force;
  for (int32_t j = 0; j < e.config.teeth; ++j) {
    e.result.force_N[j] = e.largest_N[j];
    most = fmax(most, e.largest_N[j]);
    least = fmin(least, e.largest_N[j]);
  }
  e.result.difference = most > 0.0 ? (most - least) / most : 0.0;
  if (e.passive != 0) {
    e.result.turn = TROCHOID_TURN_PASSIVE;
  } else if (e.waiting > 0) {
    --e.waiting;
    e.result.turn = TROCHOID_TURN_WAITED;
  } else if (most < e.config.least_force_N) {
    e.result.turn = TROCHOID_TURN_NO_CUT;
  } else {
    trochoid::correction::learn_turn(e);
  }
}

}  // namespace

void trochoid_estimator_defaults(TrochoidEstimatorConfig* config) {
  if (config == nullptr) {
    return;
  }
  *config = TrochoidEstimatorConfig{};
  config->teeth = 4;
  config->harmonics = 3;
  config->least_samples = 8;
  config->wait_turns = 1;
  for (int32_t j = 0; j < TROCHOID_ESTIMATOR_TEETH; ++j) {
    config->start_rev[j] = 0.25 * j;
  }
  config->most_m = 25e-6;
  config->step_m = 10e-6;
  config->rate = 0.7;
  config->forgetting = 0.85;
  config->trust = 0.3;
  config->noise = 0.01;
  config->least_force_N = 1.0;
  config->deadband = 0.005;
  config->event_change = 0.1;
  config->settled_turns = 10;
}

int32_t trochoid_estimator_init(TrochoidEstimator* estimator,
                                const TrochoidEstimatorConfig* config) {
  if (estimator == nullptr) {
    return TROCHOID_ESTIMATOR_REFUSED_POINTER;
  }
  if (config == nullptr) {
    estimator->ready = 0;
    return TROCHOID_ESTIMATOR_REFUSED_POINTER;
  }
  const TrochoidEstimatorConfig own = *config;  // it may begin anew with its own
  *estimator = TrochoidEstimator{};
  estimator->config = own;
  const int32_t refused = refusal(own);
  if (refused == TROCHOID_ESTIMATOR_ACCEPTED) {
    trochoid::correction::begin_learning(*estimator);
    estimator->ready = TROCHOID_READY;
  }
  return refused;
}

TrochoidEstimatorResult trochoid_estimator_sample(TrochoidEstimator* estimator,
                                                  double angle_rev, double force_N,
                                                  int32_t active) {
  if (estimator == nullptr || estimator->ready != TROCHOID_READY ||
      !sound_command(*estimator)) {
    return not_ready(estimator);
  }
  TrochoidEstimator& e = *estimator;
  e.result.turn = TROCHOID_TURN_OPEN;
  if (!within(angle_rev, -most_turns, most_turns) ||
      !within(force_N, -most_force, most_force)) {
    e.gaps = 1;
    return e.result;
  }
  const double angle = fraction(angle_rev - e.config.start_rev[0]);
  double moved = angle - e.angle_rev;
  moved -= floor(moved + 0.5);
  if (e.begun != 0 && (moved > largest_gap || moved < -backwards)) {
    e.gaps = 1;
  }
  if (moved >= 0.0 && angle < e.angle_rev) {
    if (!sound_state(e)) {
      return not_ready(estimator);
    }
    if (e.begun != 0) {
      end_turn(e);
    }
    begin_turn(e);
  }
  e.angle_rev = angle;
  if (e.begun != 0) {
    e.passive = active != 0 ? e.passive : 1;
    add(e, angle, force_N);
  }
  return e.result;
}

const char* trochoid_tool_event_name(int32_t event) {
  switch (event) {
    case TROCHOID_TOOL_UNCHANGED:
      return "unchanged";
    case TROCHOID_TOOTH_WORN:
      return "a tooth has changed";
    case TROCHOID_TOOL_CHANGED:
      return "the tool has changed";
    default:
      return "unknown";
  }
}

const char* trochoid_estimator_refusal_reason(int32_t refusal) {
  switch (refusal) {
    case TROCHOID_ESTIMATOR_ACCEPTED:
      return "accepted";
    case TROCHOID_ESTIMATOR_REFUSED_POINTER:
      return "a null pointer";
    case TROCHOID_ESTIMATOR_REFUSED_TEETH:
      return "teeth 2 to 8, harmonics 1 to 8";
    case TROCHOID_ESTIMATOR_REFUSED_WINDOWS:
      return "start_rev -1 to 2, ascending by 0.01 at least within one turn; "
             "least_samples 2 to 1000000";
    case TROCHOID_ESTIMATOR_REFUSED_MODEL:
      return "wave_model and runout_model finite, the first not all 0; "
             "trust 1e-6 to 100, noise 1e-9 to 10";
    case TROCHOID_ESTIMATOR_REFUSED_LEARNING:
      return "most_m, step_m 1e-9 to 1, rate 1e-3 to 1.5, forgetting 0.5 to 1, "
             "least_force_N 1e-6 to 1e9, deadband 0 to 0.99, event_change 0 to 10, "
             "wait_turns 0 to 1000, settled_turns 1 to 100000";
    default:
      return "unknown";
  }
}
