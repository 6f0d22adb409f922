#include <trochoid/surface/nominal_model.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/surface/envelope.h>
#include <trochoid/surface/probe.h>
#include <trochoid/surface/turn.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace trochoid::surface {

namespace {

/// Points of a tooth feed over which an envelope is averaged.
constexpr std::size_t points_per_feed = 24;

force::Setup without_runout(force::Setup setup) {
  setup.runout = {};
  return setup;
}

std::vector<double> places(std::span<const Nominal> rows) {
  std::vector<double> x;
  for (const Nominal& row : rows) {
    x.push_back(row.x);
  }
  return x;
}

/// Forces are known to so many tolerances of their largest value.
constexpr double uncertain = 3;

/// Coefficients first, then the sum with K: the search for the envelope wants the sum.
numerics::PeriodicPieces with_sum(const numerics::PeriodicPieces& unit,
                                  std::span<const double, columns> K) {
  const std::size_t n = unit.functions() / columns;
  std::vector<double> weights((columns + 1) * n * unit.functions());
  for (std::size_t q = 0; q < n; ++q) {
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t from = c * n + q;
      weights[q * unit.functions() + from] = K[c];
      weights[((c + 1) * n + q) * unit.functions() + from] = 1.0;
    }
  }
  return unit.combined(weights);
}

}  // namespace

Side side_of(const Setting& setting) {
  const auto side = side_of(setting.setup.cut.engagement);
  if (!side) {
    throw std::invalid_argument("a slot or a band leaves no single wall");
  }
  return *side;
}

double entry_angle(const force::Setup& setup) {
  const auto* down = std::get_if<geometry::DownMilling>(&setup.cut.engagement);
  return down == nullptr
             ? 0.0
             : std::numbers::pi -
                   std::acos(1 - 2 * down->a_e / setup.cutter.profile.D);  // E-12
}

std::shared_ptr<const Stations> NominalModel::stations_for(
    const Setting& setting, std::span<const Nominal> rows) {
  const double a_p = setting.setup.cut.a_p;
  std::vector<double> heights;
  for (const Nominal& row : rows) {
    const auto around = heights_around(row.height, a_p);
    heights.insert(heights.end(), around.begin(), around.end());
  }
  return std::make_shared<Stations>(setting.bodies, places(rows), heights, a_p,
                                    setting.load);
}

NominalModel::NominalModel(const Setting& setting, std::span<const Nominal> rows)
    : NominalModel(setting, rows, stations_for(setting, rows)) {}

NominalModel::NominalModel(const Setting& setting, std::span<const Nominal> rows,
                           std::shared_ptr<const Stations> stations)
    : setting_(setting),
      stations_(std::move(stations)),
      edges_(without_runout(setting.setup), setting.law, stations_->basis()),
      unit_(unit_moments(edges_, setting.tolerance)) {
  std::map<std::pair<double, double>, std::size_t> known;
  for (const Nominal& row : rows) {
    // Where along the wall a mean lies, the stations say; a pulse has its angle as well.
    const double travel = setting.model == Model::quasi_static ? row.travel : 0.0;
    const auto [same, is_new] =
        known.try_emplace({row.height, travel}, kinds_.size());
    kind_of_row_.push_back(same->second);
    if (is_new) {
      Kind kind{row.height, travel};
      const auto around = heights_around(row.height, setting.setup.cut.a_p);
      for (std::size_t i = 0; i < around.size(); ++i) {
        kind.rows[i] = stations_->height_index(around[i]);
      }
      kinds_.push_back(kind);
    }
    weights_.push_back(stations_->weights(row.x));
  }
}

void NominalModel::add_largest(const numerics::PeriodicPieces& deflections,
                               Value& value) const {
  constexpr int samples = 24;
  std::vector<double> values(deflections.functions());
  for (int i = 0; i < samples && values.size() > columns; ++i) {
    deflections.value(unit::turn * (i + 0.3) / samples, values);
    value.largest = std::max({value.largest, std::abs(values[1]), std::abs(values[2])});
  }
}

