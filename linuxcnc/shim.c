#include "shim.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double um = 1e-6;

/* Which field of a line of names a column is; -1: none. */
static int column_of(const char* line, const char* name) {
  const size_t length = strlen(name);
  int column = 0;
  for (;;) {
    const size_t field = strcspn(line, ",\r\n");
    if (field == length && strncmp(line, name, length) == 0) {
      return column;
    }
    if (line[field] != ',') {
      return -1;
    }
    line += field + 1;
    ++column;
  }
}

/* The number in a field; NaN if there is none. */
static double number_in(const char* line, int column) {
  char* end;
  double value;
  for (; column > 0; --column) {
    line = strchr(line, ',');
    if (line == NULL) {
      return NAN;
    }
    ++line;
  }
  value = strtod(line, &end);
  return end == line ? NAN : value;
}

/* Angles equally spaced over a turn, and the command around its middle. */
static const char* check_table(TrochoidHal* hal, const double* angle) {
  double low = hal->hal_table_um[0], high = low;
  int i;
  if (hal->hal_points < 2) {
    return "fewer than two points";
  }
  for (i = 0; i < hal->hal_points; ++i) {
    const double value = hal->hal_table_um[i];
    if (!(fabs(angle[i] - 360.0 * i / hal->hal_points) < 1e-3)) {
      return "angles are not equally spaced from 0 to below 360 deg";
    }
    if (!(fabs(value) < 1e6)) {
      return "a command is not a number";
    }
    low = value < low ? value : low;
    high = value > high ? value : high;
  }
  for (i = 0; i < hal->hal_points; ++i) {
    hal->hal_table_um[i] -= 0.5 * (low + high);
  }
  return NULL;
}

const char* trochoid_hal_read_table(TrochoidHal* hal, const char* path) {
  static double angle[TROCHOID_TABLE_POINTS];
  char line[4096];
  int angles = 0, commands = 1;
  FILE* file = fopen(path, "r");
  hal->hal_points = 0;
  if (file == NULL) {
    return "cannot be opened";
  }
  while (fgets(line, sizeof line, file) != NULL) {
    if (line[0] == '#' || line[strspn(line, " \t\r\n")] == '\0') {
      continue;
    }
    if (hal->hal_points == 0 && isnan(number_in(line, 0))) {
      angles = column_of(line, "angle_deg");
      commands = column_of(line, "command_um");
      if (angles < 0 || commands < 0) {
        break;
      }
      continue;
    }
    if (hal->hal_points == TROCHOID_TABLE_POINTS) {
      hal->hal_points = 0;
      fclose(file);
      return "more than 720 points";
    }
    angle[hal->hal_points] = number_in(line, angles);
    hal->hal_table_um[hal->hal_points] = number_in(line, commands);
    ++hal->hal_points;
  }
  fclose(file);
  if (angles < 0 || commands < 0) {
    return "has no columns angle_deg and command_um";
  }
  return check_table(hal, angle);
}

static void set_config(TrochoidControllerConfig* config, const TrochoidHal* hal,
                       const TrochoidHalSettings* s) {
  int i;
  trochoid_controller_defaults(config);
  if (hal->hal_points > 0) { /* without a file: nothing is commanded but mid-stroke */
    config->points = hal->hal_points;
  }
  for (i = 0; i < hal->hal_points; ++i) {
    config->table_m[i] = um * hal->hal_table_um[i];
  }
  config->lower_m = um * s->set_lower_um;
  config->upper_m = um * s->set_upper_um;
  config->start_m = um * s->set_start_um;
  config->slew_m_per_s = um * s->set_slew_um_per_s;
  config->lead_s = s->set_lead_s;
  config->phase_rev = s->set_phase_turns;
  config->period_s = s->set_period_s;
  config->max_step_s = 5.0 * s->set_period_s;
  config->fade_s = s->set_fade_s;
  config->ramp_s = s->set_ramp_s;
  config->min_speed_rps = s->set_min_rps;
  config->max_speed_rps = s->set_max_rps;
  config->speed_change = s->set_speed_change;
  config->index_turns = s->set_index_turns;
  config->position_tol_rev = s->set_position_tol_turns;
  config->wrap_rev = s->set_wrap_turns;
  config->recovery =
      s->set_recover != 0.0 ? TROCHOID_RECOVER_BY_TURNS : TROCHOID_RECOVER_BY_ENABLE;
  config->good_turns = (int)s->set_good_turns;
}

