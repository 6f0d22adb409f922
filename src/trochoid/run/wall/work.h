#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/run/shared/work.h>

#include <vector>

namespace trochoid::run {

/// @brief What `surface` is going to take.
std::vector<Work> surface_work(const inputs::Case& given);

/// @brief What `calibrate` is going to take: its readings are known by their size only.
std::vector<Work> calibrate_work(const inputs::Case& given);
}  // namespace trochoid::run
