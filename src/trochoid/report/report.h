#pragma once

#include <trochoid/results/answer.h>

#include <string>

namespace trochoid::report {

/// @brief One self-contained HTML page of an answer; it requests nothing from anywhere.
/// @param summary  text of summary.json, shown as it stands
std::string html(const results::Answer& answer, const std::string& summary);

}  // namespace trochoid::report
