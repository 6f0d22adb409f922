#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/correction/correct.h>

#include <vector>

/// What an engineer should know about a correction, in sentences.
namespace trochoid::run {

/// @brief About the runout that was found in a record.
void add_setting_warnings(const correction::Setting& setting,
                          std::vector<base::Warning>& warnings);

/// @brief About motion, command and controller.
/// @param c  that is `ok`
void add_correction_warnings(const correction::Correction& c,
                             std::vector<base::Warning>& warnings);

}  // namespace trochoid::run
