#include <trochoid/surface/error_map.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/surface/also_bent.h>
#include <trochoid/surface/envelope.h>
#include <trochoid/surface/nominal_model.h>
#include <trochoid/surface/probe.h>
#include <trochoid/surface/turn.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace trochoid::surface {

namespace {

constexpr int default_heights = 21;

/// How many samples there are along the feed.
int samples_of(const MapOptions& options) {
  return static_cast<int>(
      std::max(1L, std::lround(options.samples_per_turn * options.turns)));
}

/// What all heights of a pass share.
struct Pass {
  const Setting& setting;
  const MapOptions& options;
  const Compliance& compliance;
  Side side;
  double feed;  ///< per turn [m]
  std::optional<AlsoBent> also_bent;
  numerics::PeriodicPieces moments;
};

double tolerance_of(const Setting& setting, const MapOptions& options) {
  return std::min(setting.tolerance, options.tolerance);
}

/// Moments over a turn, in the steady state if there is feedback.
numerics::PeriodicPieces moments_of(const Setting& setting, const MapOptions& options,
                                    const EdgeMoments& edges,
                                    const Compliance& compliance, ErrorMap& map) {
  const auto K = wall_coefficients(setting.law);
  if (options.feedback == Feedback::none) {
    return with_coefficients(unit_moments(edges, tolerance_of(setting, options)), K);
  }
  SteadyState state =
      steady_state(edges, K, compliance, options.feedback, setting.tolerance);
  map.converged = state.converged;
  map.found = state.found;
  map.turns = state.turns;
  map.change = state.change;
  return std::move(state.moments);
}

/// Deflection and path at one height.
HeightCut height_cut(const Pass& pass, double height, std::span<const double> row) {
  const force::Setup& setup = pass.setting.setup;
  HeightCut cut{
      .side = pass.side,
      .R = setup.cutter.profile.D / 2,
      .feed = pass.feed,
      .x_0 = pass.options.position - pass.feed * pass.setting.phase / unit::turn,
      .teeth = edge_places(setup, height),
      .deflection = {}};
  if (!pass.also_bent) {
    cut.deflection = deflection(pass.moments, row, pass.side.sigma);
    return cut;
  }
  cut.deflection = pass.also_bent->deflection(height, row);
  cut.along = pass.also_bent->along(height);
  if (cut.along.functions() != 0) {
    const std::array<double, 1> opposite = {-1.0};
    cut.most_along = std::max(-cut.along.lower_bound(0),
                              -cut.along.combined(opposite).lower_bound(0));
  }
  return cut;
}

void put(double x, const SurfacePoint& point, ErrorRow& row) {
  const bool cut = point.error <= row.stock;
  row.x.push_back(x);
  row.error.push_back(cut ? point.error : row.stock);  // E-41
  row.tooth.push_back(cut ? point.tooth : -1);
}

void put_imprints(const Pass& pass, const HeightCut& cut, ErrorRow& row) {
  const int turns = std::max(1, static_cast<int>(std::lround(pass.options.turns)));
  for (int n = 0; n < turns; ++n) {
    for (const SurfacePoint& point : imprint_errors(cut)) {
      std::vector<double> u_x(std::max<std::size_t>(1, cut.along.functions()));
      if (cut.along.functions() != 0) {
        cut.along.value(point.phi, u_x);
      }
      put(cut.x_0 + pass.feed * (point.phi / unit::turn + n) + u_x[0], point, row);
    }
  }
}

void put_pulse(const Pass& pass, const HeightCut& cut, ErrorRow& row) {
  const force::Setup& setup = pass.setting.setup;
  const auto tips = edge_places(setup, 0.0);
  const double step = pass.feed / pass.options.samples_per_turn;
  for (int k = 0; k < samples_of(pass.options); ++k) {
    const double phi =
        pass.setting.phase + unit::turn * k / pass.options.samples_per_turn;
    const std::size_t tooth = last_entered(tips, entry_angle(setup), phi);
    put(step * k, quasi_static_error(cut, tooth, phi), row);
  }
}

void put_envelope(const Pass& pass, const HeightCut& cut, ErrorRow& row) {
  const double step = pass.feed / pass.options.samples_per_turn;
  for (int k = 0; k < samples_of(pass.options); ++k) {
    const double x = pass.options.position + step * k;
    put(x, envelope_error(cut, x), row);
  }
  if (pass.setting.probe_radius > 0) {
    row.error = probe_reading(row.error, step, pass.setting.probe_radius);
  }
  row.waves =
      feed_waves(row.error, pass.options.turns, pass.setting.setup.cutter.teeth());
}

void put_errors(const Pass& pass, const HeightCut& cut, ErrorRow& row) {
  switch (pass.setting.model) {
    case Model::quasi_static:
      return put_pulse(pass, cut, row);
    case Model::imprint:
      return put_imprints(pass, cut, row);
    case Model::envelope:
      return put_envelope(pass, cut, row);
  }
}

/// A probe reads more where the wall leans over the height.
void add_slopes(double radius, std::vector<ErrorRow>& rows) {
  std::vector<double> heights;
  std::vector<double> mean;
  for (const ErrorRow& row : rows) {
    heights.push_back(row.height);
    mean.push_back(mean_and_extremes(row.error).mean);
  }
  const std::vector<double> more = readings_on_slopes(radius, heights, mean);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (double& e : rows[i].error) {
      e += more[i];
    }
  }
}

