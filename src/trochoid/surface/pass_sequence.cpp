#include <trochoid/surface/pass_sequence.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace trochoid::surface {

namespace {

constexpr int points_over_height = 16;
/// What bends less has no feedback that anybody could measure [m].
constexpr double no_deflection = 0.1e-6;

geometry::Engagement engagement(const geometry::Engagement& given, double a_e) {
  if (std::holds_alternative<geometry::UpMilling>(given)) {
    return geometry::UpMilling{a_e};
  }
  return geometry::DownMilling{a_e};
}

/// The wall before a pass: thinner where passes before have cut.
structure::Plate thinned(structure::Plate wall, double a_p, double thickness) {
  if (thickness == wall.thickness) {
    return wall;
  }
  if (a_p < wall.height) {
    wall.layers = {{.from = wall.height - a_p, .thickness = thickness}};
  } else {
    wall.thickness = thickness;
  }
  return wall;
}

/// Means over the feed at the heights from one on.
std::vector<double> means(const ErrorMap& map, std::size_t from) {
  std::vector<double> out;
  for (std::size_t i = from; i < map.rows.size(); ++i) {
    out.push_back(map.rows[i].statistics.error.mean);
  }
  return out;
}

/// Mean and extremes of the polynomial through values at the points.
MeanAndExtremes over_the_height(const numerics::LagrangeBasis& basis, double a_p,
                                std::span<const double> values) {
  constexpr int samples = 100;
  std::vector<double> even;
  for (int i = 0; i < samples; ++i) {
    even.push_back(basis.value(values, a_p * (i + 0.5) / samples));
  }
  return mean_and_extremes(even);
}

double largest_deflection(const ErrorMap& map) {
  double largest = 0.0;
  for (const ErrorRow& row : map.rows) {
    for (const double d : row.deflection) {
      largest = std::max(largest, std::abs(d));
    }
  }
  return largest;
}

/// One pass, and the heights at which the next one asks what it left.
struct Step {
  ErrorMap map;              ///< at the heights asked for
  std::vector<double> left;  ///< at the points over the height [m]
  bool without_feedback = false;
};

Step step(const Setting& setting, MapOptions options,
          const numerics::LagrangeBasis& over_height) {
  options.heights = map_heights(options, setting.setup.cut.a_p);
  const std::size_t wanted = options.heights.size();
  if (options.influence_heights.empty()) {
    options.influence_heights = options.heights;
  }
  options.heights.insert(options.heights.end(), over_height.points().begin(),
                         over_height.points().end());
  Step out{.map = error_map(setting, options), .left = {}};
  if (!out.map.converged) {
    const Feedback asked = std::exchange(options.feedback, Feedback::none);
    ErrorMap straight = error_map(setting, options);
    if (largest_deflection(straight) < no_deflection) {
      out.map = std::move(straight);
      out.map.feedback = asked;
      out.without_feedback = true;
    }
  }
  if (out.map.converged) {
    out.left = means(out.map, wanted);
    out.map.rows.resize(wanted);
    out.map.error = error_of_rows(out.map.rows);
  }
  return out;
}

}  // namespace

PassSequence pass_sequence(const Setting& setting, const MapOptions& options,
                           std::span<const PassCut> cuts, const PassBodies& bodies) {
  if (setting.model == Model::quasi_static) {
    throw std::invalid_argument("quasi_static leaves no surface for the next pass");
  }
  const double a_p = setting.setup.cut.a_p;
  const numerics::LagrangeBasis over_height(0.0, a_p, points_over_height);
  std::vector<double> left(over_height.size(), 0.0);
  double thickness = bodies.wall ? bodies.wall->thickness : 0.0;
  PassSequence out;
  for (const PassCut& cut : cuts) {
    Setting now = setting;
    now.setup.cut.f_z = cut.f_z;
    now.setup.cut.engagement = engagement(setting.setup.cut.engagement, cut.a_e);
    std::optional<structure::Plate> wall = bodies.wall;
    if (wall) {
      wall = thinned(*wall, a_p, thickness);
    }
    now.bodies = bodies_at(bodies.cutter, wall, a_p);
    if (!out.passes.empty()) {
      std::vector<double> series(left.size());
      over_height.series(left, series);
      now.left = [over_height, series](double z) {
        return over_height.series_value(series, z);
      };
    }
    Step done = step(now, options, over_height);
    out.map = std::move(done.map);
    if (!out.map.converged) {
      return out;
    }
    PassOutcome outcome{.cut = cut,
                        .thickness_before = thickness,
                        .radial_depth = over_the_height(over_height, a_p, left),
                        .error = out.map.error,
                        .F_normal = out.map.F_normal,
                        .without_feedback = done.without_feedback};
    outcome.radial_depth.mean += cut.a_e;
    outcome.radial_depth.min += cut.a_e;
    outcome.radial_depth.max += cut.a_e;
    if (bodies.wall) {
      thickness +=
          over_the_height(over_height, a_p, done.left).mean - outcome.radial_depth.mean;
    }
    outcome.thickness_after = thickness;  // E-41
    left = std::move(done.left);
    out.passes.push_back(outcome);
  }
  return out;
}

}  // namespace trochoid::surface
