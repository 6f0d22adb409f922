#pragma once

#include <trochoid/identification/problem.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

/// Runs that share coefficients.
namespace trochoid::identification {

/// @brief Take down which runs share coefficients (I-19).
void set_groups(std::span<const Run> runs, Problem& problem);

/// Where the coefficients of a run begin among those of all groups.
std::size_t first_column(const Problem& problem, std::size_t r) noexcept;

/// A group for messages: its name in quotes, or that it has none.
std::string label_of_group(const std::string& name);

/// @brief What to judge one by one: the groups, or the coefficients of a fit without.
std::vector<Group> groups_of(const Fit& fit);

/// ` of "..."` where a fit has several groups, else nothing.
std::string of_group(const Fit& fit, const Group& group);

}  // namespace trochoid::identification
