#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/cases/case.h>
#include <trochoid/engagement/feed.h>
#include <trochoid/results/program.h>
#include <trochoid/run/progress.h>

namespace trochoid::run {

/// @brief The limits of a case, those of the spindle's power too.
engagement::Limits limits_of(const cases::ProgramTables& nc);

/// @brief The feeds of `[feed]`, the program with them, and what it comes to when it is run.
/// @param forces  of the program as it is
results::NewFeeds new_feeds(const engagement::Job& job, const cases::Case& given,
                            const results::ProgramForces& forces,
                            const Progress& progress);

}  // namespace trochoid::run
