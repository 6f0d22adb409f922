#include <trochoid/results/value.h>

namespace trochoid::results {

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

}  // namespace trochoid::results
