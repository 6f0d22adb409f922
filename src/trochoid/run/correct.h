#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/cases/case.h>
#include <trochoid/correction/correct.h>

#include <vector>

/// Parts of `correct`.
namespace trochoid::run {

/// @brief A case of `correct` as the room correction takes it, its [[measurement]] read.
/// @param controller     that of [controller] is to be simulated
/// @param[out] warnings  what was found out about the record
/// @throws base::InputError when a measurement cannot be read
correction::CorrectionProblem correction_problem(const cases::Case& given,
                                                 bool controller,
                                                 std::vector<base::Warning>& warnings);

/// @brief About the runout that was found in a record.
void add_setting_warnings(const correction::Setting& setting,
                          std::vector<base::Warning>& warnings);

/// @brief About motion, command and controller.
/// @param c  that is `ok`
void add_correction_warnings(const correction::Correction& c,
                             std::vector<base::Warning>& warnings);

}  // namespace trochoid::run
