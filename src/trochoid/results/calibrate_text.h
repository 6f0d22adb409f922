#pragma once

#include <trochoid/results/calibrate.h>
#include <trochoid/results/descriptions.h>

#include <string>

namespace trochoid::results {

/// @brief The fits side by side, for a person; `*` marks the one that counts.
std::string calibration_table(const CalibrateResult& result);

/// @brief material.toml: what another case includes to use what was found.
std::string calibrated_material(const CalibrateResult& result);

/// @brief The answer of roughness traces.
Answer answer_of_finish(const CalibrateResult& result);

/// @brief Keys and columns that only that answer has.
void add_finish_description(Description& all);

}  // namespace trochoid::results
