#include <trochoid/run/wall/surface.h>

#include <trochoid/base/units.h>
#include <trochoid/run/wall/setting.h>
#include <trochoid/run/wall/warnings.h>

#include <fmt/core.h>

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

}  // namespace

results::SurfaceResult surface(const inputs::Case& given, const Progress& progress) {
  const auto tell = [&](const char* what) {
    if (progress) {
      progress(what);
    }
  };
  tell("Solving the wall");
  results::SurfaceResult r{
      .heading = {.title = given.title, .case_toml = given.as_understood},
      .map = surface::error_map(wall_setting(given), map_options(given),
                                [&] { tell("Cutting"); }),
      .diameter = given.setup.cutter.profile.D,
      .a_p = given.setup.cut.a_p,
      .cutter = wall_cutter(given.machine),
      .wall = wall_plate(given.machine)};
  if (!r.map.converged) {
    r.heading.ok = false;
    r.heading.message = why_no_map(r.map);
    return r;
  }
  add_surface_warnings(given, r.map, r.heading.warnings);
  r.heading.message = fmt::format(
      "The error of the wall is {:.3g} um on average and {:.3g} um at most (positive: "
      "material left).",
      r.map.error.mean / unit::um, r.map.error.max / unit::um);
  return r;
}

}  // namespace trochoid::run
