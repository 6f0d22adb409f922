#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/signal/record.h>

#include <string>

namespace trochoid::run {

/// @brief What a record holds, for a person, in a few lines: samples, duration, rate,
/// revolutions, the columns used and their ranges, and which part of it cuts.
std::string describe_record(const signal::Record& record,
                            const inputs::Measurement& measurement);

}  // namespace trochoid::run
