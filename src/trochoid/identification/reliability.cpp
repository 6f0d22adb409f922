#include <trochoid/identification/reliability.h>

#include <trochoid/base/rounded.h>
#include <trochoid/identification/groups.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {

namespace {

constexpr double too_much_unexplained = 0.5;

/// What speaks against the coefficients of one group.
/// @param whose  ends the name of a coefficient
void add_reasons(const Group& group, const std::string& whose,
                 std::vector<std::string>& reasons) {
  const auto names = force::coefficient_quantities(group.law);
  const auto& K_t = group.coefficients[0];
  if (K_t && K_t->low <= 0 && K_t->high >= 0) {
    reasons.push_back(fmt::format("{}{} may be zero", names[0].key, whose));
  }
  for (std::size_t q = 0; q < 2; ++q) {  // tangential and radial, cutting
    const auto& K = group.coefficients[q];
    if (K && K->high < 0) {
      reasons.push_back(
          fmt::format("{}{} is negative, which no cut does", names[q].key, whose));
    }
  }
}

}  // namespace

double correlation_factor(double r) noexcept {
  const double counted = std::clamp(r, 0.0, 0.999);
  return std::sqrt((1.0 + counted) / (1.0 - counted));
}

std::vector<std::string> reasons_against(const Fit& fit) {
  std::vector<std::string> reasons;
  const bool banded = fit.options.band_harmonics > 0;
  const bool noise = !banded && fit.residual_correlation <= noise_correlation;
  const double part = fit.unexplained.in_band;
  if (part > too_much_unexplained && !noise) {
    reasons.push_back(
        fmt::format("{} of the force (rms{}) is not explained", base::percent(part),
                    banded ? ", within the harmonics that were fitted" : ""));
  }
  for (const Group& group : groups_of(fit)) {
    add_reasons(group, of_group(fit, group), reasons);
  }
  return reasons;
}

std::string do_not_use(const std::vector<std::string>& reasons) {
  return fmt::format("Do not use these numbers: {}.", fmt::join(reasons, "; "));
}

}  // namespace trochoid::identification
