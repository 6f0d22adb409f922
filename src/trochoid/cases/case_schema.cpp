#include <trochoid/base/unit_of_key.h>
#include <trochoid/cases/case.h>
#include <trochoid/cases/inches.h>
#include <trochoid/cases/tables.h>

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "sweep.h"

namespace trochoid::cases {

namespace {

using Json = nlohmann::ordered_json;

/// Where the limits of a key are not those of its numbers.
Json number_of(std::string_view type, const Range& range) {
  Json out{{"type", type}};
  if (std::isfinite(range.low)) {
    out[range.open_low ? "exclusiveMinimum" : "minimum"] = range.low;
  }
  if (std::isfinite(range.high)) {
    out[range.open_high ? "exclusiveMaximum" : "maximum"] = range.high;
  }
  return out;
}

Json text_of(bool may_be_empty) {
  return may_be_empty ? Json{{"type", "string"}}
                      : Json{{"type", "string"}, {"minLength", 1}};
}

Json list_of(const Json& entry, std::size_t least, std::size_t most) {
  Json out{{"type", "array"}, {"items", entry}, {"minItems", std::max(least, {1})}};
  if (most > 0) {
    out["maxItems"] = most;
  }
  return out;
}

/// A table: what may stand in it, and what of that goes together.
///
/// The second holds for a case file as a whole only: what one key of an included file
/// wants, another file may have.
struct TableSchema {
  Json keys = Json::object();
  Json together = Json::object();
};

template <class Table>
TableSchema schema_of(Table&& table);

/// Inches may stand for millimetres: such keys are known by their pattern only.
Json closed(const Json& keys) {
  std::string inches;
  for (const auto& [key, value] : keys.items()) {
    if (const std::string other = key_in_inches(key); !other.empty()) {
      inches += (inches.empty() ? "" : "|") + other;
    }
  }
  Json out{{"type", "object"}, {"properties", keys}, {"additionalProperties", false}};
  if (!inches.empty()) {
    out["patternProperties"] = {
        {"^(" + inches + ")$", {{"type", {"number", "array", "object"}}}}};
  }
  return out;
}

/// The key, or the same in inches.
Json asked(std::string_view key) {
  const Json one{{"required", {key}}};
  const std::string inches = key_in_inches(key);
  if (inches.empty()) return one;
  // In words of a checker better than anyOf: the key of millimetres is what it misses.
  return {{"if", {{"required", {inches}}}}, {"then", true}, {"else", one}};
}

/// What a value may be; `together` becomes the rules of a table within.
struct ValueSchema {
  const Key& key;
  Json& together;

