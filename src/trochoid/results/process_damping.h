#pragma once

#include <trochoid/force/process_damping.h>
#include <trochoid/results/value.h>

#include <string>

namespace trochoid::results {

/// `process_damping` of an answer: its numbers in the units of files.
Object process_damping_value(const force::ProcessDamping& damping);

/// "process damping of a wear land of 80 um"
std::string process_damping_text(const force::ProcessDamping& damping);

}  // namespace trochoid::results
