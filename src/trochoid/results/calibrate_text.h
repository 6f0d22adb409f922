#pragma once

#include <trochoid/results/calibrate.h>

#include <string>

namespace trochoid::results {

/// @brief The fits side by side, for a person; `*` marks the one that counts.
std::string calibration_table(const CalibrateResult& result);

/// @brief material.toml: what another case includes to use what was found.
std::string calibrated_material(const CalibrateResult& result);

}  // namespace trochoid::results
