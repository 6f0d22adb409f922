component trochoid_correct "Moves a piezo-driven table once per spindle revolution so that every flute cuts the same chip";
description """
Looks up a command over one revolution at the angle of the spindle, ahead by the delay of the
actuator, and gives it to a piezo amplifier within its stroke and slope. On a lost index pulse, a
wrong speed, a jump of the position or *inhibit* it ramps to mid-stroke. Not part of any safety
chain.

The table is read when the module is loaded: *loadrt trochoid_correct table=/path/command.csv*, with
columns angle_deg and command_um; *model=/path/estimator.csv* tells how to learn with any number of
flutes. Both are written by *trochoid correct*. Parameters are taken while *enable* is off and the command rests.
The guide of the project (docs/guide/controller.md) has the states, the faults and their times.
""";
author "The Trochoid authors";
license "GPL";

pin in float position "Spindle position since the index pulse, turns (encoder.N.position with position-scale = counts per turn)";
pin io bit index_enable "Connect to encoder.N.index-enable: set here, cleared by the encoder when it sets the position to zero";
pin in float speed "Spindle speed, turns per second (encoder.N.velocity); may be coarse";
pin in bit enable "Run; connect to spindle.0.at-speed and a switch";
pin in bit inhibit "Ramp to mid-stroke at once; connect to the amplifier's fault line";
pin in float gain = 1.0 "Factor of the table; where learning begins";
pin in bit learn "Learn from the force until all flutes have the same peak: with model= waves that are added to the table, else the gain of two flutes";
pin in float force "A component of the cutting force, N; for learning";

pin out float command_um "To the amplifier";
pin out float angle "Spindle angle in use, turns";
pin out float fade "Part of the command that is given";
pin out float gain_now "Gain in force";
pin out float speed_filtered "Turns per second";
pin out float difference "Of the flutes' peaks in the last turn, over the larger; while learning";
pin out s32 tool_events "Changes of the tool that were recognised; with model=";
pin out s32 tooth "That the last one was of, from 1; 0: several";
pin out float tooth_change_um "By how much that tooth stands out more";
pin out s32 state "0 disabled, 1 waiting, 2 fading in, 3 running, 4 fading out, 5 fault, 6 not ready";
pin out s32 problem "Of this period: 0 none, 1 time, 2 input, 3 inhibited, 4 overspeed, 5 underspeed, 6 index lost, 7 position, 8 speed changed";
pin out s32 fault "What ended the last run, numbered as problem";
pin out s32 limited "1 the slope, 2 the gain is cut off, 3 both";
pin out s32 turns "In order, one after another";
pin out s32 refused "Not 0: the parameters contradict; the ones before stay in force";

param rw float lower_um = 0.0 "Window of the command";
param rw float upper_um = 60.0 "Window of the command";
param rw float start_um = 0.0 "Where the actuator stands when the module is loaded";
param rw float slew_um_per_s = 20000.0 "Greatest slope of the command";
param rw float lead_s = 0.0 "Delay of the actuator, T1 + T2";
param rw float phase_turns = 0.0 "Angle of the table at the index pulse";
param rw float fade_s = 0.3 "From nothing to the whole command";
param rw float ramp_s = 0.2 "From an end of the window to mid-stroke after a fault";
param rw float min_rps = 1.0 "Slowest speed, turns per second";
param rw float max_rps = 100.0 "Fastest speed, turns per second";
param rw float speed_change = 0.1 "Part by which the speed may leave that of the start";
param rw float index_turns = 1.5 "Turns without index pulse: lost";
param rw float wrap_turns = 0.0 "Turns after which the position begins anew in the midst of a turn, as 4294967.296 of an int32 at 1000 counts; 0: never";
param rw float position_tol_turns = 0.1 "By how much position may leave speed and index";
param rw bit recover "Run again by itself after good_turns; otherwise enable must go off and on";
param rw s32 good_turns = 1 "Turns in order before a run";
param rw float feed_um = 50.0 "Feed per tooth; for learning";
param rw float exponent = 0.3 "m of the force law; for learning";
param rw float least_force = 1.0 "Below: no cut, N; for learning";
param rw float tool_change = 0.1 "Part of the mean force by which a flute changes that is a change of the tool; 0: none is looked for";

option extra_setup yes;
option data TrochoidHal;
include "shim.h";
variable int armed = 0;

function _ fp;
;;

static char *table = "";
RTAPI_MP_STRING(table, "CSV file with angle_deg and command_um");

static char *model = "";
RTAPI_MP_STRING(model, "CSV file estimator.csv, for learning with any number of flutes");

EXTRA_SETUP() {
  const char *wrong;
  (void)prefix;
  (void)extra_arg;
  if (model != NULL && model[0] != 0) {
    wrong = trochoid_hal_read_model(&data, model);
    if (wrong != NULL) {
      rtapi_print_msg(RTAPI_MSG_ERR, "trochoid_correct: %s %s\n", model, wrong);
      return -EINVAL;
    }
  }
  if (table == NULL || table[0] == 0) {
    rtapi_print_msg(RTAPI_MSG_WARN, "trochoid_correct: no table=, so only mid-stroke is commanded\n");
    return 0;
  }
  wrong = trochoid_hal_read_table(&data, table);
  if (wrong != NULL) {
    rtapi_print_msg(RTAPI_MSG_ERR, "trochoid_correct: %s %s\n", table, wrong);
    return -EINVAL;
  }
  return 0;
}

FUNCTION(_) {
  TrochoidHalSettings s;
  TrochoidHalIn i;
  TrochoidHalOut o;
  memset(&s, 0, sizeof s); /* it is compared byte by byte */
  s.set_lower_um = lower_um;
  s.set_upper_um = upper_um;
  s.set_start_um = start_um;
  s.set_slew_um_per_s = slew_um_per_s;
  s.set_lead_s = lead_s;
  s.set_phase_turns = phase_turns;
  s.set_period_s = fperiod;
  s.set_fade_s = fade_s;
  s.set_ramp_s = ramp_s;
  s.set_min_rps = min_rps;
  s.set_max_rps = max_rps;
  s.set_speed_change = speed_change;
  s.set_index_turns = index_turns;
  s.set_position_tol_turns = position_tol_turns;
  s.set_wrap_turns = wrap_turns;
  s.set_recover = recover;
  s.set_good_turns = good_turns;
  s.set_feed_um = feed_um;
  s.set_exponent = exponent;
  s.set_least_force = least_force;
  s.set_tool_change = tool_change;

  i.in_position = position;
  i.in_speed = speed;
  i.in_gain = gain;
  i.in_force = force;
  i.in_dt = fperiod;
  i.in_index = armed && !index_enable;
  i.in_enable = enable;
  i.in_inhibit = inhibit;
  i.in_learn = learn;
  trochoid_hal_step(&data, &s, &i, &o);
  index_enable = 1;
  armed = 1;

  command_um = o.out_command_um;
  angle = o.out_angle;
  fade = o.out_fade;
  gain_now = o.out_gain;
  speed_filtered = o.out_speed;
  difference = o.out_difference;
  tool_events = o.out_tool_events;
  tooth = o.out_tooth;
  tooth_change_um = o.out_tooth_change_um;
  state = o.out_state;
  problem = o.out_problem;
  fault = o.out_fault;
  limited = o.out_limited;
  turns = o.out_turns;
  refused = o.out_refused;
}
