#pragma once

#include <trochoid/force/process_damping.h>
#include <trochoid/results/fields.h>

#include <string>

namespace trochoid::results {

/// `process_damping` of an answer: its numbers in the units of files.
const Fields<force::ProcessDamping>& process_damping_fields();

/// "process damping of a wear land of 80 um"
std::string process_damping_text(const force::ProcessDamping& damping);

}  // namespace trochoid::results
