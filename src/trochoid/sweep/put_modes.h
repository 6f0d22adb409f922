#pragma once

#include <trochoid/inputs/document.h>
#include <trochoid/results/joint.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace trochoid::sweep {

/// @brief A number of a table of a case, as it stands there; none: another value, or none.
std::optional<double> number_in(const inputs::Node& table, std::string_view key);

/// @brief Find the modes of a joint answer among those of a case: its names then are keys
/// of that case, whose modes have mass, frequency and damping ratio.
/// @param where   of what asks for them
/// @param file    that the modes are of, for messages
/// @param report  called with each problem
void put_modes(inputs::Node& root, const inputs::Location& where, results::Joint& joint,
               const std::string& file,
               const std::function<void(const std::string&)>& report);

}  // namespace trochoid::sweep
