#include <trochoid/surface/error_map.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/bodies.h>
#include <trochoid/surface/edge_moments.h>
#include <trochoid/surface/envelope.h>
#include <trochoid/surface/nominal_model.h>
#include <trochoid/surface/probe.h>
#include <trochoid/surface/setting.h>
#include <trochoid/surface/stepwise_turn.h>
#include <trochoid/surface/turn.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

namespace trochoid::surface {
namespace {

/// @brief Deflections by forces along the feed and along the axis, to the first order:
/// they leave the chip as it is.
///
/// @eq E-43 u_y += -sum_q [dG_c/dz m_q^cz + dG_w/dz m_q^wz]                  (z)
///          u_y += -sum_q dG_w/dx m_q^wx,  u_x = sum_q G_c m_q^x            (x)
/// @src derived from the work of the forces on tilted sections: B-10, B-12
class AlsoBent {
 public:
  /// @param compliance  must outlive this
  /// @param tolerance   relative, of each kind of moment
  AlsoBent(const Setting& setting, const EdgeMoments& edges,
           const Compliance& compliance, double tolerance);

  /// @brief Deflection across the wall at one height: E-4 with what E-43 adds.
  /// @param row  G_q of E-5 [m/N], shape (basis points)
  /// @return delta [m], one function
  [[nodiscard]] numerics::PeriodicPieces deflection(double height,
                                                    std::span<const double> row) const;

  /// @brief u_x at one height [m], one function; none where x bends nothing.
  [[nodiscard]] numerics::PeriodicPieces along(double height) const;

  /// Moments, F_x and F_y as of with_coefficients.
  [[nodiscard]] numerics::PeriodicPieces moments() const;

 private:
  const Compliance& compliance_;
  double sigma_;
  bool x_;
  bool z_;
  numerics::PeriodicPieces all_;  ///< those of E-42, then moments, F_x and F_y
};

constexpr std::size_t kinds = 4;  ///< of E-42
enum Kind : std::size_t { along_x, wall_x, cutter_z, wall_z };

bool has(const Setting& setting, AlsoBends axis) {
  return std::ranges::find(setting.also_bends, axis) != setting.also_bends.end();
}

LeverArms lever_arms(const Setting& setting, const Compliance& compliance) {
  const double thickness =
      compliance.bodies().wall ? compliance.bodies().wall->thickness : 0.0;
  return {.sigma = side_of(setting).sigma,
          .mid_plane = setting.setup.cutter.profile.D / 2 -
                       radial_depth(setting.setup.cut.engagement) + thickness / 2};
}

/// What may be wrong with each function: a part of the largest of its kind.
std::vector<double> allowed_errors(const numerics::PeriodicPieces::Function& f,
                                   std::size_t points, double tolerance) {
  constexpr int samples = 90;
  const std::size_t functions = kinds * points + points + 2;
  std::vector<double> values(functions);
  std::vector<double> largest(kinds + 1);
  for (int i = 0; i < samples; ++i) {
    f(unit::turn * (i + 0.3) / samples, values);
    for (std::size_t k = 0; k < functions; ++k) {
      double& most = largest[std::min(k / points, kinds)];
      most = std::max(most, std::abs(values[k]));
    }
  }
  std::vector<double> allowed(functions);
  for (std::size_t k = 0; k < functions; ++k) {
    const double most = largest[std::min(k / points, kinds)];
    allowed[k] = most > 0 ? tolerance * most : std::numeric_limits<double>::infinity();
  }
  return allowed;
}

numerics::PeriodicPieces all_moments(const Setting& setting, const EdgeMoments& edges,
                                     const LeverArms& arms, double tolerance) {
  const auto K = wall_coefficients(setting.law);
  const std::size_t points = edges.basis().size();
  const std::size_t n = edges.values();
  const numerics::PeriodicPieces::Function f = [&](double phi, std::span<double> out) {
    edges.couples_at(phi, arms, out.first(kinds * points));
    std::vector<double> unit(columns * n);
    edges.at(phi, nullptr, unit);
    const std::span<double> sums = out.subspan(kinds * points);
    std::fill(sums.begin(), sums.end(), 0.0);
    for (std::size_t i = 0; i < unit.size(); ++i) {
      sums[i % n] += K[i / n] * unit[i];
    }
  };
  const std::vector<double> one = {1.0};
  numerics::PeriodicPieces::Options options =
      panels_for(edges, edges.equal_teeth(), one, tolerance);
  options.allowed = allowed_errors(f, points, tolerance);
  return {f, options};
}

AlsoBent::AlsoBent(const Setting& setting, const EdgeMoments& edges,
                   const Compliance& compliance, double tolerance)
    : compliance_(compliance),
      sigma_(side_of(setting).sigma),
      x_(has(setting, AlsoBends::x)),
      z_(has(setting, AlsoBends::z)),
      all_(all_moments(setting, edges, lever_arms(setting, compliance), tolerance)) {}

numerics::PeriodicPieces AlsoBent::deflection(double height,
                                              std::span<const double> row) const {
  const std::size_t points = row.size();
  std::vector<double> weights(all_.functions());
  const auto add = [&](std::size_t first, std::span<const double> G, double factor) {
    for (std::size_t q = 0; q < points; ++q) {
      weights[first + q] += factor * G[q];
    }
  };
  const std::span<const double> at(&height, 1);
  add(kinds * points, row, sigma_);  // E-4
  if (z_) {                          // E-43
    add(cutter_z * points, compliance_.of_cutter_couples(at), -sigma_);
    add(wall_z * points, compliance_.of_wall_couples(at, structure::Along::y), -sigma_);
  }
  if (x_) {
    add(wall_x * points, compliance_.of_wall_couples(at, structure::Along::x), -sigma_);
  }
  return all_.combined(weights);
}

numerics::PeriodicPieces AlsoBent::along(double height) const {
  if (!x_ || !compliance_.bodies().cutter) {
    return {};
  }
  const std::span<const double> at(&height, 1);
  const std::vector<double> G = compliance_.of_cutter(at, compliance_.basis().points());
  std::vector<double> weights(all_.functions());
  std::ranges::copy(G,
                    weights.begin() + static_cast<std::ptrdiff_t>(along_x * G.size()));
  return all_.combined(weights);
}

numerics::PeriodicPieces AlsoBent::moments() const {
  const std::size_t points = compliance_.basis().size();
  const std::size_t n = points + 2;
  std::vector<double> weights(n * all_.functions());
  for (std::size_t q = 0; q < n; ++q) {
    weights[q * all_.functions() + kinds * points + q] = 1.0;
  }
  return all_.combined(weights);
}

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
  const auto straight = [&] {
    return with_coefficients(unit_moments(edges, tolerance_of(setting, options)), K);
  };
  if (options.feedback == Feedback::none) {
    return straight();
  }
  if (options.stepwise && !setting.left) {
    const StepwiseTurn turn = stepwise_steady_state(setting.setup, setting.law, K,
                                                    compliance, options.feedback);
    if (turn.converged) {
      return with_feedback(straight(), turn);
    }
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
