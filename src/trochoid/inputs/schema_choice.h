#pragma once

#include <trochoid/inputs/schema.h>

namespace trochoid::inputs {

/// @brief A closed choice of an enumeration whose enumerators are 0, 1, 2 ...
template <class Enum>
Field choice(Enum& value, std::span<const std::string_view> names) {
  return Choice{names, [&value] { return static_cast<int>(value); },
                [&value](int i) { value = static_cast<Enum>(i); }};
}

template <class Enum>
Field choices(std::vector<Enum>& values, std::span<const std::string_view> names) {
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
  return Choices{names, get, set};
}

}  // namespace trochoid::inputs
