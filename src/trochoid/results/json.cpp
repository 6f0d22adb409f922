#include <trochoid/results/json.h>

#include <trochoid/base/nesting.h>
#include <trochoid/base/overloaded.h>
#include <trochoid/results/number.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <stdexcept>

namespace trochoid::results {

namespace {

using Json = nlohmann::ordered_json;

bool is_structured(const Value& value) noexcept {
  return std::holds_alternative<Array>(value.data) ||
         std::holds_alternative<Object>(value.data);
}

bool one_line(const Array& list) {
  return std::none_of(list.begin(), list.end(), is_structured);
}

void append_line_break(std::string& text, int depth) {
  text += '\n';
  text.append(2 * static_cast<std::size_t>(depth), ' ');
}

void append(std::string& text, const Value& value, int depth);

void append_list(std::string& text, const Array& list, int depth) {
  const bool flat = one_line(list);
  text += '[';
  for (const Value& entry : list) {
    if (&entry != &list.front()) text += flat ? ", " : ",";
    if (!flat) append_line_break(text, depth + 1);
    append(text, entry, depth + 1);
  }
  if (!flat) append_line_break(text, depth);
  text += ']';
}

void append_object(std::string& text, const Object& object, int depth) {
  text += '{';
  for (const Member& member : object) {
    if (&member != &object.front()) text += ',';
    append_line_break(text, depth + 1);
    text += json_quoted(member.key) + ": ";
    append(text, member.value, depth + 1);
  }
  if (!object.empty()) append_line_break(text, depth);
  text += '}';
}

void append(std::string& text, const Value& value, int depth) {
  std::visit(base::Overloaded{
                 [&](std::nullptr_t) { text += "null"; },
                 [&](bool truth) { text += truth ? "true" : "false"; },
                 [&](std::int64_t whole) { text += std::to_string(whole); },
                 [&](double number) {
                   if (!append_number(text, number)) text += "null";
                 },
                 [&](const std::string& words) { text += json_quoted(words); },
                 [&](const Array& list) { append_list(text, list, depth); },
                 [&](const Object& object) { append_object(text, object, depth); }},
             value.data);
}

Value value_of(const Json& json) {
  switch (json.type()) {
    case Json::value_t::boolean:
      return json.get<bool>();
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
      return json.get<std::int64_t>();
    case Json::value_t::number_float:
      return json.get<double>();
    case Json::value_t::string:
      return json.get<std::string>();
    case Json::value_t::array: {
      Array list;
      for (const Json& entry : json) {
        list.push_back(value_of(entry));
      }
      return list;
    }
    case Json::value_t::object: {
      Object object;
      for (const auto& [key, entry] : json.items()) {
        object.push_back({key, value_of(entry)});
      }
      return object;
    }
    case Json::value_t::null:
    case Json::value_t::binary:
    case Json::value_t::discarded:
      break;
  }
  return nullptr;
}

}  // namespace

std::string json_text(const Value& value) {
  std::string text;
  append(text, value, 0);
  return text;
}

std::string json_quoted(std::string_view text) {
  return Json(std::string(text)).dump(-1, ' ', false, Json::error_handler_t::replace);
}

Value json_value(std::string_view text) {
  if (const auto deep = base::too_deep(text)) {
    throw std::invalid_argument("line " + std::to_string(deep->line) + ": " +
                                std::string(deep->why));
  }
  try {
    return value_of(Json::parse(text));
  } catch (const Json::exception& error) {
    throw std::invalid_argument(error.what());
  }
}

}  // namespace trochoid::results
