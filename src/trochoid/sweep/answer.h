#pragma once

#include <trochoid/base/command.h>
#include <trochoid/inputs/case.h>
#include <trochoid/results/answer.h>

namespace trochoid::sweep {

/// @brief The answer of any command, without files and without progress.
/// @throws base::InputError when a measurement cannot be read
results::Answer answer(base::Command command, const inputs::Case& given);

}  // namespace trochoid::sweep