/* Takes new settings while nothing moves. Refused ones leave the old ones in force. */
static void configure(TrochoidHal* hal, const TrochoidHalSettings* settings) {
  TrochoidController* candidate = &hal->hal_candidate;
  const double before = hal->hal_controller.output_m;
  const int ran = hal->hal_controller.ready == TROCHOID_READY;
  set_config(&candidate->config, hal, settings);
  if (ran) { /* from where it stands, if that is still allowed */
    candidate->config.start_m = before;
  }
  hal->hal_out.out_refused = trochoid_controller_init(candidate, &candidate->config);
  if (hal->hal_out.out_refused == TROCHOID_ACCEPTED) {
    hal->hal_controller = *candidate;
  }
  hal->hal_settings = *settings;
  hal->hal_configured = 1;
  hal->hal_learning = 0; /* begins anew with the settings of now */
}

static double table_difference(const TrochoidControllerConfig* config) {
  double low = config->table_m[0], high = low;
  int i;
  for (i = 1; i < config->points; ++i) {
    low = config->table_m[i] < low ? config->table_m[i] : low;
    high = config->table_m[i] > high ? config->table_m[i] : high;
  }
  return high - low;
}

static void begin_learning(TrochoidHal* hal, double gain) {
  const TrochoidHalSettings* s = &hal->hal_settings;
  TrochoidOnlineConfig config;
  trochoid_online_defaults(&config);
  config.gain_high = trochoid_controller_gain_limit(&hal->hal_controller);
  config.gain_step = config.gain_high > 0.0 ? config.gain_high : 1.0;
  config.gain = gain >= 0.0 ? (gain < config.gain_high ? gain : config.gain_high) : 0.0;
  config.difference_m = table_difference(&hal->hal_controller.config);
  config.feed_per_tooth_m = um * s->set_feed_um;
  config.exponent = s->set_exponent;
  config.least_force_N = s->set_least_force;
  if (trochoid_online_init(&hal->hal_online, &config) == TROCHOID_ONLINE_ACCEPTED) {
    hal->hal_learning = 1;
  }
}

/* The gain for this period, learnt or set. */
static double gain_of(TrochoidHal* hal, const TrochoidHalIn* in) {
  if (!in->in_learn) {
    hal->hal_learning = 0;
  } else if (!hal->hal_learning) {
    begin_learning(hal, in->in_gain);
  }
  return hal->hal_learning ? hal->hal_online.result.gain : in->in_gain;
}

void trochoid_hal_step(TrochoidHal* hal, const TrochoidHalSettings* settings,
                       const TrochoidHalIn* in, TrochoidHalOut* out) {
  TrochoidControllerInput input;
  TrochoidControllerResult result;
  const int state = hal->hal_out.out_state;
  const int rests =
      !in->in_enable && (state == TROCHOID_DISABLED || state == TROCHOID_NOT_READY);
  if (!hal->hal_configured ||
      (rests && memcmp(settings, &hal->hal_settings, sizeof *settings) != 0)) {
    configure(hal, settings);
  }
  memset(&input, 0, sizeof input);
  input.position_rev = in->in_position;
  input.speed_rps = in->in_speed;
  input.gain = gain_of(hal, in);
  input.dt_s = in->in_dt;
  input.index = in->in_index;
  input.enable = in->in_enable;
  input.inhibit = in->in_inhibit;
  result = trochoid_controller_step(&hal->hal_controller, &input);
  if (hal->hal_learning) {
    hal->hal_out.out_difference =
        trochoid_online_sample(&hal->hal_online, result.angle_rev, in->in_force,
                               result.state == TROCHOID_RUNNING)
            .difference;
  }
  hal->hal_out.out_command_um = result.command_m / um;
  hal->hal_out.out_angle = result.angle_rev;
  hal->hal_out.out_fade = result.fade;
  hal->hal_out.out_gain = result.gain;
  hal->hal_out.out_speed = result.speed_rps;
  hal->hal_out.out_state = result.state;
  hal->hal_out.out_problem = result.problem;
  hal->hal_out.out_fault = result.fault;
  hal->hal_out.out_limited = result.limited;
  hal->hal_out.out_turns = result.turns;
  *out = hal->hal_out;
}
