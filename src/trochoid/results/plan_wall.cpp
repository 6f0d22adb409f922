#include <trochoid/results/plan_wall.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trochoid::results {

namespace {

using base::add_column;
using surface::GridCell;
using surface::WallPrediction;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double mm3_per_min = 1e-9 / 60.0;

Value told_value(const PlanWallResult& r, const WallPrediction& p) {
  if (!p.told) {
    return nullptr;
  }
  const auto names = force::coefficient_quantities(r.law);
  const std::vector<double> K = force::coefficients(r.law);
  const auto entry = [&](double value, double se, double unit) {
    return Object{{"value", value / unit},
                  {"se", se / unit},
                  {"low", (value - p.factor * se) / unit},
                  {"high", (value + p.factor * se) / unit}};
  };
  Object out;
  set(out, names[0].key, entry(K[0], p.se_K_tc, names[0].unit));
  set(out, names[1].key, entry(K[1], p.se_K_rc, names[1].unit));
  set(out, "eccentricity_mm",
      p.se_eccentricity ? Value(entry(r.eccentricity, *p.se_eccentricity, unit::mm))
                        : Value());
  set(out, "angle_se_deg", p.se_angle ? Value(*p.se_angle / unit::deg) : Value());
  set(out, "correlation", p.correlation);
  set(out, "condition", p.condition);
  return out;
}

Value design_value(const PlanWallResult& r, const PlannedDesign& d) {
  Array heights;
  for (const double h : heights_of(d.design, r.a_p)) {
    heights.emplace_back(unit::in(h, unit::mm));
  }
  return Object{
      {"heights", d.design.heights},       {"readings_per_height", d.design.per_height},
      {"spread", d.design.spread},         {"readings", d.readings},
      {"heights_mm", std::move(heights)},  {"enough", d.enough},
      {"predicted", told_value(r, d.told)}};
}

Value cell_value(const GridCell& cell) {
  return Object{{"feed_per_tooth_mm", unit::in(cell.f_z, unit::mm)},
                {"radial_depth_mm", unit::in(cell.a_e, unit::mm)},
                {"peak_error_um", cell.ok ? Value(cell.peak / unit::um) : Value()},
                {"mean_error_um", cell.ok ? Value(cell.mean / unit::um) : Value()},
                {"removal_rate_mm3_per_min", cell.removal_rate / mm3_per_min}};
}

Value thinnest_value(const PlannedCutting& c) {
  if (!c.thinnest) {
    return nullptr;
  }
  const surface::ThinnestWall& t = *c.thinnest;
  return Object{
      {"thickness_mm", t.thickness ? Value(*t.thickness / unit::mm) : Value()},
      {"error_um", std::isfinite(t.error) ? Value(t.error / unit::um) : Value()},
      {"thinner_too", t.thinner_too}};
}

Value cutting_value(const PlannedCutting& c) {
  Object out{{"limited", c.mean ? "mean" : "peak"},
             {"largest_error_um", c.limit ? Value(*c.limit / unit::um) : Value()},
             {"stated", cell_value(c.stated)},
             {"best", c.best ? cell_value(c.cells[*c.best]) : Value()},
             {"thickness_mm", c.thickness ? Value(*c.thickness / unit::mm) : Value()},
             {"thinnest_wall", thinnest_value(c)}};
  Array limits;
  for (std::size_t i = 0; i < c.feed_limits.size(); ++i) {
    limits.emplace_back(
        Object{{"radial_depth_mm", unit::in(c.radial_depths[i], unit::mm)},
               {"feed_per_tooth_mm",
                c.feed_limits[i] ? Value(*c.feed_limits[i] / unit::mm) : Value()}});
  }
  set(out, "feed_limits", std::move(limits));
  return out;
}

Object result_of(const PlanWallResult& r) {
  Array designs;
  for (const PlannedDesign& d : r.designs) {
    designs.emplace_back(design_value(r, d));
  }
  Array more;
  for (const MoreReadings& m : r.more) {
    more.emplace_back(Object{{"height_mm", unit::in(m.height, unit::mm)},
                             {"predicted", told_value(r, m.told)}});
  }
  Array changes;
  for (const ChangedWall& c : r.changes) {
    changes.emplace_back(Object{{"key", c.key},
                                {"value_mm", unit::in(c.value, unit::mm)},
                                {"predicted", told_value(r, c.told)}});
  }
  return {{"of", "wall"},
          {"chosen", r.chosen ? design_value(r, r.designs[*r.chosen]) : Value()},
          {"so_far", r.so_far ? told_value(r, *r.so_far) : Value()},
          {"readings_so_far", r.measured},
          {"files", r.files},
          {"designs", std::move(designs)},
          {"ten_more_readings", std::move(more)},
          {"changes", std::move(changes)},
          {"cutting", cutting_value(r.cutting)},
          {"form", surface::name_of(r.form)},
          {"noise_um", r.noise / unit::um},
          {"noise_from", r.noise_from},
          {"wanted_percent", 100 * r.wanted},
          {"wanted_um", r.wanted_runout / unit::um},
          {"runout", r.why_no_runout.empty() ? Value() : Value(r.why_no_runout)}};
}

/// Half widths of some rows, in the units of files.
template <class Told>
void add_widths(base::Table& table, const PlanWallResult& r, std::size_t rows,
                const Told& told) {
  const auto names = force::coefficient_quantities(r.law);
  const auto width = [&](std::size_t i, double WallPrediction::*se, double unit) {
    const WallPrediction& p = told(i);
    return p.told ? p.factor * (p.*se) / unit : nothing;
  };
  add_column(
      table, fmt::format("half_width_{}", names[0].key), rows,
      [&](std::size_t i) { return width(i, &WallPrediction::se_K_tc, names[0].unit); });
  add_column(
      table, fmt::format("half_width_{}", names[1].key), rows,
      [&](std::size_t i) { return width(i, &WallPrediction::se_K_rc, names[1].unit); });
  add_column(table, "half_width_eccentricity_mm", rows, [&](std::size_t i) {
    const WallPrediction& p = told(i);
    return p.told && p.se_eccentricity ? p.factor * *p.se_eccentricity / unit::mm
                                       : nothing;
  });
}

base::Table designs_table(const PlanWallResult& r) {
  base::Table table{"plan.csv", {}};
  const std::size_t n = r.designs.size();
  const auto add = [&](const char* name, const auto& value) {
    add_column(table, name, n, [&](std::size_t i) { return value(r.designs[i]); });
  };
  add("heights", [](const PlannedDesign& d) { return d.design.heights; });
  add("readings_per_height",
      [](const PlannedDesign& d) { return d.design.per_height; });
  add("spread", [](const PlannedDesign& d) { return d.design.spread; });
  add("readings", [](const PlannedDesign& d) { return d.readings; });
  add("enough", [](const PlannedDesign& d) { return d.enough ? 1 : 0; });
  add_widths(table, r, n,
             [&](std::size_t i) -> const WallPrediction& { return r.designs[i].told; });
  return table;
}

base::Table error_table(const PlannedCutting& c) {
  base::Table table{"error_map.csv", {}};
  const auto add = [&](const char* name, const auto& value) {
    add_column(table, name, c.cells.size(),
               [&](std::size_t i) { return value(c.cells[i]); });
  };
  add("feed_per_tooth_mm", [](const GridCell& g) { return unit::in(g.f_z, unit::mm); });
  add("radial_depth_mm", [](const GridCell& g) { return unit::in(g.a_e, unit::mm); });
  add("peak_error_um",
      [](const GridCell& g) { return g.ok ? g.peak / unit::um : nothing; });
  add("mean_error_um",
      [](const GridCell& g) { return g.ok ? g.mean / unit::um : nothing; });
  add("removal_rate_mm3_per_min",
      [](const GridCell& g) { return g.removal_rate / mm3_per_min; });
  return table;
}

}  // namespace

Answer answer_of(const PlanWallResult& r) {
  Answer answer{.command = "plan", .heading = r.heading, .result = result_of(r)};
  if (!r.designs.empty()) {
    answer.short_table = wall_plan_table(r);
    answer.tables.push_back(designs_table(r));
  }
  if (!r.cutting.cells.empty()) {
    answer.tables.push_back(error_table(r.cutting));
  }
  return answer;
}

}  // namespace trochoid::results
