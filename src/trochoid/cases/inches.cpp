#include <trochoid/cases/inches.h>

#include <trochoid/base/units.h>
#include <trochoid/cases/tables.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <map>
#include <utility>
#include <variant>

namespace trochoid::cases {

namespace {

constexpr double mm_per_inch = unit::inch / unit::mm;

/// Ends of keys, the longer ones first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> ends = {
    {{"_in_per_min", "_mm_per_min"}, {"_in", "_mm"}}};

/// The key with another end; empty: it ends otherwise. A force per length is none.
std::string with_end(std::string_view key, std::string_view end,
                     std::string_view other) {
  if (!key.ends_with(end)) return {};
  key.remove_suffix(end.size());
  return key.empty() || key.ends_with("_per") ? std::string()
                                              : std::string(key) + std::string(other);
}

/// Of each key in inches: the key in millimetres, and whether its third number counts.
struct Length {
  std::string mm;
  bool counted = false;
};
using Lengths = std::map<std::string, Length, std::less<>>;

Lengths all_lengths() {
  Lengths all;
  const Visitor gather = [&all](const Key& key, const Field& field) {
    if (std::string inches = key_in_inches(key.name); !inches.empty()) {
      all[std::move(inches)] = {
          std::string(key.name),
          std::holds_alternative<std::optional<base::Steps>*>(field)};
    }
  };
  CaseTables tables;
  for (const TableEntry& entry : tables_of(tables)) {
    if (entry.count() == 0) entry.add();
    entry.describe(0, gather);
  }
  geometry::Serration serration;
  describe(gather, serration);
  PreviousClamping clamping;
  describe(gather, clamping);
  files::SurfaceFrame frame;
  describe(gather, frame);
  return all;
}

const Length* length_of(std::string_view key) {
  static const Lengths lengths = all_lengths();
  const auto found = lengths.find(key);
  return found == lengths.end() ? nullptr : &found->second;
}

/// A path in parts: before its last key, that key, and what stands behind it in brackets.
struct Path {
  std::string_view before;
  std::string_view key;
  std::string_view entry;
};

Path parts_of(std::string_view path) {
  const std::size_t first = path.rfind('.') + 1;  // 0 where there is none
  Path parts{path.substr(0, first), path, {}};
  parts.key.remove_prefix(first);
  if (const std::size_t bracket = parts.key.find('[');
      bracket != std::string_view::npos) {
    parts.entry = parts.key.substr(bracket);
    parts.key.remove_suffix(parts.entry.size());
  }
  return parts;
}

/// Without the digits that only the multiplication brings.
double millimetres(double inches) {
  const std::string text = fmt::format("{:.15g}", inches * mm_per_inch);
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

void convert(Node& value, bool counted) {
  constexpr std::size_t count = 2;  // place of it
  if (auto* list = std::get_if<Array>(&value.value)) {
    for (std::size_t i = 0; i < list->size(); ++i) {
      if (!counted || i != count) convert((*list)[i], false);
    }
  } else if (auto* table = std::get_if<Members>(&value.value)) {
    for (Member& member : *table) convert(member.node, false);
  } else if (const auto* number = std::get_if<double>(&value.value)) {
    value.value = millimetres(*number);
  } else if (const auto* whole = std::get_if<std::int64_t>(&value.value)) {
    value.value = millimetres(static_cast<double>(*whole));
  }
}

}  // namespace

std::string key_in_mm(std::string_view key) {
  const Length* length = length_of(key);
  return length == nullptr ? std::string() : length->mm;
}

std::string key_in_inches(std::string_view key) {
  for (const auto& [inches, mm] : ends) {
    if (std::string found = with_end(key, mm, inches); !found.empty()) return found;
  }
  return {};
}

std::string path_in_mm(std::string_view path) {
  const Path parts = parts_of(path);
  const std::string mm = key_in_mm(parts.key);
  return mm.empty() ? std::string(path)
                    : fmt::format("{}{}{}", parts.before, mm, parts.entry);
}

Node value_in_mm(std::string_view path, Node value) {
  const Path parts = parts_of(path);
  const Length* length = length_of(parts.key);
  if (length != nullptr && !(length->counted && parts.entry == "[3]")) {
    convert(value, length->counted);
  }
  return value;
}

void take_inches(Node& table) {
  if (auto* list = std::get_if<Array>(&table.value)) {
    for (Node& entry : *list) take_inches(entry);
    return;
  }
  auto* members = std::get_if<Members>(&table.value);
  if (members == nullptr) return;
  for (Member& member : *members) {
    if (member.key == "sweep") continue;
    const std::string mm = key_in_mm(member.key);
    if (mm.empty()) {
      take_inches(member.node);
    } else if (find(table, mm) == nullptr) {
      member.node = value_in_mm(member.key, std::move(member.node));
      member.key = mm;
    }
  }
}

}  // namespace trochoid::cases
