#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace trochoid::base {

/// @brief The whole content of a file; nothing when the disk does not give it.
std::optional<std::string> read_text(const std::filesystem::path& file);

}  // namespace trochoid::base
