#include "file_names.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include <trochoid/base/read_text.h>
#include <trochoid/results/json.h>

namespace trochoid::results {

namespace {

constexpr auto names =
    std::to_array<std::string_view>({"case.toml",          "summary.json",
                                     "report.html",        "material.toml",
                                     "forces.csv",         "chip.csv",
                                     "chip_curve.csv",     "edges.csv",
                                     "floor.csv",          "fitted.csv",
                                     "channels.csv",       "residual.csv",
                                     "sweep.csv",          "sweep.h5",
                                     "bands.csv",          "folded.csv",
                                     "surface.csv",        "deflection.csv",
                                     "influence.csv",      "motion.csv",
                                     "lobes.csv",          "limit.csv",
                                     "zeroth_order.csv",   "multi_frequency.csv",
                                     "stabilisation.csv",  "response.csv",
                                     "command.csv",        "bent.csv",
                                     "modes.toml",         "actuator.toml",
                                     "once_per_turn.csv",  "surface_location.csv",
                                     "speeds.csv",         "spindle.csv",
                                     "spectrum.csv",       "estimator.csv",
                                     "command.h",          "controller.csv",
                                     "plan.csv",           "moves.csv",
                                     "steps.csv",          "arcs.csv",
                                     "lines.csv",          "feeds.csv",
                                     "measured_steps.csv", "places.csv",
                                     "place_arcs.csv",     "error_map.csv",
                                     "overview.csv",       "passes.csv",
                                     "wall_loads.csv",     "fitted_xx.csv",
                                     "fitted_xy.csv",      "fitted_yx.csv",
                                     "fitted_yy.csv",      "trace.csv",
                                     "runout.toml"});

/// material_2.toml, material_3.toml, ...: of the second group of records and on.
bool is_further_material(std::string_view name) {
  constexpr std::string_view first = "material_";
  constexpr std::string_view last = ".toml";
  if (name.size() <= first.size() + last.size() || !name.starts_with(first) ||
      !name.ends_with(last)) {
    return false;
  }
  const std::string_view number =
      name.substr(first.size(), name.size() - first.size() - last.size());
  return std::all_of(number.begin(), number.end(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

bool is_ours(std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end() ||
         is_further_material(name);
}

bool is_ours_in(const std::filesystem::path& folder, std::string_view name) {
  if (is_ours(name)) return true;
  const auto text = base::read_text(folder / "summary.json");
  if (!text || !is_our_summary(*text)) return false;
  const Value summary = json_value(*text);
  const Value* at = find(summary, "result");
  for (const std::string_view key : {"feed", "file"}) {
    if (at != nullptr) at = find(*at, key);
  }
  return at != nullptr && json_text(*at) == json_text(Value(std::string(name)));
}

bool is_our_summary(std::string_view text) {
  try {
    const Value summary = json_value(text);
    return find(summary, "trochoid") != nullptr;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

bool holds_our_summary(const std::filesystem::path& folder) {
  const auto text = base::read_text(folder / "summary.json");
  return text && is_our_summary(*text);
}

}  // namespace trochoid::results
