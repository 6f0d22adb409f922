#pragma once

#include <span>
#include <string>
#include <vector>

namespace trochoid::results {

/// @brief Lines of cells, each column as wide as its widest cell, the first to the left and
/// all others to the right.
/// @param rows  at least one, all of the same length
std::string aligned(std::span<const std::vector<std::string>> rows);

}  // namespace trochoid::results
