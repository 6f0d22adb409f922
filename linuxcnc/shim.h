#pragma once

/* Between the component and the controller. The names of pins and parameters are macros
   in what halcompile makes, and would break the fields of the same name in
   controller.h: so the component sees only this file, whose fields have prefixes that
   no pin has. */
#ifdef __cplusplus
extern "C" {
#endif

#include <trochoid/correction/controller.h>
#include <trochoid/correction/estimator.h>
#include <trochoid/correction/online.h>

/* What the parameters say. Lengths in um, angles in turns, times in seconds. */
typedef struct TrochoidHalSettings {
  double set_lower_um, set_upper_um, set_start_um, set_slew_um_per_s;
  double set_lead_s, set_phase_turns, set_period_s, set_fade_s, set_ramp_s;
  double set_min_rps, set_max_rps, set_speed_change;
  double set_index_turns, set_position_tol_turns, set_wrap_turns;
  double set_recover, set_good_turns;
  double set_feed_um, set_exponent, set_least_force, set_tool_change;
} TrochoidHalSettings;

typedef struct TrochoidHalIn {
  double in_position, in_speed, in_gain, in_force, in_dt;
  int in_index; /* the pulse came, and set the position to zero */
  int in_enable, in_inhibit, in_learn;
} TrochoidHalIn;

typedef struct TrochoidHalOut {
  double out_command_um, out_angle, out_fade, out_gain, out_speed, out_difference;
  double out_tooth_change_um;
  int out_tool_events, out_tooth;
  int out_state, out_problem, out_fault, out_limited, out_turns, out_refused;
} TrochoidHalOut;

/* One instance: plain data in the shared memory of HAL. */
typedef struct TrochoidHal {
  TrochoidController hal_controller;
  TrochoidController hal_candidate;
  TrochoidOnline hal_online;
  TrochoidEstimator hal_estimator;
  TrochoidEstimatorConfig hal_model; /* of no teeth: none was read */
  TrochoidHalSettings hal_settings;
  TrochoidHalOut hal_out;
  double hal_table_um[TROCHOID_TABLE_POINTS];
  int hal_points;
  int hal_configured; /* settings were looked at, with success or without */
  int hal_learning;
} TrochoidHal;

/* Reads the columns angle_deg and command_um of a CSV file, or the first two; angles
   equally spaced from 0. The middle of the command is put at mid-stroke. Not in real
   time. Returns null, or what is wrong. */
const char* trochoid_hal_read_table(TrochoidHal* hal, const char* path);

/* Reads the estimator.csv of `trochoid correct`, columns by their names. Not in real time.
   Returns null, or what is wrong; then there is no model. */
const char* trochoid_hal_read_model(TrochoidHal* hal, const char* path);

/* One period. New settings are taken while the command rests and enable is off. */
void trochoid_hal_step(TrochoidHal* hal, const TrochoidHalSettings* settings,
                       const TrochoidHalIn* in, TrochoidHalOut* out);

#ifdef __cplusplus
}
#endif
