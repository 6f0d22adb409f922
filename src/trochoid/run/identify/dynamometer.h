#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/identification/identify.h>
#include <trochoid/inputs/case.h>
#include <trochoid/signal/axes.h>

#include <span>
#include <vector>

namespace trochoid::run {

/// @brief What the dynamometer makes of the force of each run, from the response that the
/// case names; empty: it names none.
/// @param channels  channels = matrix times force on the tool
/// @throws base::InputError where its file is wrong
std::vector<identification::Response> measured_responses(
    const inputs::Case& given, std::span<const identification::Run> runs,
    const signal::Matrix3& channels, std::vector<base::Warning>& warnings);

}  // namespace trochoid::run
