#include <trochoid/run/wall_setting.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <cmath>
#include <memory>

namespace trochoid::run {

namespace {

/// Of the wall's deflection: what it adds to the error is far below a reading's noise.
constexpr double plate_tolerance = 2e-4;
constexpr double force_tolerance = 1e-5;

surface::BodiesAt bodies_of(const inputs::MachineTables& machine, double a_p) {
  return [machine, a_p](double x) {
    surface::Bodies bodies;
    if (machine.cutter_body) {
      const inputs::CutterBody& b = *machine.cutter_body;
      bodies.cutter =
          structure::Cantilever{.overhang = b.overhang,
                                .flute_length = b.flute_length.value_or(b.overhang),
                                .shank_diameter = b.shank_diameter.value_or(0.0),
                                .flute_diameter = b.equivalent_diameter.value_or(0.0),
                                .youngs_modulus = b.youngs_modulus};
    }
    if (machine.wall) {
      const inputs::Wall& w = *machine.wall;
      const structure::Plate plate{w.length, w.height, w.thickness, w.youngs_modulus,
                                   w.poisson_ratio};
      bodies.wall = surface::Wall{
          std::make_shared<structure::PlateSolution>(plate, x, plate_tolerance, a_p),
          w.height, w.length};
    }
    return bodies;
  };
}

}  // namespace

surface::Setting wall_setting(const inputs::Case& given) {
  const inputs::Surface table = given.machine.surface.value_or(inputs::Surface{});
  surface::Setting setting{.setup = given.setup,
                           .law = given.law,
                           .bodies = bodies_of(given.machine, given.setup.cut.a_p),
                           .phase = table.phase,
                           .probe_radius = table.probe_diameter / 2,
                           .tolerance = force_tolerance};
  setting.load = table.load;
  setting.model = table.model;
  return setting;
}

surface::Feedback wall_feedback(const inputs::Case& given) {
  return given.machine.surface.value_or(inputs::Surface{}).feedback;
}

void add_bending_warnings(const inputs::Case& given, double largest,
                          std::vector<base::Warning>& warnings) {
  constexpr double visible = 0.01;
  if (given.machine.wall && largest > given.machine.wall->thickness / 2) {
    warnings.push_back(
        {"thick_deflection",
         fmt::format(
             "The error of {:.3g} mm is more than half of the wall's thickness: "
             "a thin plate bends in proportion to the force only below that.",
             largest / unit::mm)});
  }
  double a_e = 0.0;
  if (const auto* down =
          std::get_if<geometry::DownMilling>(&given.setup.cut.engagement)) {
    a_e = down->a_e;
  } else if (const auto* up =
                 std::get_if<geometry::UpMilling>(&given.setup.cut.engagement)) {
    a_e = up->a_e;
  }
  if (wall_feedback(given) == surface::Feedback::none && largest > visible * a_e) {
    warnings.push_back(
        {"feedback",
         fmt::format("The error is {:.2g} % of the radial depth: the "
                     "deflection itself makes the cut smaller, which "
                     "feedback = \"{}\" takes into account.",
                     100 * largest / a_e,
                     given.setup.runout.eccentricity > 0 ? "regenerative" : "entry")});
  }
}

}  // namespace trochoid::run
