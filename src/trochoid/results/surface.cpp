#include <trochoid/results/surface_parts.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::results {

namespace {

using base::add_column;
using surface::DeflectedShape;
using surface::ErrorMap;
using surface::ErrorRow;
using surface::ForceSample;

/// One point of one row of the map.
struct Place {
  const ErrorRow* row;
  std::size_t i;
};

base::Table surface_table(const ErrorMap& map) {
  std::vector<Place> places;
  for (const ErrorRow& row : map.rows) {
    for (std::size_t i = 0; i < row.x.size(); ++i) {
      places.push_back({&row, i});
    }
  }
  base::Table table{"surface.csv", {}};
  const std::size_t n = places.size();
  const auto add = [&](const char* name, const auto& value) {
    add_column(table, name, n,
               [&](std::size_t i) { return value(*places[i].row, places[i].i); });
  };
  add("x_mm",
      [](const ErrorRow& r, std::size_t i) { return unit::in(r.x[i], unit::mm); });
  add("height_mm",
      [](const ErrorRow& r, std::size_t) { return unit::in(r.height, unit::mm); });
  add("error_mm",
      [](const ErrorRow& r, std::size_t i) { return r.error[i] / unit::mm; });
  add("tooth", [](const ErrorRow& r, std::size_t i) { return r.tooth[i] + 1; });
  return table;
}

base::Table force_table(const ErrorMap& map) {
  base::Table table{"forces.csv", {}};
  const auto add = [&](const char* name, const auto& value) {
    add_column(table, name, map.forces.size(),
               [&](std::size_t i) { return value(map.forces[i]); });
  };
  add("angle_deg", [](const ForceSample& f) { return unit::in(f.phi, unit::deg); });
  add("x_mm", [](const ForceSample& f) { return unit::in(f.x, unit::mm); });
  add("F_normal_N", [](const ForceSample& f) { return f.F_normal; });
  add("Fx_N", [](const ForceSample& f) { return f.F_x; });
  add("Fy_N", [](const ForceSample& f) { return f.F_y; });
  return table;
}

base::Table deflection_table(const ErrorMap& map) {
  base::Table table{"deflection.csv", {}};
  const std::size_t angles = map.forces.size();
  const std::size_t n = map.rows.size() * angles;
  add_column(table, "angle_deg", n, [&](std::size_t i) {
    return unit::in(map.forces[i % angles].phi, unit::deg);
  });
  add_column(table, "height_mm", n, [&](std::size_t i) {
    return unit::in(map.rows[i / angles].height, unit::mm);
  });
  add_column(table, "deflection_mm", n, [&](std::size_t i) {
    return map.rows[i / angles].deflection[i % angles] / unit::mm;
  });
  return table;
}

base::Table influence_table(const ErrorMap& map) {
  base::Table table{"influence.csv", {}};
  const std::vector<double>& heights = map.influence_heights;
  const std::size_t n = heights.size() * heights.size();
  add_column(table, "height_mm", n, [&](std::size_t i) {
    return unit::in(heights[i / heights.size()], unit::mm);
  });
  add_column(table, "load_height_mm", n, [&](std::size_t i) {
    return unit::in(heights[i % heights.size()], unit::mm);
  });
  add_column(table, "cutter_mm_per_N", n,
             [&](std::size_t i) { return map.influence_of_cutter[i] / unit::mm; });
  add_column(table, "wall_mm_per_N", n,
             [&](std::size_t i) { return map.influence_of_wall[i] / unit::mm; });
  return table;
}

/// bent.csv: 0 where a body does not reach.
base::Table shape_table(const DeflectedShape& shape) {
  base::Table table{"bent.csv", {}};
  const std::size_t n = shape.heights.size();
  add_column(table, "height_mm", n,
             [&](std::size_t i) { return unit::in(shape.heights[i], unit::mm); });
  add_column(table, "cutter_mm", n,
             [&](std::size_t i) { return shape.cutter[i] / unit::mm; });
  add_column(table, "wall_mm", n,
             [&](std::size_t i) { return shape.wall[i] / unit::mm; });
  return table;
}

Object height_value(const ErrorRow& row) {
  const surface::ErrorStatistics& s = row.statistics;
  Object value{{"height_mm", unit::in(row.height, unit::mm)},
               {"mean_error_mm", s.error.mean / unit::mm},
               {"min_error_mm", s.error.min / unit::mm},
               {"max_error_mm", s.error.max / unit::mm},
               {"Ra_um", s.Ra / unit::um},
               {"Rt_um", (s.error.max - s.error.min) / unit::um},
               {"share", s.share},
               {"compliance_mm_per_N", row.compliance / unit::mm}};
  if (row.waves) {
    value.push_back({"once_per_turn_um", row.waves->once_per_turn / unit::um});
    value.push_back({"once_per_tooth_um", row.waves->once_per_tooth / unit::um});
  }
  if (row.per_K) {
    const auto& [by_K_tc, by_K_rc] = *row.per_K;
    value.push_back(
        {"operator", Object{{"K_tc_mm_per_MPa", by_K_tc * unit::MPa / unit::mm},
                            {"K_rc_mm_per_MPa", by_K_rc * unit::MPa / unit::mm}}});
  }
  return value;
}

/// What bent.csv shows, and the bodies that it is drawn on: the wall up to the cut.
Object shape_value(const SurfaceResult& r) {
  const double below = r.passes.empty() ? 0.0 : r.passes.back().cut.below;
  Object value{{"angle_deg", unit::in(r.map.shape->phi, unit::deg)},
               {"F_normal_N", r.map.shape->F_normal},
               {"cutter", nullptr},
               {"wall", nullptr}};
  if (r.cutter) {
    set(value, "cutter",
        Object{{"diameter_mm", unit::in(r.diameter, unit::mm)},
               {"shank_diameter_mm", unit::in(r.cutter->shank_diameter, unit::mm)},
               {"flute_length_mm", unit::in(r.cutter->flute_length, unit::mm)},
               {"overhang_mm", unit::in(r.cutter->overhang, unit::mm)}});
  }
  if (r.wall) {
    set(value, "wall",
        Object{{"height_mm", unit::in(r.wall->height - below, unit::mm)},
               {"thickness_mm", unit::in(r.wall->thickness, unit::mm)},
               {"edge_height_mm", unit::in(r.a_p, unit::mm)}});
  }
  return value;
}

Object result_of(const SurfaceResult& r) {
  const ErrorMap& map = r.map;
  Object result{{"model", surface::name_of(map.model)},
                {"feedback", surface::name_of(map.feedback)}};
  if (!map.converged) {
    return result;
  }
  const auto add = [&](const char* key, Value value) {
    result.push_back({key, std::move(value)});
  };
  Array heights;
  for (const ErrorRow& row : map.rows) {
    heights.push_back(height_value(row));
  }
  add("mean_error_mm", map.error.mean / unit::mm);
  add("peak_error_mm", map.error.max / unit::mm);
  add("min_error_mm", map.error.min / unit::mm);
  add("forces", Object{{"F_normal_mean_N", map.F_normal.mean},
                       {"F_normal_min_N", map.F_normal.min},
                       {"F_normal_max_N", map.F_normal.max},
                       {"Fx_mean_N", map.F_x.mean},
                       {"Fx_min_N", map.F_x.min},
                       {"Fx_max_N", map.F_x.max}});
  add("compliance_mm_per_N", map.rows.front().compliance / unit::mm);
  add("turns_to_repeat", map.turns);
  add("heights", std::move(heights));
  if (map.shape) {
    add("bent", shape_value(r));
  }
  add_surface_parts(r, result);
  return result;
}

/// Else it might print as -0.00.
double newtons(double force) {
  return std::abs(force) < 0.005 ? 0.0 : force;
}

/// About ten of the heights, and what acts on them.
std::string short_table(const SurfaceResult& r) {
  const ErrorMap& map = r.map;
  std::string text = fmt::format(
      "error of the wall, positive: material left   (model {}, feedback {})\n"
      "  {:>10} {:>12} {:>12} {:>12} {:>9}\n",
      surface::name_of(map.model), surface::name_of(map.feedback), "height mm",
      "mean um", "least um", "largest um", "Ra um");
  const std::size_t every = std::max<std::size_t>(1, map.rows.size() / 10);
  for (std::size_t i = 0; i < map.rows.size(); i += every) {
    const surface::ErrorStatistics& s = map.rows[i].statistics;
    text +=
        fmt::format("  {:>10.3f} {:>12.3f} {:>12.3f} {:>12.3f} {:>9.3f}\n",
                    unit::in(map.rows[i].height, unit::mm), s.error.mean / unit::um,
                    s.error.min / unit::um, s.error.max / unit::um, s.Ra / unit::um);
  }
  text += fmt::format(
      "force across the wall: {:.2f} N mean, {:.2f} to {:.2f} N (positive: pushes "
      "cutter and wall apart)\n",
      newtons(map.F_normal.mean), newtons(map.F_normal.min), newtons(map.F_normal.max));
  text += fmt::format("compliance at {:g} mm for the whole force: {:.4g} um/N{}{}\n",
                      unit::in(map.rows.front().height, unit::mm),
                      map.rows.front().compliance / unit::um,
                      r.cutter ? "" : " (rigid cutter)", r.wall ? "" : " (rigid wall)");
  return text + surface_parts_text(r);
}

}  // namespace

Answer answer_of(const SurfaceResult& r) {
  Answer answer{.command = "surface", .heading = r.heading, .result = result_of(r)};
  if (!r.map.converged) {
    return answer;
  }
  answer.short_table = short_table(r);
  answer.tables = {surface_table(r.map), force_table(r.map), deflection_table(r.map),
                   influence_table(r.map)};
  if (r.map.shape) {
    answer.tables.push_back(shape_table(*r.map.shape));
  }
  add_surface_tables(r, answer.tables);
  return answer;
}

}  // namespace trochoid::results
