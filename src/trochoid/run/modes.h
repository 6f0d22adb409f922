#pragma once

#include <trochoid/base/answer.h>
#include <trochoid/inputs/case.h>
#include <trochoid/inputs/frf_file.h>

namespace trochoid::run {

/// @brief Which response [frf] means.
inputs::FrfSource frf_source(const inputs::FrfTables& frf);

/// @brief Modal parameters from the frequency response of a case.
/// @param given  with [frf]
/// @throws base::InputError when the file cannot be read
base::Answer modes(const inputs::Case& given);

}  // namespace trochoid::run