  Json operator()(const bool*) const { return {{"type", "boolean"}}; }
  Json operator()(const int*) const { return number_of("integer", key.range); }
  Json operator()(const double*) const { return number_of("number", key.range); }
  Json operator()(const std::optional<double>*) const {
    return number_of("number", key.range);
  }
  Json operator()(const std::string*) const {
    return text_of(key.need != Need::always);
  }
  Json operator()(const files::FileRef*) const {
    return text_of(key.need != Need::always);
  }
  Json operator()(const std::vector<double>*) const {
    return list_of(number_of("number", key.range), key.gaps ? 0 : key.count, key.count);
  }
  Json operator()(const std::optional<base::Steps>*) const {
    const Json place = number_of("number", key.range);
    return {{"type", "array"},
            {"items", Json::array({place, place, Json{{"type", "number"}}})},
            {"minItems", 3},
            {"maxItems", 3}};
  }
  Json operator()(const std::vector<std::string>*) const {
    return list_of(text_of(key.gaps), key.gaps ? 0 : key.count, key.count);
  }
  Json operator()(const Rows*) const {
    const std::size_t rows = key.count > 0 ? key.count : 3;
    return list_of(list_of(number_of("number", key.range), 3, 3), rows, rows);
  }
  Json operator()(const Pairs*) const {
    return list_of(list_of(number_of("number", key.range), 2, 2), 1, 0);
  }
  Json operator()(const ArcLayers*) const {
    const Json number = number_of("number", key.range);
    const Json layer{{"type", "object"},
                     {"properties",
                      {{"from_mm", number},
                       {"to_mm", number},
                       {"arcs_deg", list_of(list_of(number, 2, 2), 0, 0)}}},
                     {"required", {"from_mm", "to_mm", "arcs_deg"}},
                     {"additionalProperties", false}};
    return list_of(layer, 1, 0);
  }
  Json operator()(const std::optional<StockCylinder>*) const {
    const Json number = number_of("number", key.range);
    return {{"type", "object"},
            {"properties",
             {{"axis_xy", list_of(number, 2, 2)},
              {"radius", number_of("number", {0.0, key.range.high, true, false})},
              {"z", list_of(number, 2, 2)}}},
            {"required", {"axis_xy", "radius", "z"}},
            {"additionalProperties", false}};
  }
  Json operator()(const ToolName*) const {
    return {{"anyOf", {Json{{"type", "integer"}, {"minimum", 0}}, text_of(false)}}};
  }
  Json operator()(const std::vector<ToolName>*) const {
    return list_of((*this)(static_cast<const ToolName*>(nullptr)), 1, 0);
  }
  Json operator()(const NamedPlaces*) const {
    return {{"type", "object"},
            {"additionalProperties", list_of(number_of("number", key.range), 3, 3)}};
  }
  Json operator()(const NamedFiles*) const {
    return {{"type", "object"}, {"additionalProperties", text_of(false)}};
  }
  Json operator()(const Choice& choice) const { return {{"enum", choice.names}}; }
  Json operator()(const Choices& choices) const {
    const Json one{{"enum", choices.names}};
    Json out = list_of(one, 1, 0);
    out["uniqueItems"] = true;
    return choices.alone ? Json{{"anyOf", {one, out}}} : out;
  }
  Json operator()(const std::optional<base::Normal>*) const {
    const Json number = number_of("number", key.range);
    return {{"type", "object"},
            {"properties",
             {{"mean", number},
              {"sd", number_of("number", {0.0, key.range.high, true, false})}}},
            {"required", {"mean", "sd"}},
            {"additionalProperties", false}};
  }
  Json operator()(const std::optional<files::Direction>*) const {
    const Json axis{{"type", "string"}, {"pattern", "^[+-]?[xyzXYZ]$"}};
    return {{"anyOf", {axis, list_of(number_of("number", key.range), 3, 3)}}};
  }
  Json operator()(CutTable* cut) const { return closed(schema_of(*cut).keys); }
  Json operator()(std::optional<PreviousClamping>* clamping) const {
    return within(clamping->emplace());
  }
  Json operator()(std::optional<geometry::Serration>* wave) const {
    return within(wave->emplace());
  }
  Json operator()(const PerTooth*) const {
    const Json one = number_of("number", key.range);
    return {{"anyOf", {one, list_of(one, 1, 0)}}};
  }
  Json operator()(std::optional<files::SurfaceFrame>* frame) const {
    return within(frame->emplace());
  }

  template <class Table>
  Json within(Table& table) const {
    const TableSchema inner = schema_of(table);
    together = inner.together;
    return closed(inner.keys);
  }
};

/// TOML of one line, where JSON writes it alike.
Json as_json(std::string_view toml) {
  return Json::parse(toml, nullptr, false);
}

std::string description_of(const Key& key) {
  std::string text = meaning_of(key);
  if (const auto symbol = unit::of_key(key.name).symbol; !symbol.empty()) {
    text += fmt::format(" [{}]", symbol);
  }
  return key.standard.empty() ? text
                              : fmt::format("{}; default: {}", text, key.standard);
}

/// Gathers the keys of one table.
struct TableVisitor {
  TableSchema out = {};
  Json all_of = Json::array();
  Json required = Json::array();
  std::map<std::string_view, std::string_view> chosen = {};  ///< defaults of choices

