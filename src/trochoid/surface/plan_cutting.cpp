#include <trochoid/surface/plan_cutting.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::surface {

namespace {

/// A map for its mean and its extremes only: the error is smooth over the height.
constexpr int heights_of_map = 9;
constexpr int samples_in_a_tooth_feed = 12;
/// Of the force: a map is read to per cents.
constexpr double map_tolerance = 1e-4;

MapOptions coarse_map(const Setting& setting, double position, Feedback feedback) {
  MapOptions out{
      .samples_per_turn = samples_in_a_tooth_feed * setting.setup.cutter.teeth(),
      .turns = 1.0,
      .position = position,
      .feedback = feedback,
      .tolerance = setting.tolerance,
      .stepwise = true};
  for (int i = 0; i < heights_of_map; ++i) {
    out.heights.push_back(i + 1 < heights_of_map
                              ? setting.setup.cut.a_p * i / (heights_of_map - 1)
                              : setting.setup.cut.a_p);
  }
  out.influence_heights = {0.0};
  return out;
}

GridCell one_cell(const Setting& setting, const MapOptions& samples, double f_z,
                  double a_e) {
  return error_grid(setting, samples, {&f_z, 1}, {&a_e, 1}).front();
}

GridCell stated_cell(const Setting& setting, const MapOptions& samples) {
  return one_cell(setting, samples, setting.setup.cut.f_z,
                  radial_depth_of(setting.setup.cut.engagement));
}

/// The largest removal rate within the limit; with feedback, a cell between others is
/// computed by itself before it is named.
void find_best(const Setting& setting, const MapOptions& samples, PlannedCutting& out) {
  out.best.reset();
  for (std::size_t i = 0; i < out.cells.size(); ++i) {
    const GridCell& cell = out.cells[i];
    const bool keeps = cell.ok && limited_error(out, cell) <= *out.limit;
    if (keeps && (!out.best || cell.removal_rate > out.cells[*out.best].removal_rate)) {
      out.best = i;
    }
  }
  if (!out.best || samples.feedback == Feedback::none) {
    return;
  }
  GridCell& cell = out.cells[*out.best];
  cell = one_cell(setting, samples, cell.f_z, cell.a_e);
  if (!cell.ok || limited_error(out, cell) > *out.limit) {
    find_best(setting, samples, out);
  }
}

/// From a tenth of the thickness to twenty times it: beyond, other things bend.
ThinnestWall thinnest(const BodyDimensions& dimensions, Setting setting,
                      const MapOptions& samples, const PlannedCutting& out) {
  const structure::Plate& wall = *dimensions.wall;
  const double most = std::min(20.0 * wall.thickness, wall.height / 2);
  return thinnest_wall(0.1 * wall.thickness, std::max(wall.thickness, most), *out.limit,
                       [&](double thickness) {
                         BodyDimensions other = dimensions;
                         other.wall->thickness = thickness;
                         setting.bodies =
                             bodies_solved_once(other, setting.setup.cut.a_p);
                         const GridCell cell = stated_cell(setting, samples);
                         return cell.ok ? limited_error(out, cell)
                                        : std::numeric_limits<double>::infinity();
                       });
}

}  // namespace

double limited_error(const PlannedCutting& cutting, const GridCell& cell) {
  return cutting.mean ? std::abs(cell.mean) : cell.peak;
}

PlannedCutting plan_cutting(const Setting& expected, const BodyDimensions& dimensions,
                            const CuttingRequest& request) {
  Setting setting = expected;
  setting.tolerance = map_tolerance;
  const MapOptions samples = coarse_map(setting, dimensions.position, request.feedback);
  PlannedCutting out;
  out.feeds = request.feeds;
  out.radial_depths = request.radial_depths;
  out.stated = stated_cell(setting, samples);
  out.mean = request.mean;
  out.limit = request.limit;
  out.cells = error_grid(setting, samples, out.feeds, out.radial_depths);
  if (dimensions.wall) {
    out.thickness = dimensions.wall->thickness;
  }
  if (!out.limit) {
    return out;
  }
  find_best(setting, samples, out);
  out.feed_limits =
      feed_limits(out.cells, out.feeds.size(), *out.limit,
                  [&](const GridCell& c) { return limited_error(out, c); });
  if (dimensions.wall) {
    out.thinnest = thinnest(dimensions, setting, samples, out);
  }
  return out;
}

}  // namespace trochoid::surface