NominalModel::Value NominalModel::at_row(const numerics::PeriodicPieces& moments,
                                         std::span<const double> row,
                                         const Kind& kind) const {
  const Side side = *side_of(setting_.setup.cut.engagement);
  const geometry::Cutter& cutter = edges_.setup().cutter;
  const double feed = cutter.teeth() * setting_.setup.cut.f_z;
  const numerics::PeriodicPieces all = deflection(moments, row, side.sigma);
  std::vector<double> values(all.functions());
  Value value;
  add_largest(all, value);
  const auto add = [&](double phi, double share) {
    all.value(phi, values);
    for (std::size_t c = 0; c + 1 < values.size(); ++c) {
      value.per_K[c] += share * values[c + 1];
    }
  };
  const int cycles = edges_.equal_teeth() ? 1 : cutter.teeth();
  if (setting_.model == Model::quasi_static) {
    for (int g = 0; g < cycles; ++g) {
      const double travel = kind.travel + g * setting_.setup.cut.f_z;
      add(setting_.phase + unit::turn * travel / feed, 1.0 / cycles);
      value.error += values[0] / cycles;
    }
    return value;
  }
  std::vector<double> only_sum(all.functions());
  only_sum[0] = 1.0;
  const HeightCut cut{side,
                      cutter.profile.D / 2,
                      feed,
                      0.0,
                      edge_places(edges_.setup(), kind.height),
                      all.combined(only_sum)};
  if (setting_.model == Model::imprint) {
    for (const SurfacePoint& point : imprint_errors(cut)) {
      const double share = 1.0 / cutter.teeth();
      value.error += share * point.error;
      add(point.phi, share);
    }
    return value;
  }
  const std::size_t points = points_per_feed * static_cast<std::size_t>(cycles);
  const auto share = 1.0 / static_cast<double>(points);
  std::vector<double> profile(points);
  const double step = setting_.setup.cut.f_z / points_per_feed;
  for (std::size_t i = 0; i < points; ++i) {
    const SurfacePoint point =
        envelope_error(cut, (static_cast<double>(i) + 0.5) * step);
    profile[i] = point.error;
    add(point.phi, share);
  }
  if (setting_.probe_radius > 0) {
    profile = probe_reading(profile, step, setting_.probe_radius);
  }
  for (const double e : profile) {
    value.error += share * e;
  }
  return value;
}

NominalModel::Value NominalModel::value(const numerics::PeriodicPieces& moments,
                                        std::size_t station, const Kind& kind) const {
  Value value = at_row(moments, stations_->row(station, kind.rows[1]), kind);
  if (setting_.model == Model::envelope && setting_.probe_radius > 0) {
    const auto around = heights_around(kind.height, setting_.setup.cut.a_p);
    Kind below = kind;
    Kind above = kind;
    below.height = around[0];
    above.height = around[2];
    const Value low = at_row(moments, stations_->row(station, kind.rows[0]), below);
    const Value high = at_row(moments, stations_->row(station, kind.rows[2]), above);
    const double dz = above.height - below.height;
    const double r = setting_.probe_radius;
    const double slope = (high.error - low.error) / dz;
    value.error += reading_on_slope(r, slope);
    for (std::size_t c = 0; c < columns; ++c) {
      value.per_K[c] +=
          r * slope / std::hypot(1.0, slope) * (high.per_K[c] - low.per_K[c]) / dz;
    }
  }
  return value;
}

Prediction NominalModel::along_the_wall(const std::vector<Value>& grid) const {
  const std::size_t rows = kind_of_row_.size();
  Prediction result{std::vector<double>(rows), std::vector<double>(rows * columns),
                    true};
  for (const Value& value : grid) {
    result.blind =
        std::max(result.blind, uncertain * setting_.tolerance * value.largest);
  }
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t s = 0; s < stations_->count(); ++s) {
      const Value& value = grid[s * kinds_.size() + kind_of_row_[i]];
      result.error[i] += weights_[i][s] * value.error;
      for (std::size_t c = 0; c < columns; ++c) {
        result.per_K[i * columns + c] += weights_[i][s] * value.per_K[c];
      }
    }
  }
  return result;
}

Prediction NominalModel::rigid(std::span<const double, columns> K) const {
  const numerics::PeriodicPieces moments = with_sum(unit_, K);
  std::vector<Value> grid(stations_->count() * kinds_.size());
  numerics::for_each_index(grid.size(), [&](std::size_t i) {
    grid[i] = value(moments, i / kinds_.size(), kinds_[i % kinds_.size()]);
  });
  return along_the_wall(grid);
}

Prediction NominalModel::with_feedback_once(std::span<const double, columns> K,
                                            Feedback feedback) const {
  std::vector<Value> grid(stations_->count() * kinds_.size());
  bool good = true;
  for (std::size_t s = 0; s < stations_->count(); ++s) {
    const SteadyState state = steady_state(edges_, K, stations_->compliance(s),
                                           feedback, 10 * setting_.tolerance);
    good = good && state.converged;
    numerics::for_each_index(kinds_.size(), [&](std::size_t k) {
      grid[s * kinds_.size() + k] = value(state.moments, s, kinds_[k]);
    });
  }
  Prediction result = along_the_wall(grid);
  result.good = good;
  return result;
}

Prediction NominalModel::with_feedback(std::span<const double, columns> K,
                                       Feedback feedback) const {
  Prediction result = with_feedback_once(K, feedback);
  const double step = 1e-3 * std::max(std::hypot(K[0], K[1]), 1e6);
  for (std::size_t c = 0; c < 2; ++c) {
    std::array<double, columns> moved{};
    std::copy(K.begin(), K.end(), moved.begin());
    moved[c] += step;
    const Prediction there = with_feedback_once(moved, feedback);
    result.good = result.good && there.good;
    for (std::size_t i = 0; i < result.error.size(); ++i) {
      result.per_K[i * columns + c] = (there.error[i] - result.error[i]) / step;
    }
  }
  return result;
}

}  // namespace trochoid::surface
