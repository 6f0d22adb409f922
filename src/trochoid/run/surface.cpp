#include <trochoid/results/json.h>
#include <trochoid/run/surface.h>

#include <trochoid/base/units.h>
#include <trochoid/run/surface_map.h>
#include <trochoid/run/wall_setting.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;

base::Table surface_table(const SurfaceMap& map) {
  base::Table table{"surface.csv",
                    {{"x_mm", {}}, {"height_mm", {}}, {"error_mm", {}}, {"tooth", {}}}};
  for (const MapRow& row : map.rows) {
    for (std::size_t i = 0; i < row.x.size(); ++i) {
      table.columns[0].values.push_back(unit::in(row.x[i], unit::mm));
      table.columns[1].values.push_back(unit::in(row.height, unit::mm));
      table.columns[2].values.push_back(row.error[i] / unit::mm);
      table.columns[3].values.push_back(row.tooth[i] + 1);
    }
  }
  return table;
}

base::Table force_table(const SurfaceMap& map) {
  base::Table table{"forces.csv",
                    {{"angle_deg", {}},
                     {"x_mm", {}},
                     {"F_normal_N", {}},
                     {"Fx_N", {}},
                     {"Fy_N", {}}}};
  for (const ForceRow& row : map.forces) {
    table.columns[0].values.push_back(unit::in(row.phi, unit::deg));
    table.columns[1].values.push_back(unit::in(row.x, unit::mm));
    table.columns[2].values.push_back(map.sigma * row.F_y);
    table.columns[3].values.push_back(row.F_x);
    table.columns[4].values.push_back(row.F_y);
  }
  return table;
}

base::Table deflection_table(const SurfaceMap& map) {
  base::Table table{"deflection.csv",
                    {{"angle_deg", {}}, {"height_mm", {}}, {"deflection_mm", {}}}};
  for (const MapRow& row : map.rows) {
    for (std::size_t i = 0; i < map.forces.size(); ++i) {
      table.columns[0].values.push_back(unit::in(map.forces[i].phi, unit::deg));
      table.columns[1].values.push_back(unit::in(row.height, unit::mm));
      table.columns[2].values.push_back(row.deflection[i] / unit::mm);
    }
  }
  return table;
}

base::Table influence_table(const SurfaceMap& map) {
  base::Table table{"influence.csv",
                    {{"height_mm", {}},
                     {"load_height_mm", {}},
                     {"cutter_mm_per_N", {}},
                     {"wall_mm_per_N", {}}}};
  const std::size_t n = map.influence_heights.size();
  for (std::size_t i = 0; i < n * n; ++i) {
    table.columns[0].values.push_back(unit::in(map.influence_heights[i / n], unit::mm));
    table.columns[1].values.push_back(unit::in(map.influence_heights[i % n], unit::mm));
    table.columns[2].values.push_back(map.of_cutter[i] / unit::mm);
    table.columns[3].values.push_back(map.of_wall[i] / unit::mm);
  }
  return table;
}

struct Range {
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;
};

Range range_of(const std::vector<double>& values) {
  Range range{.low = values.front(), .high = values.front()};
  for (const double v : values) {
    range.mean += v / static_cast<double>(values.size());
    range.low = std::min(range.low, v);
    range.high = std::max(range.high, v);
  }
  return range;
}

Json height_json(const MapRow& row, int teeth) {
  const Range range = range_of(row.error);
  double roughness = 0.0;
  std::vector<double> share(static_cast<std::size_t>(teeth));
  for (std::size_t i = 0; i < row.error.size(); ++i) {
    const double part = 1.0 / static_cast<double>(row.error.size());
    roughness += part * std::abs(row.error[i] - range.mean);
    share[static_cast<std::size_t>(row.tooth[i])] += part;
  }
  Json json{{"height_mm", unit::in(row.height, unit::mm)},
            {"mean_error_mm", range.mean / unit::mm},
            {"min_error_mm", range.low / unit::mm},
            {"max_error_mm", range.high / unit::mm},
            {"Ra_um", roughness / unit::um},
            {"Rt_um", (range.high - range.low) / unit::um},
            {"share", share},
            {"compliance_mm_per_N", row.compliance / unit::mm}};
  if (row.once_per_turn) {
    json["once_per_turn_um"] = *row.once_per_turn / unit::um;
    json["once_per_tooth_um"] = row.once_per_tooth / unit::um;
  }
  if (row.per_K) {
    json["operator"] = {{"K_tc_mm_per_MPa", (*row.per_K)[0] * unit::MPa / unit::mm},
                        {"K_rc_mm_per_MPa", (*row.per_K)[1] * unit::MPa / unit::mm}};
  }
  return json;
}

Json force_json(const SurfaceMap& map) {
  std::vector<double> normal;
  std::vector<double> along;
  for (const ForceRow& row : map.forces) {
    normal.push_back(map.sigma * row.F_y);
    along.push_back(row.F_x);
  }
  const Range n = range_of(normal);
  const Range x = range_of(along);
  return {{"F_normal_mean_N", n.mean}, {"F_normal_min_N", n.low},
          {"F_normal_max_N", n.high},  {"Fx_mean_N", x.mean},
          {"Fx_min_N", x.low},         {"Fx_max_N", x.high}};
}

