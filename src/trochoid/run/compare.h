#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/answer.h>

#include <nlohmann/json_fwd.hpp>

namespace trochoid::run {

/// @brief Set the computed forces of a case beside its measurements.
///
/// Only the phase of each record is sought; coefficients and runout stay as given. Adds
/// fitted.csv, residual.csv, `comparison` and a line of the short table.
/// @throws base::InputError when a measurement cannot be read
void compare(const inputs::Case& given, results::Answer& answer,
             nlohmann::ordered_json& result);

}  // namespace trochoid::run
