#include <trochoid/results/surface_parts.h>

#include <trochoid/base/units.h>
#include <trochoid/results/descriptions.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::results {

namespace {

using surface::DeflectedShape;
using surface::ErrorMap;
using surface::ErrorRow;

/// The points of all rows of a map.
struct MapPoints {
  struct Point {
    const ErrorRow* row;
    std::size_t i;
  };
  std::vector<Point> points = {};

  explicit MapPoints(const ErrorMap& map) {
    for (const ErrorRow& row : map.rows) {
      for (std::size_t i = 0; i < row.x.size(); ++i) points.push_back({&row, i});
    }
  }
};

const Columns<MapPoints>& surface_columns() {
  using Of = const MapPoints&;
  static const Columns<MapPoints> all{
      "surface.csv",
      [](Of of) { return of.points.size(); },
      {{"x_mm", "along the feed, height by height",
        [](Of of, std::size_t i) {
          return given(of.points[i].row->x[of.points[i].i]);
        }},
       {"height_mm", "above the tip",
        [](Of of, std::size_t i) { return given(of.points[i].row->height); }},
       {"error_mm", "positive where material is left",
        [](Of of, std::size_t i) { return of.points[i].row->error[of.points[i].i]; }},
       {"tooth", "that made it, from 1; 0: left by a pass before",
        [](Of of, std::size_t i) {
          return of.points[i].row->tooth[of.points[i].i] + 1;
        }}}};
  return all;
}

const Columns<ErrorMap>& wall_force_columns() {
  using Of = const ErrorMap&;
  static const Columns<ErrorMap> all{
      "forces.csv",
      [](Of map) { return map.forces.size(); },
      {{"angle_deg", "spindle angle",
        [](Of map, std::size_t i) { return given(map.forces[i].phi); }},
       {"x_mm", "of the axis along the feed",
        [](Of map, std::size_t i) { return given(map.forces[i].x); }},
       {"F_normal_N", "pushes cutter and wall apart",
        [](Of map, std::size_t i) { return map.forces[i].F_normal; }},
       {"Fx_N", "on the tool", [](Of map, std::size_t i) { return map.forces[i].F_x; }},
       {"Fy_N", "on the tool",
        [](Of map, std::size_t i) { return map.forces[i].F_y; }}}};
  return all;
}

const Columns<ErrorMap>& deflection_columns() {
  using Of = const ErrorMap&;
  static const Columns<ErrorMap> all{
      "deflection.csv",
      [](Of map) { return map.rows.size() * map.forces.size(); },
      {{"angle_deg", "spindle angle",
        [](Of map, std::size_t i) {
          return given(map.forces[i % map.forces.size()].phi);
        }},
       {"height_mm", "above the tip",
        [](Of map, std::size_t i) {
          return given(map.rows[i / map.forces.size()].height);
        }},
       {"deflection_mm", "of cutter and wall together", [](Of map, std::size_t i) {
          const std::size_t angles = map.forces.size();
          return map.rows[i / angles].deflection[i % angles];
        }}}};
  return all;
}

const Columns<ErrorMap>& influence_columns() {
  using Of = const ErrorMap&;
  static const Columns<ErrorMap> all{
      "influence.csv",
      [](Of map) {
        return map.influence_heights.size() * map.influence_heights.size();
      },
      {{"height_mm", "at which the deflection is taken",
        [](Of map, std::size_t i) {
          return given(map.influence_heights[i / map.influence_heights.size()]);
        }},
       {"load_height_mm", "at which the force acts",
        [](Of map, std::size_t i) {
          return given(map.influence_heights[i % map.influence_heights.size()]);
        }},
       {"cutter_mm_per_N", "of the cutter",
        [](Of map, std::size_t i) { return map.influence_of_cutter[i]; }},
       {"wall_mm_per_N", "of the wall",
        [](Of map, std::size_t i) { return map.influence_of_wall[i]; }}}};
  return all;
}

const Columns<DeflectedShape>& bent_columns() {
  using Of = const DeflectedShape&;
  static const Columns<DeflectedShape> all{
      "bent.csv",
      [](Of shape) { return shape.heights.size(); },
      {{"height_mm", "from the foot of the wall to the holder",
        [](Of shape, std::size_t i) { return given(shape.heights[i]); }},
       {"cutter_mm",
        "where its axis is at the angle of the largest force, positive away from the "
        "wall; 0 where it does not reach",
        [](Of shape, std::size_t i) { return shape.cutter[i]; }},
       {"wall_mm", "the same of the wall, positive away from the cutter",
        [](Of shape, std::size_t i) { return shape.wall[i]; }}}};
  return all;
}

const Fields<surface::Roughness>& filtered_fields() {
  using Of = const surface::Roughness&;
  static const Fields<surface::Roughness> all{
      {"cutoff_mm", "of the filter, as asked for",
       [](Of r) { return given(r.cutoff); }},
      {"Ra_um", "over five cutoffs", [](Of r) { return r.Ra; }},
      {"Rq_um", "over five cutoffs", [](Of r) { return r.Rq; }},
      {"Rz_um", "mean of the Rz of the five", [](Of r) { return r.Rz; }},
      {"Rt_um", "over five cutoffs", [](Of r) { return r.Rt; }}};
  return all;
}

const Fields<ErrorRow>& height_fields() {
  using Of = const ErrorRow&;
  const auto waves = [](Of row) { return row.waves.has_value(); };
  static const Fields<ErrorRow> operators{
      {"K_tc_mm_per_MPa", "error by K_tc",
       [](Of row) { return as_named((*row.per_K)[0] * unit::MPa / unit::mm); }},
      {"K_rc_mm_per_MPa", "error by K_rc",
       [](Of row) { return as_named((*row.per_K)[1] * unit::MPa / unit::mm); }}};
  static const Fields<ErrorRow> all{
      {"height_mm", "above the tip", [](Of row) { return given(row.height); }},
      {"mean_error_mm", "mean error", [](Of row) { return row.statistics.error.mean; }},
      {"min_error_mm", "smallest", [](Of row) { return row.statistics.error.min; }},
      {"max_error_mm", "largest", [](Of row) { return row.statistics.error.max; }},
      {"Ra_um", "along the feed", [](Of row) { return row.statistics.Ra; }},
      {"Rt_um", "along the feed",
       [](Of row) { return row.statistics.error.max - row.statistics.error.min; }},
      {"Rq_um", "along the feed", [](Of row) { return row.roughness->Rq; },
       [](Of row) { return row.roughness.has_value(); }},
      {"Rz_um", "along the feed: the sampling length is what is computed of it",
       [](Of row) { return row.roughness->Rz; },
       [](Of row) { return row.roughness.has_value(); }},
      {"filtered", "with `cutoff_mm`, behind the Gaussian filter (W-2)",
       filtered_fields(), [](Of row) { return &*row.filtered; },
       [](Of row) { return row.filtered.has_value(); }},
      {"share", "which fraction of the profile each tooth made",
       [](Of row) { return row.statistics.share; }},
      {"compliance_mm_per_N", "under the whole force", &ErrorRow::compliance},
      {"once_per_turn_um", "envelope over whole turns: amplitude",
       [](Of row) { return row.waves->once_per_turn; }, waves},
      {"once_per_tooth_um", "the same with the teeth",
       [](Of row) { return row.waves->once_per_tooth; }, waves},
      {"operator", "imprint: the error by each coefficient", operators,
       [](Of row) { return &row; }, [](Of row) { return row.per_K.has_value(); }}};
  return all;
}

const Fields<SurfaceResult>& bent_fields() {
  using R = const SurfaceResult&;
  static const Fields<SurfaceResult> cutter{
      {"diameter_mm", "of the teeth", [](R r) { return given(r.diameter); }},
      {"shank_diameter_mm", "of the shank",
       [](R r) { return given(r.cutter->shank_diameter); }},
      {"flute_length_mm", "above the tip",
       [](R r) { return given(r.cutter->flute_length); }},
      {"overhang_mm", "from the holder to the tip",
       [](R r) { return given(r.cutter->overhang); }}};
  static const Fields<SurfaceResult> wall{
      {"height_mm", "up to the last pass",
       [](R r) {
         const double below = r.passes.empty() ? 0.0 : r.passes.back().cut.below;
         return given(r.wall->height - below);
       }},
      {"thickness_mm", "before the cut", [](R r) { return given(r.wall->thickness); }},
      {"edge_height_mm", "axial depth of the cut", [](R r) { return given(r.a_p); }}};
  static const Fields<SurfaceResult> all{
      {"angle_deg", "spindle angle of the largest force",
       [](R r) { return given(r.map.shape->phi); }},
      {"F_normal_N", "the force there", [](R r) { return r.map.shape->F_normal; }},
      {"cutter", "`null` where rigid", cutter,
       [](R r) { return r.cutter ? &r : nullptr; }},
      {"wall", "`null` where rigid", wall, [](R r) { return r.wall ? &r : nullptr; }}};
  return all;
}

/// The points of all lines of a floor.
struct FloorPoints {
  const SurfaceResult& r;
  std::size_t line;  ///< points on each
};

const Columns<FloorPoints>& floor_columns() {
  using Of = const FloorPoints&;
  static const auto line = [](Of of, std::size_t i) -> const surface::FloorLine& {
    return of.r.floor[i / of.line];
  };
  static const Columns<FloorPoints> all{
      "floor.csv",
      [](Of of) { return of.r.floor.size() * of.line; },
      {{"y_mm", "of the line",
        [](Of of, std::size_t i) { return given(line(of, i).y); }},
       {"x_mm", "along the feed, one period from where the axis is at the angle 0",
        [](Of of, std::size_t i) { return given(line(of, i).x[i % of.line]); }},
       {"z_mm", "height of the floor above the nominal plane of the tips (W-3)",
        [](Of of, std::size_t i) { return line(of, i).z[i % of.line]; }},
       {"tooth", "that wrote it, from 1",
        [](Of of, std::size_t i) { return line(of, i).tooth[i % of.line] + 1; }}}};
  return all;
}

const Fields<surface::FloorLine>& floor_fields() {
  using Of = const surface::FloorLine&;
  static const Fields<surface::FloorLine> all{
      {"y_mm", "of the line, as asked for", [](Of l) { return given(l.y); }},
      {"mean_mm", "mean height above the nominal plane of the tips",
       [](Of l) { return l.roughness.mean; }},
      {"lowest_mm", "lowest height", [](Of l) { return l.roughness.lowest; }},
      {"highest_mm", "highest", [](Of l) { return l.roughness.highest; }},
      {"Ra_um", "over one period, no filter (W-1)",
       [](Of l) { return l.roughness.Ra; }},
      {"Rq_um", "the same", [](Of l) { return l.roughness.Rq; }},
      {"Rz_um", "the same: the sampling length is the period",
       [](Of l) { return l.roughness.Rz; }},
      {"Rt_um", "the same", [](Of l) { return l.roughness.Rt; }},
      {"share", "which fraction of the profile each tooth wrote",
       &surface::FloorLine::share},
      {"filtered", "with `cutoff_mm`, behind the Gaussian filter (W-2)",
       filtered_fields(), [](Of l) { return l.filtered ? &*l.filtered : nullptr; },
       [](Of l) { return l.filtered.has_value(); }}};
  return all;
}

const Fields<SurfaceResult>& surface_fields() {
  using R = const SurfaceResult&;
  const auto of_wall = [](R r) { return r.of_wall; };
  const auto steady = [](R r) { return r.of_wall && r.map.converged; };
  const auto forced = [](R r) {
    return r.of_wall && r.map.converged && r.forces_known;
  };
  static const Fields<ErrorMap> forces{
      {"F_normal_mean_N", "mean", [](const ErrorMap& m) { return m.F_normal.mean; }},
      {"F_normal_min_N", "smallest", [](const ErrorMap& m) { return m.F_normal.min; }},
      {"F_normal_max_N", "largest", [](const ErrorMap& m) { return m.F_normal.max; }},
      {"Fx_mean_N", "mean", [](const ErrorMap& m) { return m.F_x.mean; }},
      {"Fx_min_N", "smallest", [](const ErrorMap& m) { return m.F_x.min; }},
      {"Fx_max_N", "largest", [](const ErrorMap& m) { return m.F_x.max; }}};
  static const Fields<SurfaceResult> all{
      {"period_mm", "feed of a turn, after which the profiles repeat",
       [](R r) { return r.period; }, [](R r) { return r.period > 0; }},
      {"floor", "for each of `floor_y_mm`", floor_fields(),
       [](R r) -> const auto& {return r.floor;
}
, [](R r) { return !r.floor.empty(); }
}  // namespace
, {"model", "as asked for", [](R r) { return surface::name_of(r.map.model); }, of_wall},
    {"feedback", "as asked for", [](R r) { return surface::name_of(r.map.feedback); },
     of_wall},
    {"mean_error_mm", "mean of the heights", [](R r) { return r.map.error.mean; },
     steady},
    {"peak_error_mm", "largest of the heights", [](R r) { return r.map.error.max; },
     steady},
    {"min_error_mm", "smallest of the heights", [](R r) { return r.map.error.min; },
     steady},
    {"forces", "over the rows of forces.csv", forces, [](R r) { return &r.map; },
     forced},
    {"compliance_mm_per_N", "at the first of the heights, under the whole force",
     [](R r) { return r.map.rows.front().compliance; }, forced},
    {"turns_to_repeat", "turns until the steady state, in which the deflection repeats",
     [](R r) { return r.map.turns; }, steady},
    {"heights", "for each height", height_fields(),
     [](R r) -> const auto& {return r.map.rows;
}  // namespace trochoid::results
, steady
}  // namespace
,
    {"bent", "the deflected shapes in bent.csv", bent_fields(), [](R r) { return &r; },
     [](R r) { return r.map.converged && r.map.shape; }},
{
  "", "", surface_part_fields(), [](R r) { return &r; }, steady
}
}
;  // namespace trochoid::results
return all;
}

/// Else it might print as -0.00.
double newtons(double force) {
  return std::abs(force) < 0.005 ? 0.0 : force;
}

std::string floor_text(const SurfaceResult& r) {
  std::string text = fmt::format(
      "finish of the floor along the feed\n  {:>10} {:>12} {:>9} {:>9} {:>9}   written by\n",
      "y mm", "mean um", "Ra um", "Rq um", "Rz um");
  for (const surface::FloorLine& line : r.floor) {
    const surface::Roughness& w = line.roughness;
    text += fmt::format("  {:>10.3f} {:>12.3f} {:>9.4f} {:>9.4f} {:>9.4f}  ",
                        unit::in(line.y, unit::mm), w.mean / unit::um, w.Ra / unit::um,
                        w.Rq / unit::um, w.Rz / unit::um);
    for (std::size_t j = 0; j < line.share.size(); ++j) {
      if (line.share[j] > 0)
        text += fmt::format(" {}: {:.0f} %", j + 1, 100 * line.share[j]);
    }
    text += '\n';
  }
  return text;
}

/// About ten of the heights, and what acts on them.
std::string wall_text(const SurfaceResult& r) {
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
  if (!r.forces_known) {
    return text + surface_parts_text(r);
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
  Answer answer{
      .command = "surface", .heading = r.heading, .result = surface_fields().object(r)};
  if (!r.map.converged) {
    return answer;
  }
  if (!r.floor.empty()) {
    answer.short_table = floor_text(r);
    answer.tables.push_back(floor_columns().table({r, r.floor.front().x.size()}));
  }
  if (!r.of_wall) {
    return answer;
  }
  answer.short_table += wall_text(r);
  answer.tables.push_back(surface_columns().table(MapPoints(r.map)));
  if (r.forces_known) {
    answer.tables.push_back(wall_force_columns().table(r.map));
  }
  if (r.forces_known && !r.map.rows.front().deflection.empty()) {
    answer.tables.push_back(deflection_columns().table(r.map));
    answer.tables.push_back(influence_columns().table(r.map));
  }
  if (r.map.shape) {
    answer.tables.push_back(bent_columns().table(*r.map.shape));
  }
  add_surface_tables(r, answer.tables);
  return answer;
}

Description description_of_surface() {
  Description all{.command = "surface", .keys = surface_fields().texts()};
  floor_columns().add_texts(all.columns);
  surface_columns().add_texts(all.columns);
  wall_force_columns().add_texts(all.columns);
  deflection_columns().add_texts(all.columns);
  influence_columns().add_texts(all.columns);
  bent_columns().add_texts(all.columns);
  add_texts_of_surface_parts(all.columns);
  return all;
}

}  // namespace trochoid::results
