#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/identification/identify.h>
#include <trochoid/inputs/case.h>

#include <span>
#include <string>
#include <vector>

namespace trochoid::run {

/// @brief What an engineer should know before trusting a fit.
void add_fit_warnings(const inputs::Case& given,
                      std::span<const identification::Fit> fits,
                      const identification::Fit& chosen,
                      std::vector<base::Warning>& warnings);

/// @brief Why numbers that may be used are to be used with care: one phrase for each warning
/// that says so, in their order; empty: none does.
std::vector<std::string> reasons_for_care(std::span<const base::Warning> warnings);

}  // namespace trochoid::run
