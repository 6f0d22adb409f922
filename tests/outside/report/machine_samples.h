#pragma once

#include <trochoid/results/answer.h>

/// Answers of the commands about vibration, and of plan, as the program gives them for the
/// examples.
namespace sample {

/// Both from examples/tap_test.
trochoid::results::Answer modes();
trochoid::results::Answer actuator();

/// The four responses of examples/several_responses together.
trochoid::results::Answer shared_modes();

/// examples/runout_table_8mm with its sine.
trochoid::results::Answer motion();

/// examples/runout_correction, with the controller in the loop.
trochoid::results::Answer correction();

/// examples/stability_922Hz cut in time: it chatters within bounds.
trochoid::results::Answer chatter();

/// examples/measured_frf over a few speeds and depths: three limits side by side.
trochoid::results::Answer tool_point();

/// examples/plan_next_cut.
trochoid::results::Answer plan();

}  // namespace sample
