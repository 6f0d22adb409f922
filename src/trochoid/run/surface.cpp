#include <trochoid/run/commands.h>

#include <trochoid/base/units.h>
#include <trochoid/force/forces.h>
#include <trochoid/run/simulate.h>
#include <trochoid/run/wall.h>
#include <trochoid/surface/finish.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <variant>
#include <vector>

namespace trochoid::run {

namespace {

std::string why_no_map(const surface::ErrorMap& map) {
  return map.found ? fmt::format(
                         "after {} turns the deflection still changed by {:.2g} % from "
                         "turn to turn: no state was found that repeats",
                         map.turns, 100 * map.change)
                   : "no deflection was found that agrees with the chip that it "
                     "makes: the force changes faster with the deflection than cutter "
                     "and wall resist";
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

surface::FinishOptions finish_options(const cases::Case& given) {
  return {.samples_per_turn = given.sampling.samples_per_rev,
          .cutoff = given.machine.surface.value_or(cases::Surface{}).cutoff};
}

void add_floor(const cases::Case& given, results::SurfaceResult& r) {
  const surface::BottomEdge bottom{given.dish, given.wiper, given.spindle_lead};
  for (const double y : given.machine.surface.value_or(cases::Surface{}).floor_y) {
    r.floor.push_back(
        surface::floor_line(given.setup, bottom, y, finish_options(given)));
  }
  if (!r.floor.empty() && surface::is_flat(given.setup.cutter.profile, bottom)) {
    r.heading.warnings.push_back(
        {"flat_floor",
         "The bottom edge is flat up to the axis: the deepest tooth wipes away all marks "
         "and the floor has no roughness unless the tool is tilted. Inserts rise "
         "towards the axis; give dish_deg of [tool], often 1 to 3 deg."});
  }
}

std::string floor_sentence(const results::SurfaceResult& r) {
  const surface::FloorLine* roughest = &r.floor.front();
  for (const surface::FloorLine& line : r.floor) {
    if (line.roughness.Ra > roughest->roughness.Ra) roughest = &line;
  }
  return fmt::format(
      "The floor has Ra {:.3g} um and Rz {:.3g} um on the line y = {:g} mm{}.",
      roughest->roughness.Ra / unit::um, roughest->roughness.Rz / unit::um,
      roughest->y / unit::mm,
      r.floor.size() > 1 ? ", the roughest of those asked for" : "");
}

/// Forces at the angles of the samples, for the edges that error_map does not know.
void add_forces(const cases::Case& given, surface::ErrorMap& map) {
  const force::Setup& setup = given.setup;
  const double f = setup.cutter.teeth() * setup.cut.f_z;
  const double away =
      std::holds_alternative<geometry::DownMilling>(setup.cut.engagement) ? 1.0 : -1.0;
  const std::vector<double> phi = sampled_angles(given.sampling);
  std::vector<double> normal;
  std::vector<double> along;
  const auto F = force::forces(setup, given.law, phi, given.sampling.tolerance);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    map.forces.push_back({.phi = phi[i],
                          .x = f * phi[i] / unit::turn,
                          .F_x = F[i][0],
                          .F_y = F[i][1],
                          .F_normal = away * F[i][1]});
    normal.push_back(away * F[i][1]);
    along.push_back(F[i][0]);
  }
  map.F_normal = surface::mean_and_extremes(normal);
  map.F_x = surface::mean_and_extremes(along);
}

/// Whether nothing bends and the profile itself can be told.
bool tells_profile(const cases::Case& given) {
  const cases::Surface table = given.machine.surface.value_or(cases::Surface{});
  return !given.machine.cutter_body && !given.machine.wall &&
         given.machine.passes.empty() && table.probe_diameter == 0 &&
         table.model == surface::Model::envelope;
}

/// Whether error_map knows these edges.
bool knows_edges(const cases::Case& given) {
  const geometry::Profile& p = given.setup.cutter.profile;
  return force::edges_alike(given.setup) && p.R == 0 && p.beta == 0 && p.alpha == 0;
}

/// Roughness of all rows.
void tell_roughness(const cases::Case& given, surface::ErrorMap& map) {
  const bool whole =
      given.sampling.revolutions == std::floor(given.sampling.revolutions);
  if (tells_profile(given)) {
    surface::tell_profiles(given.setup, finish_options(given), map);
  } else if (whole && map.model == surface::Model::envelope) {
    const double f = given.setup.cutter.teeth() * given.setup.cut.f_z;
    surface::tell_rows(f * given.sampling.revolutions, finish_options(given), map);
  }
}

std::string error_sentence(const results::SurfaceResult& r) {
  const surface::MeanAndExtremes& error = r.map.error;
  const double largest = std::max(std::abs(error.min), std::abs(error.max));
  const auto um = [largest](double e) {  // what is nothing beside the largest is none
    constexpr double nothing = 1e-4;
    return std::abs(e) < nothing * largest ? 0.0 : e / unit::um;
  };
  return fmt::format(
      "{}The error of the wall{} is {:.3g} um on average, and from {:.3g} to {:.3g} um over "
      "it (positive: material left).{}",
      r.floor.empty() ? "" : floor_sentence(r) + " ",
      r.passes.empty() ? "" : fmt::format(" after {} passes", r.passes.size()),
      um(error.mean), um(error.min), um(error.max),
      r.forces_known ? fmt::format(" The force across it reaches {:.3g} N.",
                                   std::max(std::abs(r.map.F_normal.min),
                                            std::abs(r.map.F_normal.max)))
                     : "");
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
  r.period = given.setup.cutter.teeth() * given.setup.cut.f_z;
  r.forces_known = given.forces_known;
  add_floor(given, r);
  r.of_wall = r.floor.empty() || !given.machine.surface->heights.empty();
  if (!r.of_wall) {
    r.heading.message = floor_sentence(r);
    return r;
  }
  const surface::Setting setting = wall_setting(given);
  if (tells_profile(given) && !knows_edges(given)) {
    r.map = surface::rigid_map(
        given.setup, surface::map_heights(map_options(given), given.setup.cut.a_p),
        finish_options(given));
    if (given.forces_known) add_forces(given, r.map);
  } else {
    cut(
        given, setting, [&] { tell("Cutting"); }, r);
  }
  if (!r.map.converged) {
    r.heading.ok = false;
    r.heading.message =
        given.machine.passes.empty()
            ? why_no_map(r.map)
            : fmt::format("pass {}: {}", r.passes.size() + 1, why_no_map(r.map));
    return r;
  }
  tell_roughness(given, r.map);
  if (!setting.also_bends.empty()) {
    r.also_bends = setting.also_bends;
    r.straight = straight_error(given, r);
  }
  const structure::WallLoads loads = wall_loads(given);
  if (r.wall && (loads.pressure != 0 || loads.edge_load != 0 || loads.line_load != 0)) {
    r.loads = structure::loaded_walls(*r.wall, loads);
  }
  add_surface_warnings(given, r, r.heading.warnings);
  r.heading.message = error_sentence(r);
  return r;
}

}  // namespace trochoid::run
