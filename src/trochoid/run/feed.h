#pragma once

#include <trochoid/cases/case.h>
#include <trochoid/engagement/feed.h>
#include <trochoid/results/program.h>
#include <trochoid/run/progress.h>

#include <optional>

namespace trochoid::run {

/// @brief The limits of a case, the power of its spindle too.
engagement::Limits limits_of(const cases::ProgramTables& nc);

/// @brief The program of `[feed]` write has a name that no file of the answer has.
/// @throws base::InputError else
void check_name_of_program(const cases::Case& given);

/// @brief The feeds of `[feed]`, the program with them, and its forces and time.
/// @param forces  of the program as it is
/// @return nothing where the time was up
std::optional<results::NewFeeds> new_feeds(const engagement::Job& job,
                                           const cases::Case& given,
                                           const results::ProgramForces& forces,
                                           const Progress& progress);

}  // namespace trochoid::run
