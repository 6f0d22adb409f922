#include <trochoid/run/wall/plan_changes.h>

#include <trochoid/numerics/parallel.h>
#include <trochoid/run/wall/plan_cut.h>
#include <trochoid/run/wall/setting.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

namespace trochoid::run {

namespace {

using results::ChangedWall;
using surface::WallTrial;

constexpr std::array factors{0.5, 0.75, 1.0, 1.25, 1.5};
constexpr std::array shares{0.1, 0.3, 0.5, 0.7, 0.9};

/// One wall or cut that is looked at.
struct Other {
  ChangedWall answer;
  WallTrial trial;
  double position = 0.0;  ///< of the cutter along the wall [m]
};

Other& add(const char* key, double value, const WallTrial& trial,
           std::vector<Other>& out) {
  Other& other = out.emplace_back();
  other.answer.key = key;
  other.answer.value = value;
  other.trial = trial;
  return other;
}

void add_axial_depths(const inputs::Case& given, const WallTrial& trial,
                      std::vector<Other>& out) {
  constexpr double any = std::numeric_limits<double>::infinity();
  const auto& body = given.machine.cutter_body;
  const double most = std::min(body ? body->flute_length.value_or(body->overhang) : any,
                               given.machine.wall ? given.machine.wall->height : any);
  for (const double factor : factors) {
    const double a_p = factor * trial.setting.setup.cut.a_p;
    if (a_p < most) {
      Other& other = add("axial_depth_mm", a_p, trial, out);
      other.position = wall_position(given);
      other.trial.setting.setup.cut.a_p = a_p;
      other.trial.setting.bodies = bodies_of(given, a_p);
    }
  }
}

void add_radial_depths(const inputs::Case& given, const WallTrial& trial,
                       std::vector<Other>& out) {
  const force::Setup& setup = trial.setting.setup;
  for (const double factor : factors) {
    const double a_e = factor * surface::radial_depth_of(setup.cut.engagement);
    if (a_e <= setup.cutter.profile.D) {
      Other& other = add("radial_depth_mm", a_e, trial, out);
      other.position = wall_position(given);
      other.trial.setting.setup = surface::with_radial_depth(setup, a_e);
    }
  }
}

void add_walls(const inputs::Case& given, const WallTrial& trial,
               std::vector<Other>& out) {
  if (!given.machine.wall) {
    return;
  }
  const inputs::Wall& wall = *given.machine.wall;
  for (const double factor : factors) {
    const double thickness = factor * wall.thickness;
    Other& other = add("thickness_mm", thickness, trial, out);
    other.position = wall.position;
    other.trial.setting.bodies =
        bodies_of(given, trial.setting.setup.cut.a_p, thickness);
  }
  for (const double share : shares) {
    const double x = share * wall.length;
    add("position_mm", x, trial, out).position = x;
  }
}

}  // namespace

std::vector<ChangedWall> plan_changes(const inputs::Case& given, const WallTrial& trial,
                                      const surface::WallDesign& design) {
  std::vector<Other> others;
  add_axial_depths(given, trial, others);
  add_radial_depths(given, trial, others);
  add_walls(given, trial, others);
  numerics::for_each_index(others.size(), [&](std::size_t i) {
    Other& other = others[i];
    try {
      const auto heights = heights_of(design, other.trial.setting.setup.cut.a_p);
      const surface::WallCatalogue catalogue(other.trial, heights, other.position);
      other.answer.told = catalogue.predict(catalogue.readings_of(design));
    } catch (const std::domain_error&) {
      other.answer.told = {};  // no steady state: nothing is told
    }
  });
  std::vector<ChangedWall> out;
  for (Other& other : others) {
    out.push_back(std::move(other.answer));
  }
  return out;
}

}  // namespace trochoid::run
