#include <trochoid/results/plan_wall.h>

#include <trochoid/base/units.h>
#include <trochoid/results/descriptions.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trochoid::results {

namespace {

using surface::GridCell;
using surface::WallPrediction;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

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

std::vector<KeyText> texts_of_told() {
  std::vector<KeyText> out = below_estimate(".*.");
  out.front().meaning = "of both coefficients and `eccentricity_mm` (E-60)";
  out.push_back({".angle_se_deg", "of the eccentricity, or `null`"});
  out.push_back({".correlation", "of the coefficients"});
  out.push_back({".condition", "of the equations"});
  return out;
}

/// Something that has a prediction, and the plan that it is of.
template <class One>
struct OfWallPlan {
  const PlanWallResult& r;
  const One& one;
};

template <class One>
std::vector<OfWallPlan<One>> of_wall_plan(const PlanWallResult& r,
                                          const std::vector<One>& all) {
  std::vector<OfWallPlan<One>> out;
  for (const One& one : all) out.push_back({r, one});
  return out;
}

template <class One>
Field<OfWallPlan<One>> told_field() {
  return Field<OfWallPlan<One>>{
      "predicted",
      "about what is expected; `null` where they cannot be determined separately",
      [](const OfWallPlan<One>& of) { return told_value(of.r, of.one.told); }}
      .with(texts_of_told());
}

const Fields<OfWallPlan<PlannedDesign>>& design_fields() {
  using Of = const OfWallPlan<PlannedDesign>&;
  static const Fields<OfWallPlan<PlannedDesign>> all{
      {"heights", "how many", [](Of d) { return d.one.design.heights; }},
      {"readings_per_height", "how many", [](Of d) { return d.one.design.per_height; }},
      {"spread", "of the heights over the axial depth",
       [](Of d) { return d.one.design.spread; }},
      {"readings", "in all", [](Of d) { return d.one.readings; }},
      {"heights_mm", "above the tip",
       [](Of d) { return all_given(heights_of(d.one.design, d.r.a_p)); }},
      {"enough", "every interval that is wanted is kept",
       [](Of d) { return d.one.enough; }},
      told_field<PlannedDesign>()};
  return all;
}

const Fields<GridCell>& cell_fields() {
  using Of = const GridCell&;
  static const Fields<GridCell> all{
      {"feed_per_tooth_mm", "of the cut", [](Of c) { return given(c.f_z); }},
      {"radial_depth_mm", "of the cut", [](Of c) { return given(c.a_e); }},
      {"peak_error_um", "the largest distance from the wall as wanted, either way",
       [](Of c) { return c.ok ? Value(c.peak) : Value(); }},
      {"mean_error_um", "positive: material left",
       [](Of c) { return c.ok ? Value(c.mean) : Value(); }},
      {"removal_rate_mm3_per_min", "of the cut",
       [](Of c) { return as_named(c.removal_rate / mm3_per_min); }}};
  return all;
}

const Fields<PlannedCutting>& cutting_fields() {
  using C = const PlannedCutting&;
  using Wall = const surface::ThinnestWall&;
  static const Fields<surface::ThinnestWall> thinnest{
      {"thickness_mm", "`null` where the cutter alone leaves too much",
       [](Wall t) { return t.thickness; }},
      {"error_um", "that it leaves",
       [](Wall t) { return std::isfinite(t.error) ? Value(t.error) : Value(); }},
      {"thinner_too", "thinner ones were not looked at",
       [](Wall t) { return t.thinner_too; }}};
  using Limit = std::pair<double, std::optional<double>>;
  static const Fields<Limit> limit{
      {"radial_depth_mm", "each", [](const Limit& l) { return given(l.first); }},
      {"feed_per_tooth_mm", "the largest within the limit, or `null`",
       [](const Limit& l) { return l.second; }}};
  static const Fields<PlannedCutting> all{
      {"limited", "`peak` or `mean`", [](C c) { return c.mean ? "mean" : "peak"; }},
      {"largest_error_um", "the limit, or `null`", [](C c) { return c.limit; }},
      {"stated", "the cut as it stands", cell_fields(), [](C c) { return &c.stated; }},
      {"best", "the largest removal rate within the limit, or `null`", cell_fields(),
       [](C c) { return c.best ? &c.cells[*c.best] : nullptr; }},
      {"thickness_mm", "of the wall, or `null`", [](C c) { return c.thickness; }},
      {"thinnest_wall", "that keeps the limit, or `null`", thinnest,
       [](C c) { return c.thinnest; }},
      {"feed_limits", "of each radial depth", limit, [](C c) {
         std::vector<Limit> limits;
         for (std::size_t i = 0; i < c.feed_limits.size(); ++i) {
           limits.emplace_back(c.radial_depths[i], c.feed_limits[i]);
         }
         return limits;
       }}};
  return all;
}

const Fields<PlanWallResult>& wall_plan_fields() {
  using R = const PlanWallResult&;
  using More = OfWallPlan<MoreReadings>;
  static const Fields<More> more{
      {"height_mm", "above the tip", [](const More& m) { return given(m.one.height); }},
      told_field<MoreReadings>()};
  using Changed = OfWallPlan<ChangedWall>;
  static const Fields<Changed> changed{
      {"key",
       "one of `axial_depth_mm, radial_depth_mm, thickness_mm, position_mm` is another",
       [](const Changed& c) { return c.one.key; }},
      {"value_mm", "of it", [](const Changed& c) { return given(c.one.value); }},
      told_field<ChangedWall>()};
  static const Fields<PlanWallResult> all{
      {"of", "`wall`: what is planned", [](R) { return "wall"; }},
      {"chosen",
       "the design with the fewest readings that is enough; where none is, the one that "
       "comes nearest",
       design_fields(),
       [](R r) {
         return r.chosen
                    ? std::optional(OfWallPlan<PlannedDesign>{r, r.designs[*r.chosen]})
                    : std::nullopt;
       }},
      Field<PlanWallResult>{
          "so_far",
          "the same of the `[[surface_measurement]]` of the case; else `null`",
          [](R r) { return r.so_far ? told_value(r, *r.so_far) : Value(); }}
          .with(texts_of_told()),
      {"readings_so_far", "how many", &PlanWallResult::measured},
      {"files", "that they are of", &PlanWallResult::files},
      {"designs", "every way to measure", design_fields(),
       [](R r) { return of_wall_plan(r, r.designs); }},
      {"ten_more_readings", "with ten more readings at each height, the best first",
       more, [](R r) { return of_wall_plan(r, r.more); }},
      {"changes", "the chosen readings where the cut or the wall is another", changed,
       [](R r) { return of_wall_plan(r, r.changes); }},
      {"cutting", "which cut and which wall keep an error", cutting_fields(),
       [](R r) { return &r.cutting; }},
      {"form", "that was assumed", [](R r) { return surface::name_of(r.form); }},
      {"noise_um", "of a reading", &PlanWallResult::noise},
      {"noise_from", "of the `readings`, `given` or `assumed`",
       &PlanWallResult::noise_from},
      {"wanted_percent", "of the coefficients", [](R r) { return 100 * r.wanted; }},
      {"wanted_um", "of the eccentricity", &PlanWallResult::wanted_runout},
      {"runout", "why no readings show the runout; else `null`",
       [](R r) { return r.why_no_runout.empty() ? Value() : Value(r.why_no_runout); }}};
  return all;
}

/// The names of both coefficients and of the eccentricity, and half of a 95 % interval of
/// one of them in the unit of its name.
std::vector<std::string> names_told(const PlanWallResult& r) {
  const auto names = force::coefficient_quantities(r.law);
  return {std::string(names[0].key), std::string(names[1].key), "eccentricity_mm"};
}

double half_width(const PlanWallResult& r, const WallPrediction& p, std::size_t which) {
  const auto names = force::coefficient_quantities(r.law);
  if (!p.told) return nothing;
  if (which == 0) return p.factor * p.se_K_tc / names[0].unit;
  if (which == 1) return p.factor * p.se_K_rc / names[1].unit;
  return p.se_eccentricity ? p.factor * *p.se_eccentricity / unit::mm : nothing;
}

const Columns<PlanWallResult>& design_columns() {
  using R = const PlanWallResult&;
  static const Columns<PlanWallResult> all{
      "plan.csv",
      [](R r) { return r.designs.size(); },
      {{"heights", "of every way to measure, the fewest readings first",
        [](R r, std::size_t i) { return r.designs[i].design.heights; }},
       {"readings_per_height", "how many",
        [](R r, std::size_t i) { return r.designs[i].design.per_height; }},
       {"spread", "of the heights over the axial depth",
        [](R r, std::size_t i) { return r.designs[i].design.spread; }},
       {"readings", "in all", [](R r, std::size_t i) { return r.designs[i].readings; }},
       {"enough", "0 or 1",
        [](R r, std::size_t i) { return r.designs[i].enough ? 1 : 0; }},
       {"half_width_*",
        "of the 95 % interval of each coefficient and of `eccentricity_mm`; empty where "
        "it cannot be determined",
        names_told, [](R r, std::size_t i, std::size_t k) {
          return as_named(half_width(r, r.designs[i].told, k));
        }}}};
  return all;
}

const Columns<PlannedCutting>& error_columns() {
  using C = const PlannedCutting&;
  static const Columns<PlannedCutting> all{
      "error_map.csv",
      [](C c) { return c.cells.size(); },
      {{"feed_per_tooth_mm", "of the cut",
        [](C c, std::size_t i) { return given(c.cells[i].f_z); }},
       {"radial_depth_mm", "of the cut",
        [](C c, std::size_t i) { return given(c.cells[i].a_e); }},
       {"peak_error_um",
        "the largest distance from the wall as wanted, either way; empty where there is "
        "no steady state",
        [](C c, std::size_t i) { return c.cells[i].ok ? c.cells[i].peak : nothing; }},
       {"mean_error_um", "positive: material left; empty likewise",
        [](C c, std::size_t i) { return c.cells[i].ok ? c.cells[i].mean : nothing; }},
       {"removal_rate_mm3_per_min", "of the cut", [](C c, std::size_t i) {
          return as_named(c.cells[i].removal_rate / mm3_per_min);
        }}}};
  return all;
}

}  // namespace

Answer answer_of(const PlanWallResult& r) {
  Answer answer{
      .command = "plan", .heading = r.heading, .result = wall_plan_fields().object(r)};
  if (!r.designs.empty()) {
    answer.short_table = wall_plan_table(r);
    answer.tables.push_back(design_columns().table(r));
  }
  if (!r.cutting.cells.empty()) {
    answer.tables.push_back(error_columns().table(r.cutting));
  }
  return answer;
}

Description description_of_wall_plan() {
  Description all{.command = "plan of a wall", .keys = wall_plan_fields().texts()};
  design_columns().add_texts(all.columns);
  error_columns().add_texts(all.columns);
  return all;
}

}  // namespace trochoid::results
