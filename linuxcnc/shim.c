#include "shim.h"

#include <string.h>

static const double um = 1e-6;

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

static void begin_estimating(TrochoidHal* hal) {
  TrochoidEstimatorConfig config = hal->hal_model;
  config.most_m = 0.5 * um * (hal->hal_settings.set_upper_um - hal->hal_settings.set_lower_um);
  config.step_m = 0.5 * config.most_m;
  config.least_force_N = hal->hal_settings.set_least_force;
  config.event_change = hal->hal_settings.set_tool_change;
  if (trochoid_estimator_init(&hal->hal_estimator, &config) ==
      TROCHOID_ESTIMATOR_ACCEPTED) {
    hal->hal_learning = 1;
  }
}

/* What is learnt or set for this period: the waves with a model, else the gain. */
static void set_learnt(TrochoidHal* hal, const TrochoidHalIn* in,
                       TrochoidControllerInput* input) {
  input->gain = in->in_gain;
  if (!in->in_learn) {
    hal->hal_learning = 0;
    return;
  }
  if (!hal->hal_learning) {
    if (hal->hal_model.teeth > 0) {
      begin_estimating(hal);
    } else {
      begin_learning(hal, in->in_gain);
    }
  }
  if (hal->hal_learning && hal->hal_model.teeth > 0) {
    memcpy(input->cosine_m, hal->hal_estimator.result.cosine_m, sizeof input->cosine_m);
    memcpy(input->sine_m, hal->hal_estimator.result.sine_m, sizeof input->sine_m);
  } else if (hal->hal_learning) {
    input->gain = hal->hal_online.result.gain;
  }
}

/* One sample of the force, with the angle that the controller knows. */
static void learn(TrochoidHal* hal, const TrochoidHalIn* in,
                  const TrochoidControllerResult* now) {
  const int active = now->state == TROCHOID_RUNNING;
  TrochoidEstimatorResult learnt;
  if (hal->hal_model.teeth == 0) {
    hal->hal_out.out_difference =
        trochoid_online_sample(&hal->hal_online, now->angle_rev, in->in_force, active)
            .difference;
    return;
  }
  learnt = trochoid_estimator_sample(&hal->hal_estimator,
                                     now->angle_rev + hal->hal_settings.set_phase_turns,
                                     in->in_force, active);
  hal->hal_out.out_difference = learnt.difference;
  hal->hal_out.out_tool_events = learnt.events;
  hal->hal_out.out_tooth = learnt.tooth;
  hal->hal_out.out_tooth_change_um = learnt.change_m / um;
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
  set_learnt(hal, in, &input);
  input.dt_s = in->in_dt;
  input.index = in->in_index;
  input.enable = in->in_enable;
  input.inhibit = in->in_inhibit;
  result = trochoid_controller_step(&hal->hal_controller, &input);
  if (hal->hal_learning) {
    learn(hal, in, &result);
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
