#include <trochoid/base/units.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/surface/envelope.h>
#include <trochoid/surface/probe.h>
#include <trochoid/surface/station_envelopes.h>
#include <trochoid/surface/tooth_model.h>
#include <trochoid/surface/turn.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trochoid::surface {

namespace {

/// Points of a tooth feed between which an envelope is interpolated.
constexpr std::size_t points_per_feed = 32;

double deflection_of(std::span<const double> row, std::span<const double> moments) {
  double sum = 0.0;
  for (std::size_t q = 0; q < row.size(); ++q) {
    sum += row[q] * moments[q];  // E-4
  }
  return sum;
}

/// Readings of which one thread takes care at a time.
constexpr std::size_t block = 4096;

}  // namespace

template <class ErrorAt>
std::vector<double> ToothModel::along_the_wall(const ErrorAt& error_at) const {
  std::vector<double> errors(readings_.size());
  const std::size_t blocks = (errors.size() + block - 1) / block;
  numerics::for_each_index(blocks, [&](std::size_t b) {
    std::vector<double> weights(stations_->count());
    const std::size_t end = std::min(errors.size(), (b + 1) * block);
    for (std::size_t i = b * block; i < end; ++i) {
      const HeightShare& share = places_[i].height;
      stations_->weights(readings_[i].x, weights);
      const auto at = error_at(i);
      for (std::size_t s = 0; s < weights.size(); ++s) {
        for (std::size_t k = 0; weights[s] != 0 && k < share.count; ++k) {
          errors[i] += weights[s] * share.weights[k] * at(s, share.first + k);
        }
      }
    }
  });
  return errors;
}

void ToothModel::moments_at(const Forces& forces, std::span<const double, columns> K,
                            double phi, std::span<double> out) {
  const std::size_t n = out.size();
  std::vector<double> from_table;
  const double* m = nullptr;
  if (forces.angles.empty()) {
    from_table.resize(forces.table.functions());
    forces.table.value(phi, from_table);
    m = from_table.data();
  } else {
    const auto at = std::lower_bound(forces.angles.begin(), forces.angles.end(), phi) -
                    forces.angles.begin();
    m = forces.values.data() + static_cast<std::size_t>(at) * columns * n;
  }
  std::fill(out.begin(), out.end(), 0.0);
  for (std::size_t c = 0; c < columns; ++c) {
    for (std::size_t q = 0; q < n; ++q) {
      out[q] += K[c] * m[c * n + q];
    }
  }
}

double ToothModel::deflection_at(const Forces& forces,
                                 std::span<const double, columns> K, double phi,
                                 std::size_t station, std::size_t node) const {
  const auto row = stations_->row(station, node);
  std::vector<double> moments(row.size() + 2);
  if (forces.bent.empty()) {
    moments_at(forces, K, phi, moments);
  } else {
    forces.bent[station].value(phi, moments);
  }
  return deflection_of(row, moments);
}

std::vector<double> ToothModel::predict(const Forces& forces,
                                        std::span<const double, columns> K,
                                        RunoutVector runout, double x_0) const {
  const force::Setup setup = with(runout);
  switch (setting_.model) {
    case Model::quasi_static:
      return predict_pulses(forces, K, setup);
    case Model::imprint:
      return predict_imprints(forces, K, setup);
    case Model::envelope:
      break;
  }
  return predict_envelope(forces, K, setup, x_0);
}

std::vector<double> ToothModel::predict_pulses(const Forces& forces,
                                               std::span<const double, columns> K,
                                               const force::Setup& setup) const {
  const Side side = *side_of(setup.cut.engagement);
  const double R = setup.cutter.profile.D / 2;
  const std::vector<EdgePlace> tips = edge_places(setup, 0.0);
  std::vector<std::vector<EdgePlace>> teeth;
  for (const double height : stations_->grid().nodes()) {
    teeth.push_back(edge_places(setup, height));
  }
  return along_the_wall([&](std::size_t i) {
    const double phi = places_[i].phi;
    return [&, phi, tooth = last_entered(tips, entry_angle(setup), phi)](
               std::size_t s, std::size_t node) {
      return side.sigma * deflection_at(forces, K, phi, s, node) -
             (teeth[node][tooth].R - R);  // E-7
    };
  });
}

