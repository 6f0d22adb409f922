#include <trochoid/base/names.h>
#include <trochoid/cases/sweep.h>

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

}  // namespace

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
  out["properties"]["over"]["description"] =
      "keys of the case in quotes, such as \"cut.spindle_rpm\", and their values";
  out["properties"]["method"]["description"] =
      "grid: every combination; list: all keys together; random, latin_hypercube: by "
      "chance";
  out["properties"]["count"]["description"] =
      "rows of random and latin_hypercube; default: 200";
  out["properties"]["covariance"]["description"] =
      "results of identify, modes or calibrate whose numbers are drawn together";
  out["properties"]["draws"]["description"] =
      "how many; of each point of a grid or list";
  out["properties"]["hdf5"]["description"] = "the table as HDF5 too: sweep.h5";
  out["properties"]["command"]["description"] = "what answers each row";
  out["properties"]["take"]["description"] =
      "what is taken from each answer, such as \"result.peak_xy_N\"";
  out["description"] = "one case over many values of its keys";
  return out.dump();
}

}  // namespace trochoid::cases
