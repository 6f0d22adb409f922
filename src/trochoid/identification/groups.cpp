#include <trochoid/identification/groups.h>

#include <trochoid/base/index.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::identification {

void set_groups(std::span<const Run> runs, Problem& problem) {
  problem.groups.clear();
  problem.group_of.clear();
  for (const Run& run : runs) {
    const auto found = std::ranges::find(problem.groups, run.group);
    problem.group_of.push_back(
        static_cast<std::size_t>(found - problem.groups.begin()));
    if (found == problem.groups.end()) problem.groups.push_back(run.group);
  }
}

std::size_t first_column(const Problem& problem, std::size_t r) noexcept {
  return problem.group_of.empty() ? 0
                                  : base::index(problem.columns) * problem.group_of[r];
}

std::string label_of_group(const std::string& name) {
  return name.empty() ? "the records without a group" : fmt::format("\"{}\"", name);
}

std::vector<Group> groups_of(const Fit& fit) {
  if (fit.groups.size() > 1) return fit.groups;
  return {Group{"", {}, fit.law, fit.coefficients}};
}

std::string of_group(const Fit& fit, const Group& group) {
  return fit.groups.size() > 1 ? " of " + label_of_group(group.name) : "";
}

}  // namespace trochoid::identification
