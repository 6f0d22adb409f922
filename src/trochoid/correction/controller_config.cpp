#include <trochoid/correction/controller.h>
#include <trochoid/correction/controller_memory.h>

#include <math.h>

namespace {

using trochoid::correction::within;

constexpr double most_gain = 1e6;  // larger ones are absurd as an input

double largest(const TrochoidControllerConfig& c) {
  double most = 0.0;
  for (int32_t i = 0; i < c.points; ++i) {
    most = fmax(most, fabs(c.table_m[i]));
  }
  return most;
}

bool finite_table(const TrochoidControllerConfig& c) {
  for (int32_t i = 0; i < c.points; ++i) {
    if (!within(c.table_m[i], -1.0, 1.0)) {
      return false;
    }
  }
  return true;
}

bool sound_window(const TrochoidControllerConfig& c) {
  return within(c.lower_m, -1.0, 1.0) && within(c.upper_m, -1.0, 1.0) &&
         c.upper_m - c.lower_m >= 1e-9 && within(c.start_m, c.lower_m, c.upper_m);
}

bool sound_times(const TrochoidControllerConfig& c) {
  return within(c.period_s, 1e-6, 0.1) && within(c.max_step_s, c.period_s, 1.0) &&
         within(c.fade_s, 1e-3, 100.0) && within(c.ramp_s, 1e-3, 100.0) &&
         within(c.gain_time_s, 1e-3, 100.0);
}

bool sound_speeds(const TrochoidControllerConfig& c) {
  return within(c.min_speed_rps, 1e-3, 1e5) && within(c.max_speed_rps, 1e-3, 1e5) &&
         c.min_speed_rps < c.max_speed_rps && within(c.speed_change, 1e-6, 1.0) &&
         within(c.filter_rev, 0.25, 100.0);
}

/// But for what is in the table.
int32_t refused_settings(const TrochoidControllerConfig& c) {
  if (c.points < 2 || c.points > TROCHOID_TABLE_POINTS) {
    return TROCHOID_REFUSED_POINTS;
  }
  if (!sound_window(c)) {
    return TROCHOID_REFUSED_WINDOW;
  }
  if (!sound_times(c)) {
    return TROCHOID_REFUSED_TIMES;
  }
  if (!within(c.lead_s, 0.0, 0.1) || !within(c.phase_rev, -10.0, 10.0)) {
    return TROCHOID_REFUSED_LEAD;
  }
  if (!within(c.slew_m_per_s, 1e-9, 1e3)) {
    return TROCHOID_REFUSED_SLEW;
  }
  if (!sound_speeds(c)) {
    return TROCHOID_REFUSED_SPEEDS;
  }
  if (!within(c.position_tol_rev, 1e-6, 0.25) ||
      !within(c.index_turns, 1.0 + c.position_tol_rev, 1000.0)) {
    return TROCHOID_REFUSED_INDEX;
  }
  if (c.wrap_rev != 0.0 && !within(c.wrap_rev, 0.01, 1e10)) {
    return TROCHOID_REFUSED_WRAP;
  }
  const bool known = c.recovery == TROCHOID_RECOVER_BY_ENABLE ||
                     c.recovery == TROCHOID_RECOVER_BY_TURNS;
  return known && c.good_turns >= 1 && c.good_turns <= 1000 ? TROCHOID_ACCEPTED
                                                            : TROCHOID_REFUSED_RECOVERY;
}

int32_t refusal(const TrochoidControllerConfig& c) {
  if (c.points >= 2 && c.points <= TROCHOID_TABLE_POINTS && !finite_table(c)) {
    return TROCHOID_REFUSED_TABLE;
  }
  const int32_t refused = refused_settings(c);
  if (refused != TROCHOID_ACCEPTED && refused <= TROCHOID_REFUSED_WINDOW) {
    return refused;
  }
  return largest(c) > 0.5 * (c.upper_m - c.lower_m)
             ? static_cast<int32_t>(TROCHOID_REFUSED_STROKE)
             : refused;
}

/// Everything but the table, without which it could not even come to rest.
void rest_at_middle(TrochoidController& c) {
  c.fade = 0.0;
  c.gain = 1.0;
  c.speed_rps = 0.0;
  c.reference_rps = 0.0;
  c.zero_rev = 0.0;
  c.angle_rev = 0.0;
  c.expected_rev = 0.0;
  c.position_rev = 0.0;
  for (int32_t n = 0; n < TROCHOID_WAVE_HARMONICS; ++n) {
    c.cosine_m[n] = 0.0;
    c.sine_m[n] = 0.0;
  }
  c.turns = 0;
  c.synchronised = 0;
  c.speed_known = 0;
}

bool finite_waves(const TrochoidController& c) {
  for (int32_t n = 0; n < TROCHOID_WAVE_HARMONICS; ++n) {
    if (!within(c.cosine_m[n], -1.0, 1.0) || !within(c.sine_m[n], -1.0, 1.0)) {
      return false;
    }
  }
  return true;
}

bool finite_state(const TrochoidController& c) {
  constexpr double far = 1e12;
  const double turns[] = {c.speed_rps, c.reference_rps, c.zero_rev,
                          c.angle_rev, c.expected_rev,  c.position_rev};
  for (const double value : turns) {
    if (!within(value, -far, far)) {
      return false;
    }
  }
  return within(c.fade, 0.0, 1.0) && within(c.gain, -far, far) && finite_waves(c) &&
         within(c.output_m, c.config.lower_m, c.config.upper_m);
}

}  // namespace