void add_forces(const Pass& pass, ErrorMap& map) {
  const std::vector<double>& angles = pass.options.angles;
  const double phase = pass.setting.phase;
  const auto samples = angles.empty()
                           ? static_cast<std::size_t>(samples_of(pass.options))
                           : angles.size();
  std::vector<double> values(pass.moments.functions());
  std::vector<double> normal;
  std::vector<double> along;
  for (std::size_t k = 0; k < samples; ++k) {
    const double travelled = angles.empty() ? unit::turn * static_cast<double>(k) /
                                                  pass.options.samples_per_turn
                                            : angles[k] - phase;
    const double phi = phase + travelled;
    pass.moments.value(phi, values);
    const double F_x = values[values.size() - 2];
    const double F_y = values[values.size() - 1];
    map.forces.push_back({phi,
                          pass.options.position + pass.feed * travelled / unit::turn,
                          F_x, F_y, pass.side.sigma * F_y});
    normal.push_back(map.forces.back().F_normal);
    along.push_back(F_x);
  }
  map.F_normal = mean_and_extremes(normal);
  map.F_x = mean_and_extremes(along);
}

void add_rows(const Pass& pass, const std::vector<double>& heights, ErrorMap& map) {
  const std::vector<double> rows = pass.compliance.rows(heights);
  const std::size_t points = pass.compliance.basis().size();
  map.rows.resize(heights.size());
  numerics::for_each_index(heights.size(), [&](std::size_t i) {
    ErrorRow& row = map.rows[i];
    row.height = heights[i];
    if (pass.setting.left) {
      row.stock = radial_depth(pass.setting.setup.cut.engagement) +
                  pass.setting.left(heights[i]);
    }
    const HeightCut cut =
        height_cut(pass, heights[i], std::span(rows).subspan(i * points, points));
    put_errors(pass, cut, row);
    std::vector<double> value(1);
    for (const ForceSample& force : map.forces) {
      cut.deflection.value(force.phi, value);
      row.deflection.push_back(value[0]);
    }
  });
  if (pass.setting.model == Model::envelope && pass.setting.probe_radius > 0) {
    add_slopes(pass.setting.probe_radius, map.rows);
  }
}

void add_statistics(int teeth, ErrorMap& map) {
  for (ErrorRow& row : map.rows) {
    row.statistics = error_statistics(row.error, row.tooth, teeth);
  }
  map.error = error_of_rows(map.rows);
}

/// How the imprints grow with the coefficients.
void add_per_K(const Pass& pass, ErrorMap& map) {
  std::vector<Nominal> nominal;
  for (const ErrorRow& row : map.rows) {
    nominal.push_back(
        {.x = pass.options.position, .height = row.height, .readings = {0}});
  }
  const auto rigid =
      NominalModel(pass.setting, nominal).rigid(wall_coefficients(pass.setting.law));
  for (std::size_t i = 0; i < map.rows.size(); ++i) {
    map.rows[i].per_K = {rigid.per_K[i * columns], rigid.per_K[i * columns + 1]};
  }
}

