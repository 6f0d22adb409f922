#pragma once

#include <trochoid/base/answer.h>

/// Answers of the commands about vibration, as the program gives them for the examples.
namespace sample {

/// Both from examples/tap_test.
trochoid::base::Answer modes();
trochoid::base::Answer actuator();

/// examples/runout_table_8mm with its sine.
trochoid::base::Answer motion();

/// examples/runout_correction, with the controller in the loop.
trochoid::base::Answer correction();

/// examples/stability_922Hz cut in time: it chatters.
trochoid::base::Answer chatter();

}  // namespace sample
