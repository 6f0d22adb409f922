#pragma once

#include <trochoid/identification/identify.h>
#include <trochoid/inputs/case.h>

#include <span>
#include <string>

namespace trochoid::run {

/// @brief What another number of teeth, or milling the other way round, would explain of
/// the records so much better that the case is likely to be wrong: a sentence, or nothing.
///
/// Numbers of teeth are compared without runout, directions with radial offsets of up to
/// four teeth.
/// @param runs  force on the tool
std::string better_cut(const inputs::Case& given,
                       std::span<const identification::Run> runs);

}  // namespace trochoid::run
