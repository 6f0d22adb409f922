#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/run/shared/work.h>

#include <vector>

namespace trochoid::run {

/// @brief What `stability` is going to take.
std::vector<Work> stability_work(const inputs::Case& given);

/// @brief What `dynamics` is going to take: turns without chatter, which asks for more.
///
/// Nothing where the steps are more than dynamics computes: it says that itself.
std::vector<Work> dynamics_work(const inputs::Case& given);

/// @brief What `modes` and `actuator` are going to take, by the size of their files.
std::vector<Work> measured_work(const inputs::MachineTables& machine);
}  // namespace trochoid::run
