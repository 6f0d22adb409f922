#include <trochoid/base/units.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace trochoid::cases {

namespace {

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

std::string pass_key(std::size_t i, std::string_view key) {
  return fmt::format("pass[{}].{}", i + 1, key);
}

double below_of(const WallPass& pass) {
  return pass.below_edge.value_or(0.0);
}

/// Is a pass the first one at its level?
bool first_there(const std::vector<WallPass>& passes, std::size_t i) {
  return std::none_of(
      passes.begin(), passes.begin() + static_cast<std::ptrdiff_t>(i),
      [&](const WallPass& before) { return below_of(before) == below_of(passes[i]); });
}

void check_depth(const CaseTables& tables, std::size_t i, Findings& findings) {
  const std::vector<WallPass>& passes = tables.machine.passes;
  const std::string key = pass_key(i, "radial_depth_mm");
  const double a_e = passes[i].radial_depth.value_or(0.0);
  if (!passes[i].radial_depth || !sound(findings, {key, "tool.diameter_mm"})) {
    return;
  }
  if (a_e == 0 && first_there(passes, i)) {
    report(findings, key,
           fmt::format("{} = 0 mm: nothing was left before the first pass{}; must be "
                       "above 0 mm (how much this pass takes off)",
                       key, below_of(passes[i]) > 0 ? " at this level" : ""));
  }
  if (a_e > tables.tool.diameter) {
    report(findings, key,
           fmt::format("{} = {} mm: more than tool.diameter_mm = {} mm (how much this "
                       "pass takes off)",
                       key, mm(a_e), mm(tables.tool.diameter)));
  }
}

/// On the wall, and either over a level of before or beside all of them.
void check_level(const CaseTables& tables, std::size_t i, Findings& findings) {
  const std::vector<WallPass>& passes = tables.machine.passes;
  const std::string key = pass_key(i, "below_edge_mm");
  const double a_p = tables.cut.axial_depth;
  const double below = below_of(passes[i]);
  if (!sound(findings, {key, "cut.axial_depth_mm", "wall.height_mm"})) {
    return;
  }
  constexpr double rounding = 1e-9 * unit::mm;
  const auto& wall = tables.machine.wall;
  if (below > 0 && wall && below + a_p > wall->height + rounding) {
    report(
        findings, key,
        fmt::format("{} = {} mm: with cut.axial_depth_mm = {} mm it would reach below "
                    "wall.height_mm = {} mm; must be at most {} mm",
                    key, mm(below), mm(a_p), mm(wall->height),
                    mm(std::max(0.0, wall->height - a_p))));
  }
  for (std::size_t k = 0; k < i; ++k) {
    const double apart = std::abs(below - below_of(passes[k]));
    if (apart > 0 && apart < a_p - rounding) {
      report(
          findings, key,
          fmt::format("{} = {} mm: overlaps pass {} at {} mm in part; must be the same "
                      "or differ by at least cut.axial_depth_mm = {} mm",
                      key, mm(below), k + 1, mm(below_of(passes[k])), mm(a_p)));
      return;
    }
  }
}

/// No level may lose its whole thickness.
void check_thickness(const CaseTables& tables, Findings& findings) {
  const std::vector<WallPass>& passes = tables.machine.passes;
  if (!tables.machine.wall ||
      !sound(findings, {"wall.thickness_mm", "cut.radial_depth_mm"})) {
    return;
  }
  for (std::size_t i = 0; i < passes.size(); ++i) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const WallPass& pass : passes) {
      if (below_of(pass) == below_of(passes[i])) {
        sum += pass.radial_depth.value_or(tables.cut.radial_depth.value_or(0.0));
        ++count;
      }
    }
    if (first_there(passes, i) && sum >= tables.machine.wall->thickness) {
      report(findings, fmt::format("pass[{}]", i + 1),
             fmt::format(
                 "[[pass]]: {} passes take off {} mm{}, and wall.thickness_mm = {} "
                 "mm before the first; must leave some of it",
                 count, mm(sum),
                 below_of(passes[i]) > 0
                     ? fmt::format(" at {} mm below the edge", mm(below_of(passes[i])))
                     : "",
                 mm(tables.machine.wall->thickness)));
    }
  }
}

void check_also_bends(const Surface& surface, Findings& findings) {
  const std::string key = "surface.also_bends";
  if (surface.also_bends.empty() ||
      !sound(findings, {key, "surface.feedback", "surface.load"})) {
    return;
  }
  if (surface.feedback.value_or(surface::Feedback::none) != surface::Feedback::none) {
    report(findings, key,
           fmt::format("surface.also_bends: only with feedback = \"none\", here it is "
                       "\"{}\"; how these forces act back on the chip is not computed",
                       name_of(*surface.feedback)));
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

/// What is shorter than a tenth of its thickness is no plate.
void check_plate(const CaseTables& tables, Findings& findings) {
  constexpr double least = 0.1;
  if (!tables.machine.wall || !sound(findings, {"wall.thickness_mm"})) {
    return;
  }
  const auto& wall = *tables.machine.wall;
  for (const auto& [name, size] :
       {std::pair("length_mm", wall.length), std::pair("height_mm", wall.height)}) {
    const std::string key = std::string("wall.") + name;
    if (size < least * wall.thickness && sound(findings, {key})) {
      report(findings, key,
             fmt::format("{} = {} mm: less than a tenth of thickness_mm = {} mm, no "
                         "plate; must be at least {:.6g} mm",
                         key, mm(size), mm(wall.thickness),
                         least * wall.thickness / unit::mm));
    }
  }
}

void check_passes(const CaseTables& tables, Findings& findings) {
  const MachineTables& m = tables.machine;
  check_plate(tables, findings);
  if (m.surface) {
    check_also_bends(*m.surface, findings);
  }
  if (m.passes.empty()) {
    return;
  }
  bool all_sound = true;
  for (std::size_t i = 0; i < m.passes.size(); ++i) {
    check_depth(tables, i, findings);
    check_level(tables, i, findings);
    all_sound = all_sound && sound(findings, {pass_key(i, "radial_depth_mm"),
                                              pass_key(i, "below_edge_mm")});
  }
  if (all_sound) {
    check_thickness(tables, findings);
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

}  // namespace trochoid::cases
