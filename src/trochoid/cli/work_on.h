#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/cli/commands.h>
#include <trochoid/inputs/case.h>
#include <trochoid/results/answer.h>
#include <trochoid/run/shared/progress.h>

#include <functional>

namespace trochoid::cli {

/// From a case to its answer; what is told and what is asked meanwhile.
using CaseWork =
    std::function<results::Answer(const run::Progress& progress, base::Stop stop)>;

/// @brief Do the work of a command, tell how far it is, and deliver its answer.
///
/// When the time is up, stability and identify are asked to end with what they have found;
/// else, or where they do not soon, the answer is that there is none.
/// @param name  of the command
/// @return exit code
int work_on(const inputs::Case& given, const Options& options, base::Command name,
            const CaseWork& work);

}  // namespace trochoid::cli
