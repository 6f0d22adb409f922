#pragma once

#include <trochoid/cases/document.h>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

/// Keys of a case that do not stand in its file.
namespace trochoid::cases {

/// Which key, and who asks, for messages.
struct KeyToSet {
  std::string key;         ///< its path: `cut.spindle_rpm`, `mode[1].frequency_Hz`
  Location where;          ///< of the value
  std::string_view table;  ///< before the key in messages
};

/// @brief Set a key of a case; tables on the way to it are made where they are missing.
/// @throws base::InputError where the path leads through something that is no table, or
/// to an entry that a list does not have
void set_key(Node& root, const KeyToSet& key, const Node& value);

/// @brief A case with keys as `--set` has them, one after the other.
/// @param settings  `KEY=VALUE`: the value as in a TOML file, or a text without quotes
/// @param file      of the case: names of files count from its folder, as all in it do
/// @throws base::InputError with every setting that is none, or leads nowhere
Node with_settings(Node root, std::span<const std::string> settings,
                   const std::filesystem::path& file);

}  // namespace trochoid::cases
