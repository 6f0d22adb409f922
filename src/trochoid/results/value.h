#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace trochoid::results {

struct Value;
struct Member;
using Array = std::vector<Value>;
using Object = std::vector<Member>;  ///< in the order in which it was built

template <class Number>
concept WholeNumber = std::integral<Number> && !std::same_as<Number, bool>;

/// @brief A value of summary.json: null, truth, number, text, list or object.
///
/// A number that is not finite is null in every file.
struct Value {
  // Null at first, without saying so: Member is not known here yet.
  std::variant<std::nullptr_t, bool, std::int64_t, double, std::string, Array, Object>
      data;

  // Not inline: they are long, and a file that builds an answer needs hundreds of them.
  Value() noexcept;
  Value(const Value& other);
  Value(Value&& other) noexcept;
  Value& operator=(const Value& other);
  Value& operator=(Value&& other) noexcept;
  ~Value();

  Value(std::nullptr_t) noexcept;
  Value(bool value) noexcept;
  Value(std::int64_t value) noexcept;
  Value(double value) noexcept;
  Value(const char* text);
  Value(std::string text);
  Value(std::string_view text);
  Value(Array list);
  Value(Object object);
  template <WholeNumber Number>
  Value(Number value) noexcept : Value(static_cast<std::int64_t>(value)) {}
  /// A list of what can be a value.
  template <class Entry>
  Value(const std::vector<Entry>& list) : Value(Array(list.begin(), list.end())) {}
  template <class Entry, std::size_t count>
  Value(const std::array<Entry, count>& list)
      : Value(Array(list.begin(), list.end())) {}
  /// null where there is none.
  template <class Entry>
  Value(const std::optional<Entry>& value) : Value(value ? Value(*value) : Value()) {}
};

struct Member {
  std::string key;
  Value value;
};

/// @return nullptr where `value` is no object or has no such key
const Value* find(const Value& value, std::string_view key) noexcept;

/// Append a member, or replace the one of that key.
void set(Object& object, std::string_view key, Value value);

/// A number in another unit, null where there is none.
Value in_unit(const std::optional<double>& value, double unit);
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
Value alone_or_list(Array list);

}  // namespace trochoid::results
