#include <trochoid/base/names.h>
#include <trochoid/cases/sweep.h>

#include <fmt/core.h>

#include <nlohmann/json.hpp>

namespace trochoid::cases {

namespace {

using Json = nlohmann::ordered_json;

Json form(const Json& keys, const Json& needed) {
  return {{"type", "object"},
          {"properties", keys},
          {"required", needed},
          {"additionalProperties", false}};
}

/// What one key of `over` may be set to, as read_values reads it.
Json value_forms() {
  const Json number{{"type", "number"}};
  const Json text{{"type", "string"}};
  const Json count{{"type", "integer"}, {"minimum", 1}, {"maximum", most_sweep_rows}};
  const Json values{
      {"type", "array"},
      {"minItems", 1},
      {"items", {{"type", Json::array({"number", "string", "boolean"})}}}};
  const Json spread{{"type", "number"}, {"exclusiveMinimum", 0}};
  return {{"anyOf",
           {form({{"from", number}, {"to", number}, {"count", count}}, {"from", "to"}),
            form({{"values", values}}, Json::array({"values"})),
            form({{"mean", number}, {"sd", spread}}, {"mean", "sd"}),
            form({{"file", text}, {"column", text}}, {"file", "column"})}}};
}

/// What is drawn, as read_drawn reads it.
Json drawn() {
  const Json text{{"type", "string"}};
  const Json one{
      {"anyOf",
       {text, form({{"file", text}, {"group", text}}, Json::array({"file"}))}}};
  return {{"anyOf", {one, {{"type", "array"}, {"minItems", 1}, {"items", one}}}}};
}

constexpr std::string_view left_out = "left out";

constexpr SweepKeyText key_texts[] = {
    {"over",
     "a table of keys of the case in quotes, each set to one of the forms below",
     "needed, or `covariance`",
     "keys such as \"cut.spindle_rpm\", and their values: { from, to, count } evenly, "
     "{ values = [...] }, { file, column } of a text file, or by chance { mean, sd }"},
    {"method", "one of \"grid\", \"list\", \"latin_hypercube\", \"random\"",
     "`\"grid\"`",
     "grid: every combination, the last key fastest; list: all keys together; random, "
     "latin_hypercube: by chance"},
    {"count", "a whole number from 1 to 100000000", "200",
     "rows of random and latin_hypercube"},
    {"seed", "a whole number of 0 or more", "`1`", "start of the random numbers"},
    {"command", "text", "from the command line", "what answers each row"},
    {"take", "a list of texts", "needed, here or with `--take`",
     "what is taken from each answer, such as \"result.peak_xy_N\""},
    {"covariance", "text, { file, group }, or a list of them", left_out,
     "results of identify, modes or calibrate, or their folders, whose numbers are drawn "
     "together"},
    {"draws", "a whole number from 1 to 1000000", "200 with `covariance`",
     "how many; of each point of a grid or list"},
    {"hdf5", "true or false", "`false`", "the table as HDF5 too: sweep.h5"}};

}  // namespace

std::span<const SweepKeyText> sweep_keys() noexcept {
  return key_texts;
}

std::string sweep_schema() {
  const Json text{{"type", "string"}};
  Json out = form(
      {{"over", {{"type", "object"}, {"additionalProperties", value_forms()}}},
       {"method", {{"enum", base::names<SweepMethod>}, {"default", "grid"}}},
       {"seed", {{"type", "integer"}, {"minimum", 0}, {"default", 1}}},
       {"count", {{"type", "integer"}, {"minimum", 1}, {"maximum", most_sweep_rows}}},
       {"command", text},
       {"hdf5", {{"type", "boolean"}, {"default", false}}},
       {"take", {{"type", "array"}, {"items", text}}},
       {"covariance", drawn()},
       {"draws", {{"type", "integer"}, {"minimum", 1}, {"maximum", most_draws}}}},
      Json::array());
  out["anyOf"] = {{{"required", Json::array({"over"})}},
                  {{"required", Json::array({"covariance"})}}};
  out["properties"]["over"]["minProperties"] = 1;
  for (const SweepKeyText& key : key_texts) {
    Json& property = out["properties"][key.name];
    const bool tells = property.contains("default") || key.standard == left_out ||
                       key.standard.starts_with("needed");
    property["description"] =
        tells ? std::string(key.meaning)
              : fmt::format("{}; default: {}", key.meaning, key.standard);
  }
  out["description"] = "one case over many values of its keys";
  return out.dump();
}

}  // namespace trochoid::cases
