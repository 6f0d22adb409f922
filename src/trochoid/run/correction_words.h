#pragma once

#include <trochoid/correction/shapes.h>
#include <trochoid/results/answer.h>
#include <trochoid/run/correction_answer.h>

#include <string>

namespace trochoid::run {

/// @brief What a person should know about a correction.
void add_correction_warnings(const CorrectionFindings& f,
                             const correction::AxisLimits& axes,
                             results::Answer& answer);

/// @brief The short table of correct.
std::string correction_table(const CorrectionFindings& f);

}  // namespace trochoid::run
