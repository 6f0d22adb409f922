#pragma once

#include <trochoid/cases/case.h>
#include <trochoid/cases/document.h>
#include <trochoid/cli/commands.h>

namespace trochoid::cli {

/// @brief The case file with what it includes, or the standard input, and what is set
/// beside it.
/// @throws base::InputError
cases::Node document_of(const Options& options);

/// @brief The case of a command, once nothing stands against its work: what is wrong
/// with the case, with the place of its results or with the amount of work is told
/// before, and not after.
/// @throws base::InputError with every problem of them
cases::Case given_case(const Options& options, base::Command command);

/// @brief The same for a bare data file, which has no tables but these.
cases::Case bare_case(const Options& options, const cases::MachineTables& machine,
                      base::Command command);

}  // namespace trochoid::cli