  void operator()(const Key& key, const Field& field) {
    const std::string name{key.name};
    Json inner = Json::object();
    const auto standard = toml_text(key, field);  // what is emplaced below has none
    Json value = std::visit(ValueSchema{key, inner}, field);
    if (!key.word.empty()) {
      value = {{"anyOf", {value, Json{{"const", key.word}}}}};
    }
    value["description"] = description_of(key);
    if (standard && key.need == Need::optional && key.standard.empty()) {
      value["default"] = as_json(*standard);
    }
    out.keys[name] = value;
    if (!inner.empty()) {
      out.together["properties"][name] = inner;
    }
    if (const auto* choice = std::get_if<Choice>(&field)) {
      chosen[key.name] = choice->names[static_cast<std::size_t>(choice->get())];
    }
    ask_for(key);
  }

  void ask_for(const Key& key) {
    Json needed = Json::object();
    if (key.need == Need::always) {
      needed = asked(key.name);
      if (!key.rival.empty()) {
        needed = {{"anyOf", {needed, asked(key.rival)}}};
      }
    }
    if (!key.only.selector.empty()) {
      all_of.push_back(only_for(key, needed));
    } else if (needed.contains("required")) {
      required.push_back(key.name);
    } else if (!needed.empty()) {
      all_of.push_back(needed);
    }
  }

  [[nodiscard]] Json only_for(const Key& key, const Json& needed) const {
    const auto& values = key.only.values;
    Json here{{"properties", {{key.only.selector, {{"enum", values}}}}}};
    const auto standard = chosen.find(key.only.selector);
    if (standard == chosen.end() ||
        std::find(values.begin(), values.end(), standard->second) == values.end()) {
      here["required"] = {key.only.selector};
    }
    const Json elsewhere = key.neutral ? Json{{"const", *key.neutral}} : Json(false);
    return {{"if", here},
            {"then", needed},
            {"else", {{"properties", {{key.name, elsewhere}}}}}};
  }

  [[nodiscard]] TableSchema schema() && {
    if (!required.empty()) out.together["required"] = required;
    if (!all_of.empty()) out.together["allOf"] = all_of;
    return std::move(out);
  }
};

TableSchema schema_of_keys(const std::function<void(const Visitor&)>& show) {
  TableVisitor visitor;
  show([&visitor](const Key& key, const Field& field) { visitor(key, field); });
  return std::move(visitor).schema();
}

template <class Table>
TableSchema schema_of(Table&& table) {
  return schema_of_keys([&table](const Visitor& v) { describe(v, table); });
}

void add_table(const TableEntry& table, Json& keys, Json& together) {
  if (table.count() == 0) {
    table.add();
  }
  const TableSchema one =
      schema_of_keys([&table](const Visitor& v) { table.describe(0, v); });
  const std::string name{table.name};
  Json value = closed(one.keys);
  if (table.many) {
    value = list_of(value, 1, 0);
  }
  value["description"] = table.meaning;
  keys[name] = value;
  if (!one.together.empty()) {
    together[name] = table.many ? Json{{"items", one.together}} : one.together;
  }
}

}  // namespace

std::string case_schema() {
  CaseTables tables;
  Json keys{{"include",
             {{"anyOf", {text_of(false), list_of(text_of(false), 1, 0)}},
              {"description", "case files whose tables this one builds on"}}}};
  keys.update(schema_of(tables).keys);
  Json together = Json::object();
  for (const TableEntry& table : tables_of(tables)) {
    add_table(table, keys, together);
  }
  keys["sweep"] = as_json(sweep_schema());
  Json out{{"$schema", "http://json-schema.org/draft-07/schema#"},
           {"title", "Case file of Trochoid"},
           {"description",
            "Made by the program (trochoid new --schema). What goes together is asked "
            "for only where a file includes no other one."}};
  out.update(closed(keys));
  out["if"] = {{"required", {"include"}}};
  out["then"] = true;
  out["else"] = {{"properties", together}};
  return out.dump(1) + '\n';
}

}  // namespace trochoid::cases
