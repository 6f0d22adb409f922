#pragma once

#include <trochoid/program/complaints.h>
#include <trochoid/program/move.h>

#include <optional>
#include <string_view>

namespace trochoid::program {

/// @brief Whether a name asks for what is not done: IF, CYCLE81, TRAORI, R1=.
/// @param assigned  an = follows
std::optional<Fault> refused_name(std::string_view name, bool assigned,
                                  Dialect dialect) noexcept;

/// @brief Whether a name of Sinumerik has no effect on the load, whatever it says.
bool without_effect(std::string_view name) noexcept;

/// @brief TRANS, ROT, SCALE, MIRROR and their additive forms.
bool changes_frame(std::string_view name) noexcept;

}  // namespace trochoid::program
