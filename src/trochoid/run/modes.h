#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/modes.h>

namespace trochoid::run {

/// @brief Modal parameters from the frequency response of a case.
/// @param given  with [frf]
/// @throws base::InputError when the file cannot be read
results::ModesResult modes(const inputs::Case& given);

}  // namespace trochoid::run
