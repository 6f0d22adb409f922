#pragma once

#include <trochoid/identification/identify.h>

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

namespace trochoid::run {

/// @brief A list in measurement order; of a single measurement, its entry alone.
nlohmann::ordered_json alone_or_list(const nlohmann::ordered_json& list);

/// @brief One entry of `fits` of the summary.
nlohmann::ordered_json fit_json(const identification::Fit& fit);

}  // namespace trochoid::run
