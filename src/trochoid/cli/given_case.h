#pragma once

#include <trochoid/cli/commands.h>
#include <trochoid/inputs/case.h>
#include <trochoid/inputs/document.h>

namespace trochoid::cli {

/// @brief The case file with what it includes, or the standard input, and what is set
/// beside it.
/// @throws base::InputError
inputs::Node document_of(const Options& options);

/// @brief The case of a command, once nothing stands against its work: what is wrong
/// with the case, with the place of its results or with the amount of work is told
/// before, and not after.
/// @throws base::InputError with every problem of them
inputs::Case given_case(const Options& options, base::Command command);

/// @brief The same for a bare data file, which has no tables but these.
inputs::Case bare_case(const Options& options, const inputs::MachineTables& machine,
                       base::Command command);

}  // namespace trochoid::cli
