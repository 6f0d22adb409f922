#include <trochoid/base/units.h>
#include <trochoid/results/surface_parts.h>

#include <fmt/core.h>

namespace trochoid::results {

namespace {

using base::add_column;
using structure::LoadedWall;
using structure::WallLoad;
using surface::PassOutcome;

/// A pass, and whether the wall bends.
struct PassOfWall {
  const PassOutcome& pass;
  bool bends;
};

const Fields<PassOfWall>& pass_fields() {
  using Of = const PassOfWall&;
  static const Fields<PassOfWall> all{
      {"radial_depth_mm", "as asked for", [](Of p) { return given(p.pass.cut.a_e); }},
      {"feed_per_tooth_mm", "as asked for", [](Of p) { return given(p.pass.cut.f_z); }},
      {"below_edge_mm", "how deep below the free edge of the wall",
       [](Of p) { return given(p.pass.cut.below); }},
      {"stock_min_mm",
       "smallest radial depth with what the pass before left, over the "
       "heights",
       [](Of p) { return p.pass.radial_depth.min; }},
      {"stock_mean_mm", "its mean", [](Of p) { return p.pass.radial_depth.mean; }},
      {"stock_max_mm", "its largest", [](Of p) { return p.pass.radial_depth.max; }},
      {"mean_error_mm", "error that it leaves", [](Of p) { return p.pass.error.mean; }},
      {"min_error_mm", "the smallest", [](Of p) { return p.pass.error.min; }},
      {"peak_error_mm", "the largest", [](Of p) { return p.pass.error.max; }},
      {"F_normal_mean_N", "mean force across the wall",
       [](Of p) { return p.pass.F_normal.mean; }},
      {"F_normal_max_N", "largest force across the wall",
       [](Of p) { return p.pass.F_normal.max; }},
      {"thickness_before_mm", "of the wall where it is cut, `null` where it is rigid",
       [](Of p) {
         return all_given(p.bends ? Value(p.pass.thickness_before) : Value());
       }},
      {"thickness_left_mm", "after the pass, `null` where it is rigid",
       [](Of p) { return p.bends ? Value(p.pass.thickness_after) : Value(); }}};
  return all;
}

Array passes_value(const SurfaceResult& r) {
  Array all;
  for (const PassOutcome& pass : r.passes) {
    all.emplace_back(pass_fields().object({pass, r.wall.has_value()}));
  }
  return all;
}

/// passes.csv: a row for each of the same, without what is null.
base::Table pass_table(const SurfaceResult& r) {
  base::Table table{"passes.csv", {}};
  const Array passes = passes_value(r);
  const auto row = [&](std::size_t i) -> const Object& {
    return std::get<Object>(passes[i].data);
  };
  add_column(table, "pass", passes.size(), [](std::size_t i) { return i + 1; });
  for (std::size_t k = 0; k < row(0).size(); ++k) {
    if (!std::holds_alternative<double>(row(0)[k].value.data)) continue;
    add_column(table, row(0)[k].key, passes.size(),
               [&](std::size_t i) { return std::get<double>(row(i)[k].value.data); });
  }
  return table;
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

const Columns<structure::LoadedWalls>& load_columns() {
  using Of = const structure::LoadedWalls&;
  static const Columns<structure::LoadedWalls> all{
      "wall_loads.csv",
      [](Of loads) { return loads.x.size() * loads.y.size(); },
      {{"x_mm", "along the wall",
        [](Of loads, std::size_t i) { return given(loads.x[i / loads.y.size()]); }},
       {"wall_height_mm", "above the foot",
        [](Of loads, std::size_t i) { return given(loads.y[i % loads.y.size()]); }},
       {"*_deflection_mm",
        "of each load, `pressure`, `edge_load`, `line_load`, in its direction",
        [](Of loads) {
          std::vector<std::string> names;
          for (const LoadedWall& wall : loads.walls) {
            names.emplace_back(name_of(wall.load));
          }
          return names;
        },
        [](Of loads, std::size_t i, std::size_t k) { return loads.walls[k].w[i]; }}}};
  return all;
}

/// Behind the name of a load, but for its size.
const Fields<LoadedWall>& load_fields() {
  using Of = const LoadedWall&;
  static const Fields<LoadedWall> all{
      {"largest_deflection_mm", "by size", &LoadedWall::largest},
      {"x_mm", "where that is", [](Of wall) { return given(wall.x); }},
      {"wall_height_mm", "above the foot", [](Of wall) { return given(wall.y); }},
      {"coefficient", "the number without unit of handbooks (B-11)",
       &LoadedWall::coefficient},
      {"coefficient_is", "how it is made, in letters",
       [](Of wall) { return coefficient_words(wall.load); }}};
  return all;
}

Object loads_value(const structure::LoadedWalls& loads) {
  Object all;
  for (const LoadedWall& wall : loads.walls) {
    Object one{{key_of(wall.load), unit::in(wall.size, unit_of(wall.load))}};
    for (Member& member : load_fields().object(wall)) one.push_back(std::move(member));
    all.push_back({std::string(name_of(wall.load)), std::move(one)});
  }
  return all;
}

std::vector<KeyText> texts_of_loads() {
  std::vector<KeyText> out;
  for (const WallLoad load :
       {WallLoad::pressure, WallLoad::edge_load, WallLoad::line_load}) {
    const std::string path = fmt::format(".{}", name_of(load));
    out.push_back({path, "where it is given"});
    out.push_back({fmt::format("{}.{}", path, key_of(load)), "as asked for"});
    for (KeyText& text : load_fields().texts(path + "."))
      out.push_back(std::move(text));
  }
  return out;
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

const Fields<SurfaceResult>& surface_part_fields() {
  using R = const SurfaceResult&;
  static const Fields<SurfaceResult> bends{
      {"axes", "of the forces", axes_of},
      {"mean_error_without_mm", "without them", [](R r) { return r.straight->mean; }},
      {"peak_error_without_mm", "without them", [](R r) { return r.straight->max; }},
      {"mean_change_um", "by which they change it",
       [](R r) { return r.map.error.mean - r.straight->mean; }},
      {"peak_change_um", "by which they change it",
       [](R r) { return r.map.error.max - r.straight->max; }}};
  static const Fields<SurfaceResult> all{
      Field<SurfaceResult>{"passes",
                           "with `[[pass]]`, for each; everything else is of the last",
                           passes_value, [](R r) { return !r.passes.empty(); }}
          .with(pass_fields().texts("[].")),
      {"also_bends", "if asked for: mean and peak error without those forces", bends,
       [](R r) { return &r; }, [](R r) { return r.straight.has_value(); }},
      Field<SurfaceResult>{"wall_loads", "if asked for",
                           [](R r) { return loads_value(*r.loads); },
                           [](R r) { return r.loads.has_value(); }}
          .with(texts_of_loads())};
  return all;
}

void add_surface_tables(const SurfaceResult& r, std::vector<base::Table>& tables) {
  if (!r.passes.empty()) {
    tables.push_back(pass_table(r));
  }
  if (r.loads) {
    tables.push_back(load_columns().table(*r.loads));
  }
}

void add_texts_of_surface_parts(std::vector<ColumnText>& out) {
  out.push_back({"passes.csv", "pass", "with `[[pass]]`: number, from 1"});
  for (const KeyText& key : pass_fields().texts()) {
    out.push_back({"passes.csv", key.path, key.meaning});
  }
  load_columns().add_texts(out);
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