std::vector<double> ToothModel::predict_imprints(const Forces& forces,
                                                 std::span<const double, columns> K,
                                                 const force::Setup& setup) const {
  const Side side = *side_of(setup.cut.engagement);
  const std::size_t teeth = static_cast<std::size_t>(setup.cutter.teeth());
  const std::vector<double>& nodes = stations_->grid().nodes();
  std::vector<double> table(stations_->count() * nodes.size() * teeth);
  // The forces may be those of another runout: known at its own angles only.
  const force::Setup there = with(forces.runout);
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const auto places = edge_places(setup, nodes[node]);
    const auto touch = edge_places(there, nodes[node]);
    for (std::size_t tooth = 0; tooth < teeth; ++tooth) {
      const double phi = within_turn(side.theta + touch[tooth].behind);
      for (std::size_t s = 0; s < stations_->count(); ++s) {
        table[(s * nodes.size() + node) * teeth + tooth] =
            side.sigma * deflection_at(forces, K, phi, s, node) -
            (places[tooth].R - setup.cutter.profile.D / 2);  // E-8
      }
    }
  }
  return along_the_wall([&](std::size_t i) {
    return [&, tooth = places_[i].tooth](std::size_t s, std::size_t node) {
      return table[(s * nodes.size() + node) * teeth + tooth];
    };
  });
}

std::vector<double> ToothModel::profiles(
    std::span<const numerics::PeriodicPieces> moments, const force::Setup& setup,
    std::size_t node) const {
  const auto n = static_cast<std::size_t>(setup.cutter.teeth()) * points_per_feed;
  auto all =
      StationEnvelopes(*stations_, moments, setup, node, Level::there).profiles(n);
  if (setting_.probe_radius <= 0) {
    return all;
  }
  constexpr std::size_t slope_points = 6;  // of a tooth feed: the same above and below
  const std::size_t count =
      slope_points * static_cast<std::size_t>(setup.cutter.teeth());
  const auto at_level = [&](Level level) {
    return StationEnvelopes(*stations_, moments, setup, node, level).profiles(count);
  };
  const std::vector<double> below = at_level(Level::below);
  const std::vector<double> above = at_level(Level::above);
  const double dz =
      stations_->height(node, Level::above) - stations_->height(node, Level::below);
  const double step = setup.cut.f_z / static_cast<double>(points_per_feed);
  for (std::size_t s = 0; s < stations_->count(); ++s) {
    const auto mean = [&](const std::vector<double>& of) {
      const auto from = of.begin() + static_cast<std::ptrdiff_t>(s * count);
      return std::accumulate(from, from + static_cast<std::ptrdiff_t>(count), 0.0) /
             static_cast<double>(count);
    };
    const double more =
        reading_on_slope(setting_.probe_radius, (mean(above) - mean(below)) / dz);
    const auto profile = std::span(all).subspan(s * n, n);
    const auto read = probe_reading(profile, step, setting_.probe_radius);
    std::transform(read.begin(), read.end(), profile.begin(),
                   [more](double e) { return e + more; });
  }
  return all;
}

std::vector<double> ToothModel::predict_envelope(const Forces& forces,
                                                 std::span<const double, columns> K,
                                                 const force::Setup& setup,
                                                 double x_0) const {
  const auto n = static_cast<std::size_t>(setup.cutter.teeth()) * points_per_feed;
  const double feed = setup.cutter.teeth() * setup.cut.f_z;
  const std::vector<numerics::PeriodicPieces> moments =
      forces.bent.empty() ? std::vector{with_coefficients(forces.table, K)}
                          : forces.bent;
  std::vector<std::vector<double>> at_nodes(stations_->grid().nodes().size());
  numerics::for_each_index(at_nodes.size(), [&](std::size_t node) {
    at_nodes[node] = profiles(moments, setup, node);
  });
  return along_the_wall([&](std::size_t i) {
    const double u = (readings_[i].travel - x_0) / feed;
    const double at = (u - std::floor(u)) * static_cast<double>(n);
    const std::size_t k = std::min(static_cast<std::size_t>(at), n - 1);
    const double t = at - static_cast<double>(k);
    return [&, k, t](std::size_t s, std::size_t node) {
      const double* profile = at_nodes[node].data() + s * n;
      return (1 - t) * profile[k] + t * profile[(k + 1) % n];
    };
  });
}

}  // namespace trochoid::surface
