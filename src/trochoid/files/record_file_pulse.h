#pragma once

#include <trochoid/files/csv.h>
#include <trochoid/signal/record.h>

#include <span>
#include <string>

namespace trochoid::files {

/// @brief Give a record that has its times the spindle angle of a channel with one pulse a
/// turn, and a note of what was found.
/// @param column  its name
/// @param values  of the channel, shape (n)
void take_pulses(signal::Record& record, const std::string& column,
                 std::span<const double> values, Problems& problems);

}  // namespace trochoid::files
