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

/// Whether a case states any mode.
bool has_modes(const inputs::Node& root);

/// Where modes come from.
struct ModesFile {
  inputs::Location where;  ///< of what asks for them
  std::string file;        ///< that they are of, for messages
  bool takes_all = false;  ///< the case had no modes of its own: these are added to it
};

/// @brief Find the modes of a joint answer among those of a case: its names then are keys
/// of that case, whose modes have mass, frequency and damping ratio.
/// @param report  called with each problem
void put_modes(inputs::Node& root, results::Joint& joint, const ModesFile& from,
               const std::function<void(const std::string&)>& report);

}  // namespace trochoid::sweep
