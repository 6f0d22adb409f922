#include <trochoid/run/commands.h>

#include <trochoid/base/units.h>
#include <trochoid/run/wall.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace trochoid::run {

namespace {

std::string why_no_map(const surface::ErrorMap& map) {
  return map.found ? fmt::format(
                         "after {} turns the deflection still changed by {:.2g} % from "
                         "turn to turn: no state was found that repeats",
                         map.turns, 100 * map.change)
                   : "no deflection agrees with the chip that it makes: the force "
                     "pulls cutter and wall together faster than they resist";
}

/// The cut, or all passes.
void cut(const cases::Case& given, const surface::Setting& setting,
         const std::function<void()>& solved, results::SurfaceResult& r) {
  const std::vector<surface::PassCut> cuts = wall_passes(given);
  if (cuts.empty()) {
    r.map = surface::error_map(setting, map_options(given), solved);
    return;
  }
  solved();
  surface::PassSequence sequence =
      surface::pass_sequence(setting, map_options(given), cuts, {r.cutter, r.wall});
  r.passes = std::move(sequence.passes);
  r.map = std::move(sequence.map);
}

/// The error of the same cut, bent by the force across the wall alone.
surface::MeanAndExtremes straight_error(const cases::Case& given,
                                        results::SurfaceResult r) {
  surface::Setting setting = wall_setting(given);
  setting.also_bends.clear();
  cut(
      given, setting, [] {}, r);
  return r.map.error;
}

}  // namespace

results::SurfaceResult surface(const cases::Case& given, const Progress& progress) {
  const auto tell = [&](const char* what) { progress(what); };
  tell("Solving the wall");
  results::SurfaceResult r{.heading = heading_of(given),
                           .diameter = given.setup.cutter.profile.D,
                           .a_p = given.setup.cut.a_p,
                           .cutter = wall_cutter(given.machine),
                           .wall = wall_plate(given.machine)};
  const surface::Setting setting = wall_setting(given);
  cut(
      given, setting, [&] { tell("Cutting"); }, r);
  if (!r.map.converged) {
    r.heading.ok = false;
    r.heading.message =
        given.machine.passes.empty()
            ? why_no_map(r.map)
            : fmt::format("pass {}: {}", r.passes.size() + 1, why_no_map(r.map));
    return r;
  }
  if (!setting.also_bends.empty()) {
    r.also_bends = setting.also_bends;
    r.straight = straight_error(given, r);
  }
  const structure::WallLoads loads = wall_loads(given);
  if (r.wall && (loads.pressure != 0 || loads.edge_load != 0 || loads.line_load != 0)) {
    r.loads = structure::loaded_walls(*r.wall, loads);
  }
  add_surface_warnings(given, r, r.heading.warnings);
  const surface::MeanAndExtremes& error = r.map.error;
  const double largest = std::max(std::abs(error.min), std::abs(error.max));
  const auto um = [largest](double e) {  // what is nothing beside the largest is none
    constexpr double nothing = 1e-4;
    return std::abs(e) < nothing * largest ? 0.0 : e / unit::um;
  };
  r.heading.message = fmt::format(
      "The error of the wall{} is {:.3g} um on average, and from {:.3g} to {:.3g} um over "
      "it (positive: material left). The force across it reaches {:.3g} N.",
      r.passes.empty() ? "" : fmt::format(" after {} passes", r.passes.size()),
      um(error.mean), um(error.min), um(error.max),
      std::max(std::abs(r.map.F_normal.min), std::abs(r.map.F_normal.max)));
  return r;
}

}  // namespace trochoid::run
