#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace trochoid::results {

struct Value;
struct Member;
using Array = std::vector<Value>;
using Object = std::vector<Member>;  ///< in the order in which it was built

/// @brief A value of summary.json: null, truth, number, text, list or object.
///
/// A number that is not finite is null in every file.
struct Value {
  std::variant<std::nullptr_t, bool, std::int64_t, double, std::string, Array, Object>
      data = nullptr;

  Value() = default;
  Value(std::nullptr_t) {}
  Value(bool value) : data(value) {}
  template <std::integral Number>
  requires(!std::same_as<Number, bool>) Value(Number value)
      : data(static_cast<std::int64_t>(value)) {}
  Value(double value) : data(value) {}
  Value(const char* text) : data(std::string(text)) {}
  Value(std::string text) : data(std::move(text)) {}
  Value(std::string_view text) : data(std::string(text)) {}
  Value(Array list) : data(std::move(list)) {}
  Value(Object object);
  /// A list of what can be a value.
  template <class Entry>
  requires(!std::same_as<Entry, Value> && !std::same_as<Entry, Member>)
      Value(const std::vector<Entry>& list)
      : data(Array(list.begin(), list.end())) {}
  template <class Entry, std::size_t count>
  Value(const std::array<Entry, count>& list) : data(Array(list.begin(), list.end())) {}
  /// null where there is none.
  template <class Entry>
  Value(const std::optional<Entry>& value) {
    if (value) {
      *this = Value(*value);
    }
  }
};

struct Member {
  std::string key;
  Value value;
};

inline Value::Value(Object object) : data(std::move(object)) {}

/// @return nullptr where `value` is no object or has no such key
const Value* find(const Value& value, std::string_view key) noexcept;

/// Append a member, or replace the one of that key.
void set(Object& object, std::string_view key, Value value);

/// A number in another unit, null where there is none.
inline Value in_unit(const std::optional<double>& value, double unit) {
  return value ? Value(*value / unit) : Value();
}
/// Numbers in another unit.
template <class Numbers>
Value all_in_unit(const Numbers& values, double unit) {
  Array list;
  for (const double value : values) {
    list.emplace_back(value / unit);
  }
  return list;
}

/// A list in measurement order; of a single measurement, its entry alone.
inline Value alone_or_list(Array list) {
  return list.size() == 1 ? std::move(list.front()) : Value(std::move(list));
}

}  // namespace trochoid::results
