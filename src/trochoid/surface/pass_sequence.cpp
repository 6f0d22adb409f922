#include <trochoid/surface/pass_sequence.h>

#include <algorithm>
#include <cmath>
#include <functional>
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

/// Heights nearer to each other than this are the same [m].
constexpr double same_level = 1e-9;

/// A part of the wall that passes go over, from its top down by the axial depth.
struct WallBand {
  double below = 0.0;             ///< of its top below the free edge [m]
  bool cut = false;               ///< by a pass before
  double thickness = 0.0;         ///< of the wall there; 0: rigid [m]
  std::vector<double> left = {};  ///< by the pass before, at the points [m]
};

/// All levels of the passes, from the lowest up.
std::vector<WallBand> levels_of(std::span<const PassCut> cuts, double a_p,
                                double thickness, std::size_t points) {
  std::vector<WallBand> levels;
  for (const PassCut& cut : cuts) {
    bool known = false;
    for (const WallBand& level : levels) {
      const double apart = std::abs(level.below - cut.below);
      known = known || apart < same_level;
      if (apart >= same_level && apart < a_p - same_level) {
        throw std::invalid_argument("levels of passes overlap");
      }
    }
    if (!known) {
      levels.push_back({.below = cut.below,
                        .thickness = thickness,
                        .left = std::vector<double>(points)});
    }
  }
  std::ranges::sort(levels, std::greater<>(), &WallBand::below);
  return levels;
}

/// The wall before a pass: thinner where passes before have cut.
structure::Plate thinned(structure::Plate wall, double a_p,
                         std::span<const WallBand> levels) {
  const double whole = wall.thickness;
  double above = 0.0;  // where the last level ended
  for (const WallBand& level : levels) {
    if (!level.cut) {
      continue;
    }
    const double top = wall.height - level.below;
    const double from = top - a_p;
    if (from < same_level) {
      wall.thickness = level.thickness;
    } else {
      if (above > 0 && from - above > same_level) {
        wall.layers.push_back({.from = above, .thickness = whole});
      }
      wall.layers.push_back({.from = from, .thickness = level.thickness});
    }
    above = top;
  }
  if (above > 0 && wall.height - above > same_level) {
    wall.layers.push_back({.from = above, .thickness = whole});
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

StockLeft stock_left(const numerics::LagrangeBasis& basis,
                     const std::vector<double>& values) {
  std::vector<double> series(values.size());
  basis.series(values, series);
  return [basis, series](double z) { return basis.series_value(series, z); };
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
  std::vector<WallBand> levels = levels_of(
      cuts, a_p, bodies.wall ? bodies.wall->thickness : 0.0, over_height.size());
  PassSequence out;
  for (const PassCut& cut : cuts) {
    WallBand& level = *std::ranges::find_if(levels, [&](const WallBand& l) {
      return std::abs(l.below - cut.below) < same_level;
    });
    Setting now = setting;
    now.setup.cut.f_z = cut.f_z;
    now.setup.cut.engagement = engagement(setting.setup.cut.engagement, cut.a_e);
    std::optional<structure::Plate> wall = bodies.wall;
    if (wall) {
      wall = thinned(*wall, a_p, levels);
    }
    now.bodies = bodies_at(bodies.cutter, wall, a_p, cut.below);
    if (level.cut) {
      now.left = stock_left(over_height, level.left);
    }
    Step done = step(now, options, over_height);
    out.map = std::move(done.map);
    if (!out.map.converged) {
      return out;
    }
    PassOutcome outcome{.cut = cut,
                        .thickness_before = level.thickness,
                        .radial_depth = over_the_height(over_height, a_p, level.left),
                        .error = out.map.error,
                        .F_normal = out.map.F_normal,
                        .without_feedback = done.without_feedback};
    outcome.radial_depth.mean += cut.a_e;
    outcome.radial_depth.min += cut.a_e;
    outcome.radial_depth.max += cut.a_e;
    level.left = std::move(done.left);
    level.cut = true;
    if (bodies.wall) {
      level.thickness += over_the_height(over_height, a_p, level.left).mean -
                         outcome.radial_depth.mean;  // E-41
    }
    outcome.thickness_after = level.thickness;
    out.passes.push_back(outcome);
  }
  return out;
}

}  // namespace trochoid::surface
