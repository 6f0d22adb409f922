#include <trochoid/results/value.h>

namespace trochoid::results {

Value::Value() noexcept = default;
// By assignment: a variant whose own copy fails for want of memory g++ 12 destroys wrongly.
Value::Value(const Value& other) {
  data = other.data;
}
Value::Value(Value&& other) noexcept = default;
Value& Value::operator=(const Value& other) = default;
Value& Value::operator=(Value&& other) noexcept = default;
Value::~Value() = default;

Value::Value(std::nullptr_t) noexcept {}
Value::Value(bool value) noexcept : data(value) {}
Value::Value(std::int64_t value) noexcept : data(value) {}
Value::Value(double value) noexcept : data(value) {}
Value::Value(const char* text) : data(std::string(text)) {}
Value::Value(std::string text) : data(std::move(text)) {}
Value::Value(std::string_view text) : data(std::string(text)) {}
Value::Value(Array list) : data(std::move(list)) {}
Value::Value(Object object) : data(std::move(object)) {}

const Value* find(const Value& value, std::string_view key) noexcept {
  if (const auto* object = std::get_if<Object>(&value.data)) {
    for (const Member& member : *object) {
      if (member.key == key) {
        return &member.value;
      }
    }
  }
  return nullptr;
}

void set(Object& object, std::string_view key, Value value) {
  for (Member& member : object) {
    if (member.key == key) {
      member.value = std::move(value);
      return;
    }
  }
  object.push_back({std::string(key), std::move(value)});
}

Value in_unit(const std::optional<double>& value, double unit) {
  return value ? Value(*value / unit) : Value();
}

Value alone_or_list(Array list) {
  return list.size() == 1 ? std::move(list.front()) : Value(std::move(list));
}

}  // namespace trochoid::results
