#pragma once

#include <trochoid/base/names.h>
#include <trochoid/inputs/schema.h>

namespace trochoid::inputs {

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
  return Choices{base::names<Enum>, get, set};
}

}  // namespace trochoid::inputs
