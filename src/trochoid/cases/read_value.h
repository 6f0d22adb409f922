#pragma once

#include <trochoid/cases/document.h>
#include <trochoid/cases/findings.h>
#include <trochoid/cases/schema.h>

#include <string>

namespace trochoid::cases {

/// @brief Put the value of a node into a field, in SI, or report why it does not fit.
/// @param path  of the key, for messages
void read_value(const Node& node, const std::string& path, const Key& key,
                const Field& field, Findings& findings);

/// @brief A number of the file, whole or not; nothing when the node is no number.
std::optional<double> number_in(const Node& node);

/// @brief The value of a key as a message shows it, a number with its unit.
std::string shown_value(std::string_view key, const Node& node);

}  // namespace trochoid::cases
