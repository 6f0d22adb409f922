#pragma once

#include <trochoid/identification/identify.h>

#include <string>

namespace trochoid::results {

/// @brief material.toml: what another case includes to use what was found.
std::string material_toml(const identification::Fit& fit,
                          force::EdgeLength edge_length);

}  // namespace trochoid::results
