#include <trochoid/results/folder.h>
#include <trochoid/results/number.h>
#include <trochoid/results/provenance.h>

#include <nlohmann/json.hpp>

namespace trochoid::results {

namespace {

using Json = nlohmann::ordered_json;

/// One line for a scalar, or for an array of scalars; one line an entry otherwise.
bool fits_one_line(const Json& value) {
  if (!value.is_structured()) return true;
  if (value.is_object()) return value.empty();
  for (const auto& entry : value) {
    if (entry.is_structured()) return false;
  }
  return true;
}

void append_line_break(std::string& text, int depth) {
  text += '\n';
  text.append(2 * static_cast<std::size_t>(depth), ' ');
}

/// nlohmann's own dump does not always give the shortest digits of a number.
void append(std::string& text, const Json& value, int depth) {
  if (value.is_number_float()) {
    if (!append_number(text, value.get<double>())) text += "null";
    return;
  }
  if (!value.is_structured()) {
    text += value.dump(-1, ' ', false, Json::error_handler_t::replace);
    return;
  }
  const bool one_line = fits_one_line(value);
  bool first = true;
  text += value.is_object() ? '{' : '[';
  for (const auto& [key, entry] : value.items()) {
    if (!first) text += one_line ? ", " : ",";
    first = false;
    if (!one_line) append_line_break(text, depth + 1);
    if (value.is_object()) {
      text += Json(key).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
    }
    append(text, entry, depth + 1);
  }
  if (!one_line) append_line_break(text, depth);
  text += value.is_object() ? '}' : ']';
}

}  // namespace

std::string summary_json(const base::Answer& answer) {
  Json warnings = Json::array();
  for (const auto& warning : answer.warnings) {
    warnings.push_back({{"code", warning.code}, {"message", warning.message}});
  }
  const Json summary = {
      {"trochoid", {{"version", version()}, {"commit", commit()}}},
      {"command", answer.command},
      {"status", answer.ok ? "ok" : "failed"},
      {"message", answer.message},
      {"warnings", std::move(warnings)},
      {"result", answer.result.empty() ? Json::object() : Json::parse(answer.result)},
  };
  std::string text;
  append(text, summary, 0);
  return text + '\n';
}

}  // namespace trochoid::results
