#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/identify.h>
#include <trochoid/run/shared/progress.h>

namespace trochoid::run {

/// @brief Coefficients, runout and phase from the measurements of a case.
/// @throws base::InputError when a measurement cannot be used
results::IdentifyResult identify(const inputs::Case& given, const Progress& progress);

}  // namespace trochoid::run
