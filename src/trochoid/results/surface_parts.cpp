#include <trochoid/base/units.h>
#include <trochoid/results/surface_parts.h>

#include <fmt/core.h>

namespace trochoid::results {

namespace {

using base::add_column;
using structure::LoadedWall;
using structure::WallLoad;
using surface::PassOutcome;

/// A number of a pass: its name in files, and itself in that unit.
struct PassColumn {
  const char* name;
  double (*value)(const PassOutcome& p);
};

constexpr PassColumn pass_columns[] = {
    {"radial_depth_mm",
     [](const PassOutcome& p) { return unit::in(p.cut.a_e, unit::mm); }},
    {"feed_per_tooth_mm",
     [](const PassOutcome& p) { return unit::in(p.cut.f_z, unit::mm); }},
    {"below_edge_mm",
     [](const PassOutcome& p) { return unit::in(p.cut.below, unit::mm); }},
    {"stock_min_mm",
     [](const PassOutcome& p) { return p.radial_depth.min / unit::mm; }},
    {"stock_mean_mm",
     [](const PassOutcome& p) { return p.radial_depth.mean / unit::mm; }},
    {"stock_max_mm",
     [](const PassOutcome& p) { return p.radial_depth.max / unit::mm; }},
    {"mean_error_mm", [](const PassOutcome& p) { return p.error.mean / unit::mm; }},
    {"min_error_mm", [](const PassOutcome& p) { return p.error.min / unit::mm; }},
    {"peak_error_mm", [](const PassOutcome& p) { return p.error.max / unit::mm; }},
    {"F_normal_mean_N", [](const PassOutcome& p) { return p.F_normal.mean; }},
    {"F_normal_max_N", [](const PassOutcome& p) { return p.F_normal.max; }},
};
constexpr PassColumn thickness_columns[] = {
    {"thickness_before_mm",
     [](const PassOutcome& p) { return unit::in(p.thickness_before, unit::mm); }},
    {"thickness_left_mm",
     [](const PassOutcome& p) { return p.thickness_after / unit::mm; }},
};

base::Table pass_table(const SurfaceResult& r) {
  base::Table table{"passes.csv", {}};
  const std::size_t n = r.passes.size();
  add_column(table, "pass", n,
             [](std::size_t i) { return static_cast<double>(i + 1); });
  const auto add = [&](const PassColumn& column) {
    add_column(table, column.name, n,
               [&](std::size_t i) { return column.value(r.passes[i]); });
  };
  for (const PassColumn& column : pass_columns) {
    add(column);
  }
  for (const PassColumn& column : thickness_columns) {
    if (r.wall) {
      add(column);
    }
  }
  return table;
}

Array passes_value(const SurfaceResult& r) {
  Array all;
  for (const PassOutcome& pass : r.passes) {
    Object one;
    for (const PassColumn& column : pass_columns) {
      one.push_back({column.name, column.value(pass)});
    }
    for (const PassColumn& column : thickness_columns) {
      one.push_back({column.name, r.wall ? Value(column.value(pass)) : Value()});
    }
    all.emplace_back(std::move(one));
  }
  return all;
}

/// The unit of a load in files.
double unit_of(WallLoad load) {
  return load == WallLoad::pressure ? unit::kPa : unit::N_per_mm;
}

std::string key_of(WallLoad load) {
  return fmt::format("{}_{}", name_of(load),
                     load == WallLoad::pressure ? "kPa" : "N_per_mm");
}

/// What B-11 calls the number of handbooks, in letters.
const char* coefficient_words(WallLoad load) {
  switch (load) {
    case WallLoad::pressure:
      return "w D/(p a^4)";
    case WallLoad::edge_load:
      return "w D/(q b^3)";
    case WallLoad::line_load:
      return "w D/(F b^2)";
  }
  return "";
}

base::Table loads_table(const structure::LoadedWalls& loads) {
  base::Table table{"wall_loads.csv", {}};
  const std::size_t rows = loads.y.size();
  const std::size_t n = loads.x.size() * rows;
  add_column(table, "x_mm", n,
             [&](std::size_t i) { return unit::in(loads.x[i / rows], unit::mm); });
  add_column(table, "wall_height_mm", n,
             [&](std::size_t i) { return unit::in(loads.y[i % rows], unit::mm); });
  for (const LoadedWall& wall : loads.walls) {
    add_column(table, fmt::format("{}_deflection_mm", name_of(wall.load)), n,
               [&](std::size_t i) { return wall.w[i] / unit::mm; });
  }
  return table;
}

Object loads_value(const structure::LoadedWalls& loads) {
  Object all;
  for (const LoadedWall& wall : loads.walls) {
    all.push_back({std::string(name_of(wall.load)),
                   Object{{key_of(wall.load), unit::in(wall.size, unit_of(wall.load))},
                          {"largest_deflection_mm", wall.largest / unit::mm},
                          {"x_mm", unit::in(wall.x, unit::mm)},
                          {"wall_height_mm", unit::in(wall.y, unit::mm)},
                          {"coefficient", wall.coefficient},
                          {"coefficient_is", coefficient_words(wall.load)}}});
  }
  return all;
}

Array axes_of(const SurfaceResult& r) {
  Array axes;
  for (const surface::AlsoBends axis : r.also_bends) {
    axes.emplace_back(name_of(axis));
  }
  return axes;
}

std::string pass_text(const SurfaceResult& r) {
  std::string text =
      fmt::format("{:>6} {:>10} {:>12} {:>12} {:>12} {:>14}\n", "pass", "stock mm",
                  "mean um", "largest um", "peak N", r.wall ? "thickness mm" : "");
  for (std::size_t i = 0; i < r.passes.size(); ++i) {
    const PassOutcome& p = r.passes[i];
    text += fmt::format("{:>6} {:>10.4f} {:>12.3f} {:>12.3f} {:>12.2f}", i + 1,
                        p.radial_depth.mean / unit::mm, p.error.mean / unit::um,
                        p.error.max / unit::um, p.F_normal.max);
    text += r.wall ? fmt::format(" {:>14.4f}\n", p.thickness_after / unit::mm) : "\n";
  }
  return text;
}

}  // namespace

void add_surface_parts(const SurfaceResult& r, Object& result) {
  if (!r.passes.empty()) {
    result.push_back({"passes", passes_value(r)});
  }
  if (r.straight) {
    result.push_back(
        {"also_bends",
         Object{{"axes", axes_of(r)},
                {"mean_error_without_mm", r.straight->mean / unit::mm},
                {"peak_error_without_mm", r.straight->max / unit::mm},
                {"mean_change_um", (r.map.error.mean - r.straight->mean) / unit::um},
                {"peak_change_um", (r.map.error.max - r.straight->max) / unit::um}}});
  }
  if (r.loads) {
    result.push_back({"wall_loads", loads_value(*r.loads)});
  }
}

void add_surface_tables(const SurfaceResult& r, std::vector<base::Table>& tables) {
  if (!r.passes.empty()) {
    tables.push_back(pass_table(r));
  }
  if (r.loads) {
    tables.push_back(loads_table(*r.loads));
  }
}

std::string surface_parts_text(const SurfaceResult& r) {
  std::string text = r.passes.empty() ? "" : pass_text(r);
  if (r.straight) {
    text += fmt::format(
        "forces along {} change the mean error by {:+.3f} um, the largest by {:+.3f} um\n",
        r.also_bends.size() == 2                        ? "x and z"
        : r.also_bends.front() == surface::AlsoBends::x ? "x"
                                                        : "z",
        (r.map.error.mean - r.straight->mean) / unit::um,
        (r.map.error.max - r.straight->max) / unit::um);
  }
  for (std::size_t i = 0; r.loads && i < r.loads->walls.size(); ++i) {
    const LoadedWall& wall = r.loads->walls[i];
    text += fmt::format(
        "{} of {:g}: {:.5g} mm at x = {:g} mm, {:g} mm above the foot   {} = {:.6g}\n",
        key_of(wall.load), unit::in(wall.size, unit_of(wall.load)),
        wall.largest / unit::mm, unit::in(wall.x, unit::mm), unit::in(wall.y, unit::mm),
        coefficient_words(wall.load), wall.coefficient);
  }
  return text;
}

}  // namespace trochoid::results
