#pragma once

#include <filesystem>
#include <string_view>

namespace trochoid::results {

/// @brief Is this the name of a file that some command writes into its folder?
///
/// The one list of them. An old answer that holds any other file is never replaced, so
/// that nothing of the user's disappears with it.
bool is_ours(std::string_view name);

/// The same of a file in an old answer, whose summary may name one more: the program with
/// new feeds, which has the name that the case gave it.
bool is_ours_in(const std::filesystem::path& folder, std::string_view name);

/// Is this the text of a summary.json that a command of ours wrote?
bool is_our_summary(std::string_view text);

/// Does the folder hold a summary.json that a command of ours wrote?
bool holds_our_summary(const std::filesystem::path& folder);

}  // namespace trochoid::results
