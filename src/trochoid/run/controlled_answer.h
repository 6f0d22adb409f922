#pragma once

#include <trochoid/results/answer.h>
#include <trochoid/run/controlled.h>

namespace trochoid::run {

/// @brief What the controller did, added to the answer of correct: `controller` of the
/// result, controller.csv, and a line of the short table.
void add_controlled(const ControlledCut& run, results::Answer& answer);

}  // namespace trochoid::run