/// What bent.csv shows, and the bodies that it is drawn on.
Json bent_json(const inputs::Case& given, const Bent& bent) {
  Json json{{"angle_deg", unit::in(bent.phi, unit::deg)},
            {"F_normal_N", bent.F_normal},
            {"cutter", nullptr},
            {"wall", nullptr}};
  if (given.machine.cutter_body) {
    const inputs::CutterBody& b = *given.machine.cutter_body;
    json["cutter"] = {
        {"diameter_mm", unit::in(given.setup.cutter.profile.D, unit::mm)},
        {"shank_diameter_mm", unit::in(b.shank_diameter.value_or(0.0), unit::mm)},
        {"flute_length_mm", unit::in(b.flute_length.value_or(b.overhang), unit::mm)},
        {"overhang_mm", unit::in(b.overhang, unit::mm)}};
  }
  if (given.machine.wall) {
    const inputs::Wall& w = *given.machine.wall;
    json["wall"] = {{"height_mm", unit::in(w.height, unit::mm)},
                    {"thickness_mm", unit::in(w.thickness, unit::mm)},
                    {"edge_height_mm", unit::in(given.setup.cut.a_p, unit::mm)}};
  }
  return json;
}

std::string short_table(const inputs::Case& given, const Json& result) {
  const auto number = [](const Json& value, const char* key) {
    return value[key].get<double>();
  };
  std::string text = fmt::format(
      "error of the wall, positive: material left   (model {}, feedback {})\n"
      "  {:>10} {:>12} {:>12} {:>12} {:>9}\n",
      result["model"].get<std::string>(), result["feedback"].get<std::string>(),
      "height mm", "mean um", "least um", "largest um", "Ra um");
  const Json& heights = result["heights"];
  const std::size_t every = std::max<std::size_t>(1, heights.size() / 10);
  for (std::size_t i = 0; i < heights.size(); i += every) {
    const Json& h = heights[i];
    text += fmt::format("  {:>10.3f} {:>12.3f} {:>12.3f} {:>12.3f} {:>9.3f}\n",
                        number(h, "height_mm"), 1e3 * number(h, "mean_error_mm"),
                        1e3 * number(h, "min_error_mm"),
                        1e3 * number(h, "max_error_mm"), number(h, "Ra_um"));
  }
  const auto newtons = [&](const char* key) {
    const double x = number(result["forces"], key);
    return std::abs(x) < 0.005 ? 0.0 : x;  // else it might print as -0.00
  };
  text += fmt::format(
      "force across the wall: {:.2f} N mean, {:.2f} to {:.2f} N (positive: pushes "
      "cutter and wall apart)\n",
      newtons("F_normal_mean_N"), newtons("F_normal_min_N"), newtons("F_normal_max_N"));
  text += fmt::format("compliance at {:g} mm for the whole force: {:.4g} um/N{}{}\n",
                      number(heights.front(), "height_mm"),
                      1e3 * number(result, "compliance_mm_per_N"),
                      given.machine.cutter_body ? "" : " (rigid cutter)",
                      given.machine.wall ? "" : " (rigid wall)");
  return text;
}

void add_warnings(const inputs::Case& given, const SurfaceMap& map, double largest,
                  results::Answer& answer) {
  add_bending_warnings(given, largest, answer.heading.warnings);
  if (!given.machine.cutter_body && !given.machine.wall) {
    answer.heading.warnings.push_back(
        {"rigid", "Neither [cutter_body] nor [wall] is given: nothing bends."});
  }
  if (map.model == surface::Model::quasi_static) {
    answer.heading.warnings.push_back(
        {"quasi_static",
         "quasi_static is the deflection at every spindle angle, as the paper has it: "
         "a pulse of force, not the profile that stays on the wall."});
  }
}

}  // namespace

results::Answer surface(const inputs::Case& given, const Progress& progress) {
  results::Answer answer{
      .command = "surface",
      .heading = {.title = given.title, .case_toml = given.as_understood}};
  const SurfaceMap map = surface_map(given, progress);
  Json result{{"model", surface::name_of(map.model)},
              {"feedback", surface::name_of(map.feedback)}};
  if (!map.converged) {
    answer.heading.ok = false;
    answer.heading.message =
        map.found ? fmt::format(
                        "after {} turns the deflection still changed by {:.2g} % from "
                        "turn to turn: no state was found that repeats",
                        map.turns, 100 * map.change)
                  : "no deflection agrees with the chip that it makes: the force "
                    "pulls cutter and wall together faster than they resist";
    answer.result = results::json_value(result.dump());
    return answer;
  }
  double mean = 0.0;
  double peak = map.rows.front().error.front();
  double least = peak;
  Json heights = Json::array();
  for (const MapRow& row : map.rows) {
    const Range range = range_of(row.error);
    mean += range.mean / static_cast<double>(map.rows.size());
    peak = std::max(peak, range.high);
    least = std::min(least, range.low);
    heights.push_back(height_json(row, given.setup.cutter.teeth()));
  }
  result["mean_error_mm"] = mean / unit::mm;
  result["peak_error_mm"] = peak / unit::mm;
  result["min_error_mm"] = least / unit::mm;
  result["forces"] = force_json(map);
  result["compliance_mm_per_N"] = map.rows.front().compliance / unit::mm;
  result["turns_to_repeat"] = map.turns;
  result["heights"] = heights;
  add_warnings(given, map, std::max(std::abs(peak), std::abs(least)), answer);
  answer.tables = {surface_table(map), force_table(map), deflection_table(map),
                   influence_table(map)};
  if (map.bent) {
    answer.tables.push_back(bent_table(*map.bent));
    result["bent"] = bent_json(given, *map.bent);
  }
  answer.heading.message = fmt::format(
      "The error of the wall is {:.3g} um on average and {:.3g} um at most (positive: "
      "material left).",
      mean / unit::um, peak / unit::um);
  answer.short_table = short_table(given, result);
  answer.result = results::json_value(result.dump());
  return answer;
}

}  // namespace trochoid::run
