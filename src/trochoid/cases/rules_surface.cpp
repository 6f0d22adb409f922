#include <trochoid/base/units.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::cases {

namespace {

/// The value of a key as the file would have it.
template <class Table>
std::string shown_choice(Table& table, std::string_view key) {
  std::string text;
  describe(
      [&](const Key& k, const Field& field) {
        if (k.name == key) {
          text = toml_text(k, field).value_or("");
        }
      },
      table);
  return text;
}

/// A list of heights above the tip, and what they may reach.
struct Heights {
  const std::vector<double>& values;
  std::string key;
  double highest = 0.0;
  std::string highest_key;  ///< as the message names it
  std::string meaning;
};

void check_heights(const Heights& heights, Findings& findings) {
  if (!sound(findings, {heights.key})) {
    return;
  }
  for (std::size_t i = 0; i < heights.values.size(); ++i) {
    const double height = heights.values[i];
    const auto entry = [&](const std::string& why) {
      report(findings, heights.key,
             fmt::format("{} entry {} = {} mm: {} ({})", heights.key, i + 1, mm(height),
                         why, heights.meaning));
    };
    const auto* const begin = heights.values.data();
    const auto* const same = std::find(begin, begin + i, height);
    if (height > heights.highest) {
      entry(fmt::format("above {} = {} mm; must be from 0 to {} mm",
                        heights.highest_key, mm(heights.highest), mm(heights.highest)));
    } else if (same != begin + i) {
      entry(fmt::format("entry {} is the same; must be there once", same - begin + 1));
    }
  }
}

void check_depth_below(double limit, const std::string& limit_key,
                       const std::string& then, const CutTable& cut,
                       Findings& findings) {
  if (!sound(findings, {"cut.axial_depth_mm", limit_key}) || cut.axial_depth <= limit) {
    return;
  }
  report(findings, "cut.axial_depth_mm",
         fmt::format("cut.axial_depth_mm = {} mm: more than {} = {} mm, so {}; must be "
                     "at most {} mm (axial depth of cut)",
                     mm(cut.axial_depth), limit_key, mm(limit), then, mm(limit)));
}

/// Lines of the floor that the teeth sweep.
void check_floor_lines(const CaseTables& tables, Findings& findings) {
  const std::string key = "surface.floor_y_mm";
  if (!sound(findings, {key, "tool.diameter_mm"})) return;
  const double radius = tables.tool.diameter / 2;
  const auto& lines = tables.machine.surface->floor_y;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (std::abs(lines[i]) < radius) continue;
    report(findings, key,
           fmt::format(
               "{} entry {} = {} mm: beside the tool, which reaches to {} mm; must "
               "be between -{} and {} mm (lines of the floor)",
               key, i + 1, mm(lines[i]), mm(radius), mm(radius), mm(radius)));
  }
}

void check_feed(const CutTable& cut, std::string_view verb, Findings& findings) {
  const std::string per_tooth = "cut.feed_per_tooth_mm";
  const std::string rate = "cut.feed_rate_mm_per_min";
  if (cut.feed_per_tooth != 0.0 || !sound(findings, {per_tooth, rate})) {
    return;
  }
  const bool by_tooth = findings.places.count(per_tooth) > 0;
  report(findings, by_tooth ? per_tooth : rate,
         fmt::format("{} = 0 {}: nothing is cut, and {} is about the wall that is cut; "
                     "must be a number above 0 {} ({})",
                     by_tooth ? per_tooth : rate, by_tooth ? "mm" : "mm/min", verb,
                     by_tooth ? "mm" : "mm/min",
                     by_tooth ? "feed per tooth" : "feed rate"));
}

}  // namespace

bool is_finish(const MachineTables& machine) {
  return std::ranges::any_of(machine.surface_measurements,
                             [](const auto& m) { return m.of == MeasuredOf::finish; });
}

