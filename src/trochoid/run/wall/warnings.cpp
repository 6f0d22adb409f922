#include <trochoid/run/wall/warnings.h>

#include <trochoid/base/units.h>
#include <trochoid/run/wall/setting.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace trochoid::run {

namespace {

using Warnings = std::vector<base::Warning>;

double radial_depth(const geometry::Engagement& engagement) {
  if (const auto* down = std::get_if<geometry::DownMilling>(&engagement)) {
    return down->a_e;
  }
  const auto* up = std::get_if<geometry::UpMilling>(&engagement);
  return up == nullptr ? 0.0 : up->a_e;
}

}  // namespace

void add_bending_warnings(const inputs::Case& given, double largest,
                          Warnings& warnings) {
  constexpr double visible = 0.01;
  if (given.machine.wall && largest > given.machine.wall->thickness / 2) {
    warnings.push_back(
        {"thick_deflection",
         fmt::format(
             "The error of {:.3g} mm is more than half of the wall's thickness: "
             "a thin plate bends in proportion to the force only below that.",
             largest / unit::mm)});
  }
  const double a_e = radial_depth(given.setup.cut.engagement);
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

void add_surface_warnings(const inputs::Case& given, const surface::ErrorMap& map,
                          Warnings& warnings) {
  add_bending_warnings(
      given, std::max(std::abs(map.error.max), std::abs(map.error.min)), warnings);
  if (!given.machine.cutter_body && !given.machine.wall) {
    warnings.push_back(
        {"rigid", "Neither [cutter_body] nor [wall] is given: nothing bends."});
  }
  if (map.model == surface::Model::quasi_static) {
    warnings.push_back(
        {"quasi_static",
         "quasi_static is the deflection at every spindle angle, as the paper has it: "
         "a pulse of force, not the profile that stays on the wall."});
  }
}

}  // namespace trochoid::run
