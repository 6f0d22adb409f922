#pragma once

#include <trochoid/geometry/cut.h>
#include <trochoid/signal/record.h>

#include <string>

namespace trochoid::run {

/// @brief What a record holds, for a person, in a few lines: samples, duration, rate,
/// revolutions, the columns used and their ranges.
/// @param cut  of the record, for its stated spindle speed
std::string describe_record(const signal::Record& record, const geometry::Cut& cut);

}  // namespace trochoid::run
