#pragma once

#include <trochoid/base/names.h>
#include <trochoid/cases/schema.h>

#include <algorithm>
#include <array>

namespace trochoid::cases {

/// Ultrasonic machines stay below the one, all that swings on a machine above the other.
inline constexpr double longest_mm = 10000;

/// @brief A closed choice by its place among the names: an int, or an enumeration whose
/// enumerators are 0, 1, 2 ...
template <class Value>
Field choice(Value& value, std::span<const std::string_view> names) {
  return Choice{names, [&value] { return static_cast<int>(value); },
                [&value](int i) { value = static_cast<Value>(i); }};
}

/// @brief The same with the names that stand beside the enumeration (base/names.h).
template <class Enum>
Field choice(Enum& value) {
  return choice(value, base::names<Enum>);
}

/// @brief The same with a further name for none of them.
template <class Enum>
Field choice(std::optional<Enum>& value, std::string_view none) {
  static const auto names = [none] {
    std::array<std::string_view, base::names<Enum>.size() + 1> all{none};
    std::ranges::copy(base::names<Enum>, all.begin() + 1);
    return all;
  }();
  return Choice{names, [&value] { return value ? static_cast<int>(*value) + 1 : 0; },
                [&value](int i) {
                  value =
                      i == 0 ? std::nullopt : std::optional(static_cast<Enum>(i - 1));
                }};
}

template <class Enum>
Field choices(std::vector<Enum>& values) {
  const auto get = [&values] {
    std::vector<int> all;
    all.reserve(values.size());
    for (const Enum value : values) {
      all.push_back(static_cast<int>(value));
    }
    return all;
  };
  const auto set = [&values](const std::vector<int>& all) {
    values.clear();
    for (const int i : all) {
      values.push_back(static_cast<Enum>(i));
    }
  };
  return Choices{.names = base::names<Enum>, .get = get, .set = set};
}

}  // namespace trochoid::cases
