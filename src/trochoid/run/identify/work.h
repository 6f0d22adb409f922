#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/run/shared/work.h>

#include <vector>

namespace trochoid::run {

/// @brief What `identify` is going to take: its records are known by their size only.
std::vector<Work> identify_work(const inputs::Case& given);

/// @brief What `plan` of forces is going to take.
std::vector<Work> plan_work(const inputs::Case& given);
}  // namespace trochoid::run
