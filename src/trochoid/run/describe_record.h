#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/signal/record.h>

#include <string>

namespace trochoid::run {

/// @brief What a record holds, for a person, in a few lines: samples, duration, rate,
/// revolutions, the columns used and their ranges.
/// @param cut  of the record, for its stated spindle speed
std::string describe_record(const signal::Record& record, const geometry::Cut& cut);

/// @brief Names of the tables of a case that no command of this version uses, as they
/// stand in the file.
std::vector<std::string> unused_tables(const inputs::Case& given);

}  // namespace trochoid::run