namespace trochoid::correction {

bool repair_memory(TrochoidController& c) {
  if (refused_settings(c.config) != TROCHOID_ACCEPTED) {
    c.ready = 0;
    return false;
  }
  const double half = 0.5 * (c.config.upper_m - c.config.lower_m);
  const double slope = fmin(c.config.slew_m_per_s, half / c.config.ramp_s);
  const bool derived = c.middle_m == c.config.lower_m + half &&
                       c.ramp_m_per_s == slope && within(c.gain_limit, 1.0, most_gain);
  if (derived && finite_state(c)) {
    return true;
  }
  c.middle_m = c.config.lower_m + half;
  c.ramp_m_per_s = slope;
  c.gain_limit = 1.0;
  rest_at_middle(c);
  if (!within(c.output_m, c.config.lower_m, c.config.upper_m)) {
    c.output_m = c.middle_m;
  }
  return false;
}

}  // namespace trochoid::correction

void trochoid_controller_defaults(TrochoidControllerConfig* config) {
  if (config == nullptr) {
    return;
  }
  *config = TrochoidControllerConfig{};
  config->points = 2;
  config->recovery = TROCHOID_RECOVER_BY_ENABLE;
  config->good_turns = 1;
  config->period_s = 1e-3;
  config->max_step_s = 5e-3;
  config->upper_m = 60e-6;
  config->slew_m_per_s = 0.02;
  config->fade_s = 0.3;
  config->ramp_s = 0.2;
  config->gain_time_s = 0.02;
  config->filter_rev = 0.25;
  config->min_speed_rps = 1.0;
  config->max_speed_rps = 100.0;
  config->speed_change = 0.1;
  config->index_turns = 1.5;
  config->position_tol_rev = 0.1;
}

int32_t trochoid_controller_init(TrochoidController* controller,
                                 const TrochoidControllerConfig* config) {
  if (controller == nullptr) {
    return TROCHOID_REFUSED_POINTER;
  }
  if (config == nullptr) {
    controller->ready = 0;
    return TROCHOID_REFUSED_POINTER;
  }
  TrochoidController& c = *controller;
  const TrochoidControllerConfig own = *config;  // it may begin anew with its own
  c = TrochoidController{};
  c.config = own;
  config = &c.config;
  const int32_t refused = refusal(c.config);
  if (refused != TROCHOID_ACCEPTED) {
    return refused;
  }
  const double half = 0.5 * (config->upper_m - config->lower_m);
  const double most = largest(*config);
  c.middle_m = config->lower_m + half;
  c.ramp_m_per_s = fmin(config->slew_m_per_s, half / config->ramp_s);
  c.gain_limit = most > 0.0 ? fmin(half / most, most_gain) : 1.0;
  c.output_m = config->start_m;
  c.gain = 1.0;
  c.state = TROCHOID_DISABLED;
  c.ready = TROCHOID_READY;
  return TROCHOID_ACCEPTED;
}

const char* trochoid_state_name(int32_t state) {
  switch (state) {
    case TROCHOID_DISABLED:
      return "disabled";
    case TROCHOID_WAITING:
      return "waiting";
    case TROCHOID_FADING_IN:
      return "fading in";
    case TROCHOID_RUNNING:
      return "running";
    case TROCHOID_FADING_OUT:
      return "fading out";
    case TROCHOID_FAULT:
      return "fault";
    default:
      return "not ready";
  }
}

const char* trochoid_problem_name(int32_t problem) {
  switch (problem) {
    case TROCHOID_NO_PROBLEM:
      return "none";
    case TROCHOID_BAD_TIME:
      return "time does not pass as it should";
    case TROCHOID_BAD_INPUT:
      return "an input is not finite, or absurd";
    case TROCHOID_INHIBITED:
      return "inhibited";
    case TROCHOID_OVERSPEED:
      return "the spindle is too fast";
    case TROCHOID_UNDERSPEED:
      return "the spindle is too slow";
    case TROCHOID_INDEX_LOST:
      return "no index pulse";
    case TROCHOID_BAD_POSITION:
      return "position, speed and index contradict";
    case TROCHOID_SPEED_CHANGED:
      return "the speed has changed";
    case TROCHOID_BAD_MEMORY:
      return "the controller's memory was overwritten";
    default:
      return "unknown";
  }
}

const char* trochoid_refusal_reason(int32_t refusal) {
  switch (refusal) {
    case TROCHOID_ACCEPTED:
      return "accepted";
    case TROCHOID_REFUSED_POINTER:
      return "a null pointer";
    case TROCHOID_REFUSED_POINTS:
      return "points: 2 to 720";
    case TROCHOID_REFUSED_TABLE:
      return "table_m: finite, within 1 m";
    case TROCHOID_REFUSED_WINDOW:
      return "lower_m < upper_m, start_m between them";
    case TROCHOID_REFUSED_STROKE:
      return "table_m leaves the window";
    case TROCHOID_REFUSED_TIMES:
      return "period_s 1e-6 to 0.1, max_step_s from it to 1, "
             "fade_s, ramp_s, gain_time_s 1e-3 to 100";
    case TROCHOID_REFUSED_LEAD:
      return "lead_s 0 to 0.1, phase_rev -10 to 10";
    case TROCHOID_REFUSED_SLEW:
      return "slew_m_per_s 1e-9 to 1e3";
    case TROCHOID_REFUSED_SPEEDS:
      return "min_speed_rps < max_speed_rps, both 1e-3 to 1e5; "
             "speed_change 1e-6 to 1; filter_rev 0.25 to 100";
    case TROCHOID_REFUSED_INDEX:
      return "position_tol_rev 1e-6 to 0.25, index_turns 1 + that to 1000";
    case TROCHOID_REFUSED_RECOVERY:
      return "recovery 0 or 1, good_turns 1 to 1000";
    case TROCHOID_REFUSED_WRAP:
      return "wrap_rev 0, or 0.01 to 1e10";
    default:
      return "unknown";
  }
}
