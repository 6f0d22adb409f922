#include <trochoid/base/units.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trochoid::cases {

namespace {

/// More cells would take minutes.
constexpr std::size_t most_cells = 2500;
/// Along each side of the map of the error, where nothing is said.
constexpr int default_steps = 15;

constexpr std::array<std::string_view, 7> keys_of_forces{
    "engagement", "axial_depth_mm", "turns",     "samples_per_rev",
    "noise_N",    "max_force_N",    "quantities"};
constexpr std::array<std::string_view, 9> keys_of_wall{
    "heights",        "readings_per_height", "spread",           "noise_um", "form",
    "wanted_percent", "wanted_um",           "largest_error_um", "limited"};
constexpr std::array<std::string_view, 2> keys_of_finish{"largest_Ra_um",
                                                         "inserts_within_um"};

/// Even steps from a quarter to twice what [cut] has; a nanometre is near enough.
void fill(std::vector<double>& list, double of, double most) {
  if (!list.empty() || !(of > 0)) {
    return;
  }
  const double last = std::min(2.0 * of, most);
  for (int i = 0; i < default_steps; ++i) {
    const double value = 0.25 * of + (last - 0.25 * of) * i / (default_steps - 1);
    const double nanometres = std::round(value / unit::mm * 1e6);
    list.push_back(as_written(nanometres / 1e6 * unit::mm, unit::mm));
  }
}

void fill(std::vector<double>& list, std::initializer_list<double> values) {
  if (list.empty()) {
    list = values;
  }
}

void check_counts(const std::vector<double>& list, const std::string& key,
                  Findings& findings) {
  for (std::size_t i = 0; sound(findings, {key}) && i < list.size(); ++i) {
    if (list[i] != std::round(list[i])) {
      report(findings, key,
             fmt::format("{} entry {} = {}: not a whole number", key, i + 1,
                         number_text(list[i])));
    }
  }
}

/// A grid is laid out over its values in their order.
void check_ascending(const std::vector<double>& list, const std::string& key,
                     Findings& findings) {
  const bool ascending = std::adjacent_find(list.begin(), list.end(),
                                            std::greater_equal<>()) == list.end();
  if (!ascending && sound(findings, {key})) {
    report(findings, key,
           fmt::format("{}: not ascending; the answer is laid out over values from the "
                       "smallest to the largest",
                       key));
  }
}

void fill_defaults(CaseTables& t) {
  Plan& plan = *t.plan;
  WallPlan& wall = plan.wall;
  const double teeth = t.tool.teeth;
  fill(wall.heights, {2, 3, 5, 9, 13, 21});
  fill(wall.per_height, {teeth, 4 * teeth, 8 * teeth, 16 * teeth, 32 * teeth});
  fill(wall.spreads, {0.5, 0.8});
  fill(plan.feeds, t.cut.feed_per_tooth.value_or(0.0), 1e3);
  fill(plan.radial_depths, t.cut.radial_depth.value_or(0.0), t.tool.diameter);
  wall.wanted = wall.wanted.value_or(10.0);
  wall.wanted_runout = wall.wanted_runout.value_or(1.0 * unit::um);
  if (!wall.form) {
    const auto& measured = t.machine.surface_measurements;
    const bool tilt = std::any_of(measured.begin(), measured.end(),
                                  [](const auto& m) { return m.datum_tilt; });
    const bool offset = std::any_of(measured.begin(), measured.end(),
                                    [](const auto& m) { return m.datum_offset; });
    wall.form = tilt     ? surface::PlannedForm::tilt
                : offset ? surface::PlannedForm::offset
                         : (measured.empty() ? surface::PlannedForm::offset
                                             : surface::PlannedForm::none);
  }
}

}  // namespace

PlanOf planned(const CaseTables& t) {
  if (t.plan && t.plan->of) return *t.plan->of;
  const bool has_wall = t.machine.surface || !t.machine.surface_measurements.empty();
  if (!has_wall || !t.measurements.empty()) return PlanOf::forces;
  const bool trace = is_finish(t.machine);
  return trace || is_floor_only(t, "surface") ? PlanOf::finish : PlanOf::wall;
}

void settle_plan(CaseTables& t, Findings& findings) {
  if (!t.plan) {
    t.plan.emplace();
  }
  Plan& plan = *t.plan;
  if (!sound(findings, {"plan.of"})) {
    return;
  }
  const bool decided = plan.of.has_value();
  if (!decided) plan.of = planned(t);
  plan.settled = true;
  const auto refuse = [&](PlanOf of, const auto& keys) {
    for (const std::string_view key : keys) {
      const std::string path = fmt::format("plan.{}", key);
      const bool given = findings.places.count(path) > 0 && sound(findings, {path});
      if (decided || *plan.of == of || !given) continue;
      report(findings, path,
             fmt::format("{}: has no meaning for of = \"{}\", which this case shows; "
                         "say of = \"{}\" if that is meant",
                         path, name_of(*plan.of), name_of(of)));
    }
  };
  refuse(PlanOf::forces, keys_of_forces);
  refuse(PlanOf::wall, keys_of_wall);
  refuse(PlanOf::finish, keys_of_finish);
}

void check_wall_plan(CaseTables& t, Findings& findings) {
  check_wall_cut(t, "plan", findings);
  const WallPlan& wall = t.plan->wall;
  check_counts(wall.heights, "plan.heights", findings);
  check_counts(wall.per_height, "plan.readings_per_height", findings);
  fill_defaults(t);
  check_ascending(t.plan->feeds, "plan.feed_per_tooth_mm", findings);
  check_ascending(t.plan->radial_depths, "plan.radial_depth_mm", findings);
  const std::size_t cells = t.plan->feeds.size() * t.plan->radial_depths.size();
  if (cells > most_cells) {
    report(
        findings, "plan",
        fmt::format("[plan]: {} feeds and radial depths together; must be at most {}",
                    cells, most_cells));
  }
  const bool measured = !t.machine.surface_measurements.empty();
  if (!measured && findings.places.count("force") == 0 && sound(findings, {"force"})) {
    report(findings, "force",
           "[force] is missing (the force law and its coefficients, as forces on the "
           "tool); a plan of a wall needs what is expected of it, or a "
           "[[surface_measurement]] to find it from");
  }
}

void check_finish_plan(CaseTables& t, Findings& findings) {
  if (is_finish(t.machine)) {
    report(
        findings, "surface_measurement[1].of",
        "surface_measurement[1].of = \"finish\": plan reads no roughness trace; must "
        "be left out (calibrate reads it and writes runout.toml, to be included)");
  }
  check_feed(t.cut, "plan", findings);
  fill(t.plan->feeds, t.cut.feed_per_tooth.value_or(0.0), 1e3);
  check_ascending(t.plan->feeds, "plan.feed_per_tooth_mm", findings);
  if (!t.machine.surface && sound(findings, {"surface"})) {
    t.machine.surface.emplace();
  }
  if (!t.machine.surface || !t.machine.surface_measurements.empty()) return;
  const Surface& table = *t.machine.surface;
  const bool wall = t.cut.engagement == EngagementKind::up ||
                    t.cut.engagement == EngagementKind::down;
  if (table.floor_y.empty() && !wall && sound(findings, {"cut.engagement"})) {
    report(
        findings, "surface",
        "[surface] floor_y_mm is missing (lines of the floor along the feed): a plan of "
        "a finish needs it, or an up or down cut, which leaves a wall");
  }
}

}  // namespace trochoid::cases
