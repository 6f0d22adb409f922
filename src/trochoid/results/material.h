#pragma once

#include <trochoid/force/law.h>
#include <trochoid/identification/identify.h>

#include <string>
#include <string_view>

namespace trochoid::results {

/// @brief material.toml: what another case includes to use what was found.
/// @param command  that found it
std::string material_toml(const identification::Fit& fit, force::EdgeLength edge_length,
                          std::string_view command = "identify");

/// @brief The same of one group of records.
std::string material_toml(const identification::Fit& fit,
                          const identification::Group& group,
                          force::EdgeLength edge_length,
                          std::string_view command = "identify");

/// @brief The lines of [force] below the coefficients: exponents, and what counts as the
/// length of an edge, where the law has them.
std::string law_shape_toml(const force::Law& law, force::EdgeLength edge_length);

}  // namespace trochoid::results
