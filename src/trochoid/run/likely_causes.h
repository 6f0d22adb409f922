#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/measured_run.h>
#include <trochoid/run/progress.h>

#include <vector>

namespace trochoid::run {

/// @brief Why a case may explain its records badly, and what to try: warnings with the
/// code `likely_cause`.
///
/// With given axes of the dynamometer the other readings of the channels are tried.
/// @param M  matrix of the dynamometer that was used
std::vector<base::Warning> likely_causes(const inputs::Case& given,
                                         const std::vector<MeasuredRun>& runs,
                                         const Matrix3& M, const Progress& progress);

}  // namespace trochoid::run
