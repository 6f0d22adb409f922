#include <trochoid/inputs/inches.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <utility>
#include <vector>

namespace trochoid::inputs {

namespace {

constexpr double mm_per_inch = unit::inch / unit::mm;

/// Ends of keys, the longer ones first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> ends = {
    {{"_in_per_min", "_mm_per_min"}, {"_in", "_mm"}}};

/// The key with another end; empty: it ends otherwise. What is a force per length is none.
std::string with_end(std::string_view key, std::string_view end,
                     std::string_view other) {
  if (!key.ends_with(end)) return {};
  key.remove_suffix(end.size());
  return key.empty() || key.ends_with("_per") ? std::string()
                                              : std::string(key) + std::string(other);
}

/// Without the digits that only the multiplication brings.
double in_mm(double inches) {
  const std::string text = fmt::format("{:.15g}", inches * mm_per_inch);
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

void take_inches(Node& table, std::vector<std::string>& problems) {
  if (auto* list = std::get_if<Array>(&table.value)) {
    for (Node& entry : *list) take_inches(entry, problems);
    return;
  }
  auto* members = std::get_if<Members>(&table.value);
  if (members == nullptr) return;
  for (Member& member : *members) {
    if (member.key == "sweep") continue;
    std::string key = key_in_mm(member.key);
    if (key.empty()) {
      take_inches(member.node, problems);
    } else if (find(table, key) != nullptr) {
      problems.push_back(fmt::format("{}: {}: {} is given as well; give one of them",
                                     to_string(member.where), member.key, key));
    } else {
      member.key = std::move(key);
      member.node = value_in_mm(std::move(member.node));
    }
  }
}

}  // namespace

std::string key_in_mm(std::string_view key) {
  for (const auto& [inches, mm] : ends) {
    if (std::string found = with_end(key, inches, mm); !found.empty()) return found;
  }
  return {};
}

std::string key_in_inches(std::string_view key) {
  for (const auto& [inches, mm] : ends) {
    if (std::string found = with_end(key, mm, inches); !found.empty()) return found;
  }
  return {};
}

Node value_in_mm(Node value) {
  if (auto* list = std::get_if<Array>(&value.value)) {
    for (Node& entry : *list) entry = value_in_mm(std::move(entry));
  } else if (const auto* number = std::get_if<double>(&value.value)) {
    value.value = in_mm(*number);
  } else if (const auto* whole = std::get_if<std::int64_t>(&value.value)) {
    value.value = in_mm(static_cast<double>(*whole));
  }
  return value;
}

void take_inches(Node& table) {
  std::vector<std::string> problems;
  take_inches(table, problems);
  if (!problems.empty()) throw base::InputError(std::move(problems));
}

}  // namespace trochoid::inputs