namespace {

/// Where one trace lies.
void check_trace(CaseTables& tables, std::size_t number, Findings& findings) {
  const SurfaceMeasurement& m = tables.machine.surface_measurements[number - 1];
  const std::string path = fmt::format("surface_measurement[{}].", number);
  if (m.of != MeasuredOf::finish) {
    report(
        findings, path + "of",
        fmt::format("{}of = \"wall\": another one is of a finish; must be the same for "
                    "all (a wall and a finish are two cases)",
                    path));
    return;
  }
  if (m.floor_y.has_value() == m.source.height.has_value()) {
    report(
        findings, m.floor_y ? path + "height_mm" : path + "file",
        fmt::format("surface_measurement[{}]: {} of floor_y_mm and height_mm; must be "
                    "one: floor_y_mm of a trace on the floor, height_mm of one on the "
                    "wall",
                    number, m.floor_y ? "both" : "neither"));
    return;
  }
  const double radius = tables.tool.diameter / 2;
  if (m.floor_y && sound(findings, {path + "floor_y_mm", "tool.diameter_mm"}) &&
      std::abs(*m.floor_y) >= radius) {
    report(findings, path + "floor_y_mm",
           fmt::format("{}floor_y_mm = {} mm: beside the tool, which reaches to {} mm; "
                       "must be between -{} and {} mm",
                       path, mm(*m.floor_y), mm(radius), mm(radius), mm(radius)));
  }
  const auto engagement = tables.cut.engagement;
  if (!m.floor_y && engagement != EngagementKind::up &&
      engagement != EngagementKind::down && sound(findings, {"cut.engagement"})) {
    report(
        findings, "cut.engagement",
        fmt::format("cut.engagement = {}: leaves no single finished wall; must be "
                    "\"up\" or \"down\" for a trace on the wall (floor_y_mm says that "
                    "it is on the floor)",
                    shown_choice(tables.cut, "engagement")));
  }
  if (m.source.frame) {
    report(findings, path + "frame",
           fmt::format("{}frame: a trace has a place along the feed and a height only; "
                       "must be left out",
                       path));
  }
}

}  // namespace

void check_finish(CaseTables& tables, Findings& findings) {
  if (!tables.machine.surface && sound(findings, {"surface"})) {
    tables.machine.surface.emplace();
  }
  check_feed(tables.cut, "calibrate", findings);
  for (std::size_t i = 0; i < tables.machine.surface_measurements.size(); ++i) {
    check_trace(tables, i + 1, findings);
  }
}

bool is_floor_only(const CaseTables& tables, std::string_view verb) {
  const auto& surface = tables.machine.surface;
  return verb == "surface" && surface && !surface->floor_y.empty() &&
         surface->heights.empty();
}

void check_wall_cut(CaseTables& tables, std::string_view verb, Findings& findings) {
  if (!tables.machine.surface && sound(findings, {"surface"})) {
    tables.machine.surface.emplace();
  }
  if (is_floor_only(tables, verb)) {
    check_feed(tables.cut, verb, findings);
    return;
  }
  const bool rigid = !tables.machine.cutter_body && !tables.machine.wall;
  const bool any_shape = rigid && verb == "surface";
  if (tables.tool.shape != Shape::cylinder && !any_shape &&
      sound(findings, {"tool.shape"})) {
    report(findings, "tool.shape",
           fmt::format("tool.shape = {}: {} knows the wall of a cylinder only; must be "
                       "\"cylinder\" (shape of the cutter)",
                       shown_choice(tables.tool, "shape"), verb));
  }
  const auto engagement = tables.cut.engagement;
  if (engagement != EngagementKind::up && engagement != EngagementKind::down &&
      sound(findings, {"cut.engagement"})) {
    report(findings, "cut.engagement",
           fmt::format("cut.engagement = {}: leaves no single finished wall, which {} "
                       "is about; must be \"up\" or \"down\" (which part of the "
                       "cutter's width is in the stock)",
                       shown_choice(tables.cut, "engagement"), verb));
  }
  check_feed(tables.cut, verb, findings);
  if (verb != "surface" && rigid && sound(findings, {"cutter_body", "wall"})) {
    report(findings, "cutter_body",
           fmt::format("[cutter_body] and [wall] are missing: nothing bends, so the "
                       "wall tells nothing of the forces; {} needs one of them",
                       verb));
  }
  if (verb == "calibrate") {
    refuse_for_calibrate(tables.machine, findings);
  }
}

void check_surface(CaseTables& tables, Findings& findings) {
  MachineTables& m = tables.machine;
  if (m.cutter_body && m.cutter_body->flute_length) {
    check_depth_below(*m.cutter_body->flute_length, "cutter_body.flute_length_mm",
                      "the shank would be in the cut", tables.cut, findings);
  }
  if (m.wall) {
    check_depth_below(m.wall->height, "wall.height_mm", "it would reach below the wall",
                      tables.cut, findings);
  }
  check_passes(tables, findings);
  if (!m.surface) {
    return;
  }
  const bool stand_in = m.surface->heights.empty() && m.surface->floor_y.empty() &&
                        sound(findings, {"surface"});
  if (stand_in) {
    m.surface->heights = tables.sampling.edge_heights;
  }
  if (sound(findings, {"cut.axial_depth_mm"})) {
    check_heights({m.surface->heights,
                   stand_in ? "sampling.edge_heights_mm" : "surface.heights_mm",
                   tables.cut.axial_depth, "axial_depth_mm",
                   "heights above the tip where the surface is wanted"},
                  findings);
  }
  check_floor_lines(tables, findings);
  if (m.cutter_body && sound(findings, {"cutter_body.overhang_mm"})) {
    check_heights({m.surface->influence_heights, "surface.influence_heights_mm",
                   m.cutter_body->overhang, "overhang_mm",
                   "heights above the tip for influence.csv"},
                  findings);
  }
}

}  // namespace trochoid::cases
