#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/shared/progress.h>
#include <trochoid/run/shared/records.h>

#include <vector>

namespace trochoid::run {

/// @brief Why a case may explain its records badly, and what to try: warnings with the
/// code `likely_cause`.
///
/// With given axes of the dynamometer the other readings of the channels are tried.
/// @param M  matrix of the dynamometer that was used
std::vector<base::Warning> likely_causes(const inputs::Case& given,
                                         const std::vector<MeasuredRun>& runs,
                                         const signal::Matrix3& M,
                                         const Progress& progress);

/// @brief Whether another reading of the channels than the given one fits clearly better,
/// although the given one may be used: a warning with the code `axes_fit_better`, or none.
/// @param M  matrix of the dynamometer that was used
std::vector<base::Warning> look_at_channels(const inputs::Case& given,
                                            const std::vector<MeasuredRun>& runs,
                                            const signal::Matrix3& M,
                                            const Progress& progress);

/// @brief Whether another number of teeth, or milling the other way round, fits clearly
/// better: a warning with the code `cut_fits_better`, or none.
std::vector<base::Warning> look_at_cut(const inputs::Case& given,
                                       const std::vector<MeasuredRun>& runs,
                                       const signal::Matrix3& M);

}  // namespace trochoid::run
