#include <trochoid/base/units.h>
#include <trochoid/inputs/number_text.h>
#include <trochoid/inputs/rules.h>

#include <fmt/core.h>

#include <optional>
#include <string>

namespace trochoid::inputs {

namespace {

std::string mm(double length) {
  return number_text(length, unit::mm);
}

/// Places where the loads of a wall are told, and how far they may lie.
struct Places {
  const std::vector<double>& values;
  std::string key;
  double end = 0.0;
  std::string end_key;
};

void check_places(const Places& places, Findings& findings) {
  if (!sound(findings, {"wall." + places.key, "wall." + places.end_key})) {
    return;
  }
  for (std::size_t i = 0; i < places.values.size(); ++i) {
    if (places.values[i] > places.end) {
      report(
          findings, "wall." + places.key,
          fmt::format("wall.{} entry {} = {} mm: beyond {} = {} mm; must be from 0 to "
                      "{} mm (where the deflection under the loads is wanted)",
                      places.key, i + 1, mm(places.values[i]), places.end_key,
                      mm(places.end), mm(places.end)));
    }
  }
}

std::string pass_key(std::size_t i) {
  return fmt::format("pass[{}].radial_depth_mm", i + 1);
}

/// @return the sum of the radial depths, where all of them are sound [m]
std::optional<double> check_depths(const CaseTables& tables, Findings& findings) {
  double sum = 0.0;
  bool all_sound = true;
  for (std::size_t i = 0; i < tables.machine.passes.size(); ++i) {
    const std::string key = pass_key(i);
    const double a_e = tables.machine.passes[i].radial_depth.value_or(
        tables.cut.radial_depth.value_or(0.0));
    sum += a_e;
    if (!sound(findings, {key, "cut.radial_depth_mm", "tool.diameter_mm"})) {
      all_sound = false;
      continue;
    }
    if (i == 0 && tables.machine.passes[i].radial_depth == 0.0) {
      all_sound = false;
      report(findings, key,
             fmt::format("{} = 0 mm: nothing was left before the first pass; must be "
                         "above 0 mm (how much this pass takes off)",
                         key));
    }
    if (a_e > tables.tool.diameter) {
      all_sound = false;
      report(
          findings, key,
          fmt::format("{} = {} mm: more than tool.diameter_mm = {} mm (how much this "
                      "pass takes off)",
                      key, mm(a_e), mm(tables.tool.diameter)));
    }
  }
  return all_sound ? std::optional(sum) : std::nullopt;
}

void check_also_bends(const Surface& surface, Findings& findings) {
  const std::string key = "surface.also_bends";
  if (surface.also_bends.empty() ||
      !sound(findings, {key, "surface.feedback", "surface.load"})) {
    return;
  }
  if (surface.feedback != surface::Feedback::none) {
    report(findings, key,
           fmt::format("surface.also_bends: only with feedback = \"none\", here it is "
                       "\"{}\"; how these forces act back on the chip is not computed",
                       name_of(surface.feedback)));
  }
  if (surface.load != surface::Load::distributed) {
    report(
        findings, key,
        fmt::format("surface.also_bends: only with load = \"distributed\", here it is "
                    "\"{}\"; lever arms belong to the place of each piece of an edge",
                    name_of(surface.load)));
  }
}

}  // namespace

void check_wall_loads(const Wall& wall, Findings& findings) {
  check_places({wall.loads_x, "loads_x_mm", wall.length, "length_mm"}, findings);
  check_places({wall.loads_heights, "loads_heights_mm", wall.height, "height_mm"},
               findings);
  const bool loaded = wall.pressure || wall.edge_load || wall.line_load;
  for (const std::string key : {"wall.loads_x_mm", "wall.loads_heights_mm"}) {
    if (!loaded && findings.places.count(key) > 0 && sound(findings, {"wall"})) {
      report(
          findings, key,
          fmt::format("{}: no load is given; must come with pressure_kPa, "
                      "edge_load_N_per_mm or line_load_N_per_mm (where the deflection "
                      "under the loads is wanted)",
                      key));
    }
  }
}

void check_passes(const CaseTables& tables, Findings& findings) {
  const MachineTables& m = tables.machine;
  if (m.surface) {
    check_also_bends(*m.surface, findings);
  }
  if (m.passes.empty()) {
    return;
  }
  const std::optional<double> sum = check_depths(tables, findings);
  if (sum && m.wall && sound(findings, {"wall.thickness_mm"}) &&
      *sum >= m.wall->thickness) {
    report(
        findings, "pass[1]",
        fmt::format("[[pass]]: {} passes take off {} mm, and wall.thickness_mm = {} mm "
                    "before the first; must leave some of it",
                    m.passes.size(), mm(*sum), mm(m.wall->thickness)));
  }
  if (m.surface && m.surface->model == surface::Model::quasi_static &&
      sound(findings, {"surface.model"})) {
    report(findings, "surface.model",
           "surface.model = \"quasi_static\": a pulse of force is no surface that the "
           "next pass could meet; must be \"imprint\" or \"envelope\" with [[pass]]");
  }
}

void refuse_for_calibrate(const MachineTables& machine, Findings& findings) {
  if (!machine.passes.empty()) {
    report(
        findings, "pass[1]",
        "[[pass]]: calibrate reads the wall that one pass left; must be left out, and "
        "[wall] thickness_mm be that before the measured pass");
  }
  if (machine.surface && !machine.surface->also_bends.empty() &&
      sound(findings, {"surface.also_bends"})) {
    report(
        findings, "surface.also_bends",
        "surface.also_bends: calibrate takes in the force across the wall only; must "
        "be left out (forces that bend cutter and wall as well)");
  }
}

}  // namespace trochoid::inputs
