#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/inputs/case.h>
#include <trochoid/surface/setting.h>

#include <vector>

namespace trochoid::run {

/// @brief What a case says of its wall, for the room surface.
surface::Setting wall_setting(const inputs::Case& given);

surface::Feedback wall_feedback(const inputs::Case& given);

/// @brief Warnings about what bends: a wall that bends by more than half its thickness,
/// and a chip that the deflection would change.
/// @param largest  error of the wall [m]
void add_bending_warnings(const inputs::Case& given, double largest,
                          std::vector<base::Warning>& warnings);

}  // namespace trochoid::run