/// The first of those that are largest but for rounding: equal teeth make equal peaks.
const ForceSample& largest_of(const std::vector<ForceSample>& forces) {
  constexpr double rounding = 1e-9;
  const auto size = [](const ForceSample& one) { return std::abs(one.F_y); };
  const double most = size(*std::ranges::max_element(forces, {}, size));
  return *std::ranges::find_if(forces, [&](const ForceSample& one) {
    return size(one) >= (1 - rounding) * most;
  });
}

DeflectedShape shape_at_largest_force(const Pass& pass, const ErrorMap& map) {
  const ForceSample& peak = largest_of(map.forces);
  std::vector<double> moments(pass.moments.functions());
  pass.moments.value(peak.phi, moments);
  DeflectedShape shape = deflected_shape(pass.compliance, moments, pass.side.sigma);
  shape.phi = peak.phi;
  return shape;
}

void add_compliance(const Pass& pass, const std::vector<double>& heights,
                    ErrorMap& map) {
  const Compliance& compliance = pass.compliance;
  map.influence_heights =
      pass.options.influence_heights.empty() ? heights : pass.options.influence_heights;
  map.influence_of_cutter =
      compliance.of_cutter(map.influence_heights, map.influence_heights);
  map.influence_of_wall =
      compliance.of_wall(map.influence_heights, map.influence_heights);
  const std::vector<double> whole = compliance.concentrated(heights);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    map.rows[i].compliance = whole[i];
  }
}

}  // namespace

std::vector<double> map_heights(const MapOptions& options, double a_p) {
  std::vector<double> heights = options.heights;
  if (heights.empty()) {
    for (int i = 0; i + 1 < default_heights; ++i) {
      heights.push_back(a_p * i / (default_heights - 1));
    }
    heights.push_back(a_p);  // not a bit more: there is no wall above
  }
  return heights;
}

MeanAndExtremes error_of_rows(std::span<const ErrorRow> rows) {
  MeanAndExtremes all{.min = rows.front().statistics.error.min,
                      .max = rows.front().statistics.error.max};
  for (const ErrorRow& row : rows) {
    const MeanAndExtremes& e = row.statistics.error;
    all.mean += e.mean / static_cast<double>(rows.size());
    all.min = std::min(all.min, e.min);
    all.max = std::max(all.max, e.max);
  }
  return all;
}

ErrorMap error_map(const Setting& setting, const MapOptions& options,
                   const std::function<void()>& wall_solved) {
  const force::Setup& setup = setting.setup;
  const double a_p = setup.cut.a_p;
  const Side side = side_of(setting);
  if (!setting.also_bends.empty() && options.feedback != Feedback::none) {
    throw std::invalid_argument("also_bends knows no feedback");
  }
  ErrorMap map{.model = setting.model, .feedback = options.feedback};
  const Compliance compliance(setting.bodies(options.position), a_p, options.position,
                              setting.load);
  if (wall_solved) {
    wall_solved();
  }
  const EdgeMoments edges(setup, setting.law, compliance.basis(), setting.left);
  Pass pass{.setting = setting,
            .options = options,
            .compliance = compliance,
            .side = side,
            .feed = setup.cutter.teeth() * setup.cut.f_z};
  if (setting.also_bends.empty()) {
    pass.moments = moments_of(setting, options, edges, compliance, map);
  } else {
    pass.also_bent.emplace(setting, edges, compliance, tolerance_of(setting, options));
    pass.moments = pass.also_bent->moments();
  }
  if (!map.converged) {
    return map;
  }
  const std::vector<double> heights = map_heights(options, a_p);
  add_forces(pass, map);
  add_rows(pass, heights, map);
  add_statistics(setup.cutter.teeth(), map);
  if (setting.model == Model::imprint && !setting.left) {
    add_per_K(pass, map);
  }
  if (compliance.bodies().cutter || compliance.bodies().wall) {
    map.shape = shape_at_largest_force(pass, map);
  }
  add_compliance(pass, heights, map);
  return map;
}

}  // namespace trochoid::surface
