#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/surface/find_runout.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace trochoid::run {

/// @brief `result` of summary.json, without the runout.
nlohmann::ordered_json calibration_json(const inputs::Case& given,
                                        const surface::ModelFits& calibration);

/// @brief Runout, and the fit of all readings together, into `result`.
void add_runout(const surface::RunoutFit& runout, const inputs::Case& given,
                nlohmann::ordered_json& result);

/// @brief The answers side by side, for a person.
std::string calibration_table(const inputs::Case& given,
                              const surface::ModelFits& calibration,
                              const surface::RunoutFit& runout);

/// @brief material.toml: what another case includes to use what was found.
std::string calibrated_material(const inputs::Case& given,
                                const surface::ModelFits& calibration,
                                const surface::RunoutFit& runout);

/// @brief Why an answer was refused, and what is known all the same.
std::string refusal(const inputs::Case& given, const surface::CoefficientFit& answer);

/// Runout that stands out of its own uncertainty.
bool runout_is_seen(const surface::RunoutFit& runout);

/// Whether the coefficients are those that were fitted together with the runout: the
/// mean of a real surface is not free of it.
bool runout_counts(const inputs::Case& given, const surface::RunoutFit& runout);

}  // namespace trochoid::run
