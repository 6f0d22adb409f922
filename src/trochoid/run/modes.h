#pragma once

#include <trochoid/cases/case.h>
#include <trochoid/results/modes.h>

namespace trochoid::run {

/// @brief Modal parameters from the frequency response of a case.
/// @param given  with [frf]
/// @throws base::InputError when the file cannot be read
results::ModesResult modes(const cases::Case& given);

}  // namespace trochoid::run
