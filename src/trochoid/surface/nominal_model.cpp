#include <trochoid/surface/nominal_model.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/columns.h>
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

/// What each coefficient does to a place, added to what it did before.
/// @param values  of the moments of with_sum, or the sum alone: then nothing is known
void add_effects(std::span<const double> values, std::span<const double> row,
                 double share, std::array<double, columns>& per_K) {
  const std::size_t n = row.size() + 2;
  for (std::size_t c = 0; (c + 1) * n < values.size(); ++c) {
    per_K[c] += share * numerics::dot(row, values.subspan((c + 1) * n, row.size()));
  }
}

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
    heights.push_back(row.height);
  }
  return std::make_shared<Stations>(setting.bodies, places(rows), heights,
                                    LoadedWall{.a_p = a_p, .load = setting.load});
}

NominalModel::NominalModel(const Setting& setting, std::span<const Nominal> rows)
    : NominalModel(setting, rows, stations_for(setting, rows)) {}

NominalModel::NominalModel(const Setting& setting, std::span<const Nominal> rows,
                           std::shared_ptr<const Stations> stations)
    : setting_(setting),
      stations_(std::move(stations)),
      edges_(without_runout(setting.setup), setting.law, stations_->basis()),
      unit_(unit_moments(edges_, setting.tolerance)) {
  std::map<std::pair<std::size_t, double>, std::size_t> known;
  for (const Nominal& row : rows) {
    // Where along the wall a mean lies, the stations say; a pulse has its angle as well.
    const double travel = setting.model == Model::quasi_static ? row.travel : 0.0;
    Row place{.x = row.x, .share = stations_->grid().at(row.height)};
    for (std::size_t i = 0; i < place.share.count; ++i) {
      const Kind kind{place.share.first + i, travel};
      const auto [same, is_new] =
          known.try_emplace({kind.node, kind.travel}, kinds_.size());
      place.kinds[i] = same->second;
      if (is_new) {
        kinds_.push_back(kind);
      }
    }
    rows_.push_back(place);
  }
}

double NominalModel::largest_effect(const numerics::PeriodicPieces& moments) const {
  constexpr int samples = 24;
  const std::size_t n = edges_.values();
  const std::size_t points = n - 2;
  std::vector<double> values(moments.functions());
  double largest = 0.0;
  for (int i = 0; i < samples && values.size() > columns * n; ++i) {
    moments.value(unit::turn * (i + 0.3) / samples, values);
    for (std::size_t s = 0; s < stations_->count(); ++s) {
      for (std::size_t node = 0; node < stations_->grid().nodes().size(); ++node) {
        const auto row = stations_->row(s, node);
        largest = std::max(
            {largest,
             std::abs(numerics::dot(row, std::span(values).subspan(n, points))),
             std::abs(numerics::dot(row, std::span(values).subspan(2 * n, points)))});
      }
    }
  }
  return largest;
}

NominalModel::Value NominalModel::envelope(const numerics::PeriodicPieces& moments,
                                           std::span<const double> row,
                                           double height) const {
  const Side side = *side_of(setting_.setup.cut.engagement);
  const geometry::Cutter& cutter = edges_.setup().cutter;
  std::vector<double> only_sum(moments.functions());
  for (std::size_t q = 0; q < row.size(); ++q) {
    only_sum[q] = side.sigma * row[q];  // E-4
  }
  const HeightCut cut{side,
                      cutter.profile.D / 2,
                      cutter.teeth() * setting_.setup.cut.f_z,
                      0.0,
                      edge_places(edges_.setup(), height),
                      moments.combined(only_sum)};
  const int cycles = edges_.equal_teeth() ? 1 : cutter.teeth();
  const std::size_t points = points_per_feed * static_cast<std::size_t>(cycles);
  const auto share = 1.0 / static_cast<double>(points);
  const double step = setting_.setup.cut.f_z / points_per_feed;
  std::vector<double> profile(points);
  std::vector<double> values(moments.functions());
  Value value;
  for (std::size_t i = 0; i < points; ++i) {
    const SurfacePoint point =
        envelope_error(cut, (static_cast<double>(i) + 0.5) * step);
    profile[i] = point.error;
    moments.value(point.phi, values);
    add_effects(values, row, share * side.sigma, value.per_K);
  }
  if (setting_.probe_radius > 0) {
    profile = probe_reading(profile, step, setting_.probe_radius);
  }
  for (const double e : profile) {
    value.error += share * e;
  }
  return value;
}

NominalModel::Value NominalModel::at_level(const numerics::PeriodicPieces& moments,
                                           std::size_t station, const Kind& kind,
                                           Level level) const {
  const auto row = stations_->row(station, kind.node, level);
  const double height = stations_->height(kind.node, level);
  if (setting_.model == Model::envelope) {
    return envelope(moments, row, height);
  }
  const Side side = *side_of(setting_.setup.cut.engagement);
  const geometry::Cutter& cutter = edges_.setup().cutter;
  std::vector<double> values(moments.functions());
  Value value;
  const auto add = [&](double phi, double share) {
    moments.value(phi, values);
    value.error +=
        share * side.sigma * numerics::dot(row, std::span(values).first(row.size()));
    add_effects(values, row, share * side.sigma, value.per_K);
  };
  if (setting_.model == Model::quasi_static) {
    const int cycles = edges_.equal_teeth() ? 1 : cutter.teeth();
    for (int g = 0; g < cycles; ++g) {
      const double travel = kind.travel + g * setting_.setup.cut.f_z;
      add(setting_.phase +
              unit::turn * travel / (cutter.teeth() * setting_.setup.cut.f_z),
          1.0 / cycles);
    }
    return value;
  }
  for (const EdgePlace& tooth : edge_places(edges_.setup(), height)) {  // E-8
    const double share = 1.0 / cutter.teeth();
    add(side.theta + tooth.behind, share);
    value.error -= share * (tooth.R - cutter.profile.D / 2);
  }
  return value;
}

NominalModel::Value NominalModel::value(const numerics::PeriodicPieces& moments,
                                        std::size_t station, const Kind& kind) const {
  Value value = at_level(moments, station, kind, Level::there);
  if (setting_.model == Model::envelope && setting_.probe_radius > 0) {
    const Value low = at_level(moments, station, kind, Level::below);
    const Value high = at_level(moments, station, kind, Level::above);
    const double dz = stations_->height(kind.node, Level::above) -
                      stations_->height(kind.node, Level::below);
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
  Prediction result{std::vector<double>(rows_.size()),
                    std::vector<double>(rows_.size() * columns), true};
  std::vector<double> weights(stations_->count());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    stations_->weights(row.x, weights);
    for (std::size_t s = 0; s < weights.size(); ++s) {
      for (std::size_t k = 0; weights[s] != 0 && k < row.share.count; ++k) {
        const Value& value = grid[s * kinds_.size() + row.kinds[k]];
        const double w = weights[s] * row.share.weights[k];
        result.error[i] += w * value.error;
        for (std::size_t c = 0; c < columns; ++c) {
          result.per_K[i * columns + c] += w * value.per_K[c];
        }
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
  Prediction result = along_the_wall(grid);
  result.blind = uncertain * setting_.tolerance * largest_effect(moments);
  return result;
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
