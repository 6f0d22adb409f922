#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/cases/case.h>
#include <trochoid/identification/find_axes.h>
#include <trochoid/identification/identify.h>
#include <trochoid/identification/systematic.h>
#include <trochoid/results/identify.h>
#include <trochoid/run/progress.h>
#include <trochoid/run/records.h>

#include <span>
#include <string>
#include <vector>

/// Parts of `identify`, of which `plan` uses some.
namespace trochoid::run {

/// @brief Identify from channels as they are: others than three forces, means, or with
/// stated standard deviations or a prior.
results::IdentifyResult identify_channels(const cases::Case& given,
                                          const Progress& progress);

/// @brief Whether a case leaves to the record a runout that its cutter may show beyond offsets
/// and eccentricity: a corner shows axial offsets, edges that turn far a tilt.
bool asks_for_more_runout(const cases::Case& given);

/// @brief The same fit with axial offsets or tilt, where the case leaves the runout to the
/// record, the record tells them (I-29) and they explain clearly more; else nothing.
std::optional<identification::Fit> fit_with_more_runout(
    const cases::Case& given, const results::IdentifyResult& r,
    const identification::Fit& fit);

/// @brief Whether the offsets of a record are to be found with the coefficients: no air
/// tells them, and it is long enough to tell them from the cut.
bool has_offsets_to_find(const MeasuredRun& one);

/// @brief Options of one fit as [identify] asks for them.
identification::Options fit_options(const cases::Case& given, chip::Model model);

/// @brief What is fitted to find out what the channels read.
identification::AxesProblem axes_problem(const cases::Case& given);

/// @brief What to say while that is done.
/// @param part  of it that is done, from 0 to 1
Step axes_progress(double part);

/// @brief What an engineer should know before trusting a fit.
void add_fit_warnings(const cases::Case& given,
                      std::span<const identification::Fit> fits,
                      const identification::Fit& chosen,
                      std::vector<base::Warning>& warnings);

/// @brief A dynamometer that the record says is not what the case says: warnings with the
/// codes `channel_gain` and `cross_talk`, or none.
/// @param M  matrix of the dynamometer that was used
void warn_sensor(std::span<const identification::SensorFault> faults,
                 const identification::Fit& chosen, const signal::Matrix3& M,
                 std::vector<base::Warning>& warnings);

/// @brief Why numbers that may be used are to be used with care: one phrase for each warning
/// that says so, in their order; empty: none does.
std::vector<std::string> reasons_for_care(std::span<const base::Warning> warnings);

/// @brief Why a case may explain its records badly, and what to try: warnings with the
/// code `likely_cause`.
///
/// With given axes of the dynamometer the other readings of the channels are tried.
/// @param M  matrix of the dynamometer that was used
std::vector<base::Warning> likely_causes(const cases::Case& given,
                                         const std::vector<MeasuredRun>& runs,
                                         const signal::Matrix3& M,
                                         const Progress& progress);

/// @brief Whether another reading of the channels than the given one fits clearly better,
/// although the given one may be used: a warning with the code `axes_fit_better`, or none.
/// @param M  matrix of the dynamometer that was used
std::vector<base::Warning> look_at_channels(const cases::Case& given,
                                            const std::vector<MeasuredRun>& runs,
                                            const signal::Matrix3& M,
                                            const Progress& progress);

/// @brief Whether another number of teeth, or milling the other way round, fits clearly
/// better: a warning with the code `cut_fits_better`, or none.
std::vector<base::Warning> look_at_cut(const cases::Case& given,
                                       const std::vector<MeasuredRun>& runs,
                                       const signal::Matrix3& M);

}  // namespace trochoid::run
