#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/inputs/case.h>
#include <trochoid/results/identify.h>
#include <trochoid/run/shared/progress.h>

namespace trochoid::run {

/// @brief Coefficients, runout and phase from the measurements of a case.
/// @param stop  then what adds to the fit that decides is left out, with a warning of the
///              code `time_limit`; where `left` of it is none, some 10 s of one core bound the
///              work (`work_limit`)
/// @throws base::InputError when a measurement cannot be used
results::IdentifyResult identify(const inputs::Case& given, const Progress& progress,
                                 base::Stop stop = {});

}  // namespace trochoid::run
