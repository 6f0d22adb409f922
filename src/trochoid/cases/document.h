#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace trochoid::cases {

/// Where something stands in a file; line and column count from 1.
///
/// Line 0: it stands in none, a program gave it; line -1: it was set beside the file. The
/// folder of `file` is still the one that names of files count from.
struct Location {
  std::string file;
  int line = 1;
  int column = 1;
};

/// Of what was set beside the file (settings.h).
inline constexpr int beside_the_file = -1;

/// `file:line:col`, or `case` for what stands in no file, `--set` for what is set beside it.
std::string to_string(const Location& where);

struct Member;
struct Node;
using Array = std::vector<Node>;
using Members = std::vector<Member>;  ///< of a table, in the order of the file

/// A date or a time, which no key takes.
///
/// Its copy may fail, and so the variant may be valueless: one that never is, g++ 12
/// destroys wrongly where there is no memory for its copy.
struct DateOrTime {
  std::string text;
};

/// A value of a TOML file.
struct Node {
  std::variant<DateOrTime, bool, std::int64_t, double, std::string, Array, Members>
      value;
  Location where;
  bool inherited = false;  ///< from an included file, or from the table it overrides
};

struct Member {
  std::string key;
  Location where;
  Node node;
};

/// @return nullptr when the table has no such key
const Node* find(const Node& table, std::string_view key);

/// @brief A value as one would write it in TOML, cut short when it is long.
std::string to_string(const Node& node);

/// @brief Parse one TOML file, without looking at `include`.
/// @throws base::InputError when it cannot be read, or is not TOML
Node parse_file(const std::filesystem::path& file);

/// @brief The same of a text.
/// @param name  of the file that it stands for, in messages
Node parse_text(const std::string& text, const std::string& name);

/// @brief Parse a TOML file and merge what it includes; the including file wins.
///
/// Tables merge key by key; anything else, lists of tables too, is replaced whole. Files
/// included side by side join their lists of tables.
/// @throws base::InputError also for a cycle or an `include` that is no text or list of
///         texts
Node load_document(const std::filesystem::path& file);

/// @brief The same of a table that is read already; without `include` it is the answer.
/// @param file  where it stands: names of files in `include` count from its folder
/// @throws base::InputError as load_document
Node with_includes(Node root, const std::filesystem::path& file);

/// @brief `over` upon `base`: keys of `over` win, those of `base` become inherited.
Node merged(Node base, const Node& over);

}  // namespace trochoid::cases
