#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/run/shared/work.h>

#include <vector>

namespace trochoid::run {

/// @brief What `simulate` is going to take.
std::vector<Work> simulate_work(const inputs::Case& given);

}  // namespace trochoid::run
