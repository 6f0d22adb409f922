#include <trochoid/identification/fit.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::identification {

bool unidentifiable(const Fit& fit, const std::string& name) {
  return std::ranges::any_of(fit.unidentifiable,
                             [&](const auto& entry) { return entry.first == name; });
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
