#pragma once

#include <functional>
#include <string>

namespace trochoid::run {

/// @brief Told what a long command is doing; may be empty.
using Progress = std::function<void(const std::string& what)>;

}  // namespace trochoid::run
