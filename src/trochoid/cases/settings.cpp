#include <trochoid/cases/settings.h>

#include <trochoid/base/error.h>
#include <trochoid/cases/findings.h>

#include <fmt/core.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace trochoid::cases {

namespace {

void place_all(Node& node, const Location& where) {
  node.where = where;
  if (auto* list = std::get_if<Array>(&node.value)) {
    for (Node& entry : *list) {
      place_all(entry, where);
    }
  } else if (auto* members = std::get_if<Members>(&node.value)) {
    for (Member& member : *members) {
      member.where = where;
      place_all(member.node, where);
    }
  }
}

/// What is no TOML is a text: `up` stands for "up".
Node value_of(const std::string& text) {
  constexpr std::string_view before = "value = ";
  const bool one_line = std::ranges::none_of(
      text, [](char c) { return c == '\n' || c == '\r' || c == '#'; });
  if (one_line && !text.empty()) {
    try {
      const Node read = parse_text(std::string(before) + text, "--set");
      if (const Node* value = find(read, "value")) {
        return *value;
      }
    } catch (const base::InputError&) {  // then it is one
    }
  }
  return {.value = text, .where = {}};
}

}  // namespace

Node with_settings(Node root, std::span<const std::string> settings,
                   const std::filesystem::path& file) {
  const Location where{file.string(), beside_the_file};
  std::vector<std::string> problems;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      problems.push_back(
          fmt::format("--set {}: must be KEY=VALUE, such as cut.spindle_rpm=900",
                      shown_key(setting)));
      continue;
    }
    Node value = value_of(setting.substr(equals + 1));
    place_all(value, where);
    try {
      set_key(root, {setting.substr(0, equals), where, ""}, value);
    } catch (const base::InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) {
    throw base::InputError(std::move(problems));
  }
  return root;
}

}  // namespace trochoid::cases
