#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/correct.h>
#include <trochoid/run/shared/progress.h>

namespace trochoid::run {

/// @brief The motion of the table that cancels runout, its command, and what the cut is
/// like before and after.
/// @param controller  simulate the real-time controller as well
/// @throws base::InputError when a measurement cannot be read
results::CorrectResult correct(const inputs::Case& given, bool controller,
                               const Progress& progress);

}  // namespace trochoid::run
