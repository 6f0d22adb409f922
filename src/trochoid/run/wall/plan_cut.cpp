#include <trochoid/run/wall/plan_cut.h>

#include <trochoid/run/wall/setting.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

namespace trochoid::run {

namespace {

using surface::GridCell;

/// A map for its mean and its extremes only: the error is smooth over the height.
constexpr int map_heights = 9;
constexpr int samples_in_a_tooth_feed = 12;
/// Of the force: a map is read to per cents.
constexpr double map_tolerance = 1e-4;

surface::MapOptions samples_of(const inputs::Case& given,
                               const surface::Setting& setting) {
  surface::MapOptions out{
      .samples_per_turn = samples_in_a_tooth_feed * setting.setup.cutter.teeth(),
      .turns = 1.0,
      .position = wall_position(given),
      .feedback = wall_feedback(given),
      .tolerance = setting.tolerance};
  for (int i = 0; i < map_heights; ++i) {
    out.heights.push_back(i + 1 < map_heights
                              ? setting.setup.cut.a_p * i / (map_heights - 1)
                              : setting.setup.cut.a_p);
  }
  out.influence_heights = {0.0};
  return out;
}

GridCell stated_cell(const surface::Setting& setting,
                     const surface::MapOptions& samples) {
  const double a_e = surface::radial_depth_of(setting.setup.cut.engagement);
  const double f_z = setting.setup.cut.f_z;
  return error_grid(setting, samples, {&f_z, 1}, {&a_e, 1}).front();
}

/// The largest removal rate within the limit; with feedback, a cell between others is
/// computed by itself before it is named.
void find_best(const surface::Setting& setting, const surface::MapOptions& samples,
               results::PlannedCutting& out) {
  out.best.reset();
  for (std::size_t i = 0; i < out.cells.size(); ++i) {
    const GridCell& cell = out.cells[i];
    const bool keeps = cell.ok && limited_error(out, cell) <= *out.limit;
    if (keeps && (!out.best || cell.removal_rate > out.cells[*out.best].removal_rate)) {
      out.best = i;
    }
  }
  if (!out.best || samples.feedback == surface::Feedback::none) {
    return;
  }
  GridCell& cell = out.cells[*out.best];
  cell = error_grid(setting, samples, {&cell.f_z, 1}, {&cell.a_e, 1}).front();
  if (!cell.ok || limited_error(out, cell) > *out.limit) {
    find_best(setting, samples, out);
  }
}

/// From a tenth of the thickness to twenty times it: beyond, other things bend.
surface::ThinnestWall thinnest(const inputs::Case& given, surface::Setting setting,
                               const surface::MapOptions& samples,
                               const results::PlannedCutting& out) {
  const inputs::Wall& wall = *given.machine.wall;
  const double most = std::min(20.0 * wall.thickness, wall.height / 2);
  return surface::thinnest_wall(
      0.1 * wall.thickness, std::max(wall.thickness, most), *out.limit,
      [&](double thickness) {
        setting.bodies = bodies_of(given, setting.setup.cut.a_p, thickness);
        const GridCell cell = stated_cell(setting, samples);
        return cell.ok ? limited_error(out, cell)
                       : std::numeric_limits<double>::infinity();
      });
}

}  // namespace

surface::BodiesAt solved_once(surface::BodiesAt bodies) {
  struct Known {
    std::mutex mutex;
    std::map<double, surface::Bodies> at;
  };
  return [bodies = std::move(bodies), known = std::make_shared<Known>()](double x) {
    {
      const std::lock_guard lock(known->mutex);
      if (const auto found = known->at.find(x); found != known->at.end()) {
        return found->second;
      }
    }
    // Not under the lock: a thread that waits for others may begin another task here.
    surface::Bodies solved = bodies(x);
    const std::lock_guard lock(known->mutex);
    return known->at.emplace(x, std::move(solved)).first->second;
  };
}

surface::BodiesAt bodies_of(const inputs::Case& given, double a_p,
                            std::optional<double> thickness) {
  auto plate = wall_plate(given.machine);
  if (plate && thickness) {
    plate->thickness = *thickness;
  }
  return solved_once(surface::bodies_at(wall_cutter(given.machine), plate, a_p));
}

results::PlannedCutting plan_cutting(const inputs::Case& given,
                                     const surface::Setting& expected) {
  surface::Setting setting = expected;
  setting.tolerance = map_tolerance;
  const inputs::WallPlan& wall = given.plan.wall;
  const surface::MapOptions samples = samples_of(given, setting);
  results::PlannedCutting out{.feeds = given.plan.feeds,
                              .radial_depths = given.plan.radial_depths,
                              .stated = stated_cell(setting, samples),
                              .mean = wall.limited == inputs::LimitedError::mean,
                              .limit = wall.largest_error};
  out.cells = error_grid(setting, samples, out.feeds, out.radial_depths);
  if (given.machine.wall) {
    out.thickness = given.machine.wall->thickness;
  }
  if (!out.limit) {
    return out;
  }
  find_best(setting, samples, out);
  out.feed_limits =
      feed_limits(out.cells, out.feeds.size(), *out.limit,
                  [&](const GridCell& c) { return limited_error(out, c); });
  if (given.machine.wall) {
    out.thinnest = thinnest(given, setting, samples, out);
  }
  return out;
}

}  // namespace trochoid::run
