#include <trochoid/surface/tooth_model.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/surface/envelope.h>
#include <trochoid/surface/pass.h>
#include <trochoid/surface/probe.h>
#include <trochoid/surface/station_envelopes.h>
#include <trochoid/surface/turn.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trochoid::surface {
namespace {

/// Pulses at more angles than this are read from a table over the turn.
constexpr std::size_t most_angles = 4000;

std::vector<double> heights_of(std::span<const Reading> readings) {
  std::vector<double> heights;
  for (const Reading& r : readings) {
    heights.push_back(r.height);
  }
  return heights;
}

std::vector<double> places_along(std::span<const Reading> readings) {
  std::vector<double> x;
  for (const Reading& r : readings) {
    x.push_back(r.x);
  }
  return x;
}

}  // namespace

std::shared_ptr<const Stations> stations_for(const Setting& setting,
                                             std::span<const Reading> readings,
                                             std::size_t most) {
  return std::make_shared<Stations>(
      setting.bodies, places_along(readings), heights_of(readings),
      LoadedWall{setting.setup.cut.a_p, setting.load, most});
}

ToothModel::ToothModel(const Setting& setting, std::span<const Reading> readings)
    : ToothModel(setting, readings,
                 stations_for(setting, readings, LoadedWall{}.most_stations)) {}

ToothModel::ToothModel(const Setting& setting, std::span<const Reading> readings,
                       std::shared_ptr<const Stations> stations)
    : setting_(setting),
      readings_(readings.begin(), readings.end()),
      stations_(std::move(stations)) {
  const double feed = setting.setup.cutter.teeth() * setting.setup.cut.f_z;
  places_.reserve(readings_.size());
  for (const Reading& r : readings_) {
    places_.push_back({.phi = within_turn(setting.phase + unit::turn * r.travel / feed),
                       .height = stations_->grid().at(r.height)});
  }
  find_teeth();
}

double ToothModel::within_turn(double phi) noexcept {
  return phi - unit::turn * std::floor(phi / unit::turn);
}

void ToothModel::find_teeth() {
  const int teeth = setting_.setup.cutter.teeth();
  if (teeth < 2) {
    why_no_runout_ = "with one tooth, runout is the same as another radius";
    return;
  }
  if (setting_.model == Model::quasi_static) {
    return;
  }
  labelled_ = std::all_of(readings_.begin(), readings_.end(),
                          [](const Reading& r) { return r.tooth >= 0; });
  const auto [first, last] = std::minmax_element(
      readings_.begin(), readings_.end(),
      [](const Reading& a, const Reading& b) { return a.travel < b.travel; });
  const double f_z = setting_.setup.cut.f_z;
  const double reach = last->travel - first->travel;
  if (setting_.model == Model::envelope || !labelled_) {
    if (reach < (teeth - 1.01) * f_z) {
      why_no_runout_ = fmt::format(
          "the readings reach over {:.3g} mm of the feed, less than {} teeth need",
          reach * 1e3, teeth);
      return;
    }
  }
  if (setting_.model == Model::envelope) {
    labelled_ = false;
    return;
  }
  for (std::size_t i = 0; i < readings_.size(); ++i) {
    const double steps = (readings_[i].travel - first->travel) / f_z;
    const double whole = std::round(steps);
    if (!labelled_ && std::abs(steps - whole) > 0.05) {
      why_no_runout_ = fmt::format(
          "without tooth numbers the readings must be "
          "whole tooth feeds apart; one is {:.3f}",
          steps);
      return;
    }
    const int tooth = labelled_ ? readings_[i].tooth : static_cast<int>(whole) % teeth;
    places_[i].tooth = static_cast<std::size_t>(tooth);
  }
}

force::Setup ToothModel::with(RunoutVector runout) const {
  force::Setup setup = setting_.setup;
  setup.runout = {.eccentricity = std::hypot(runout.c, runout.s),
                  .angle = std::atan2(runout.s, runout.c),
                  .order = setting_.setup.runout.order};
  return setup;
}

std::vector<double> ToothModel::angles(const force::Setup& setup) const {
  std::vector<double> angles;
  if (setting_.model == Model::quasi_static) {
    for (const Place& place : places_) {
      angles.push_back(place.phi);
    }
  } else {
    const double touch = side_of(setup.cut.engagement)->theta;
    for (const double height : stations_->grid().nodes()) {
      for (const EdgePlace& tooth : edge_places(setup, height)) {
        angles.push_back(within_turn(touch + tooth.behind));
      }
    }
  }
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
  return angles;
}

ToothModel::Forces ToothModel::forces_with(Feedback feedback, const Forces& straight,
                                           std::span<const double, columns> K,
                                           const Forces* close_by) const {
  const force::Setup setup = with(straight.runout);
  Forces result{.runout = straight.runout};
  const auto unit =
      straight.table.functions() > 0
          ? straight.table
          : unit_moments(EdgeMoments(setup, setting_.law, stations_->basis()),
                         10 * setting_.tolerance);
  const auto moments = with_coefficients(unit, K);
  std::vector<numerics::PeriodicPieces> bent(stations_->count());
  result.turns.resize(stations_->count());
  numerics::for_each_index(stations_->count(), [&](std::size_t s) {
    const StepwiseTurn* start =
        close_by != nullptr && close_by->found ? &close_by->turns[s] : nullptr;
    StepwiseTurn& turn = result.turns[s];
    turn = stepwise_steady_state(setup, setting_.law, K, stations_->compliance(s),
                                 feedback, start);
    if (!turn.converged && start != nullptr) {
      turn = stepwise_steady_state(setup, setting_.law, K, stations_->compliance(s),
                                   feedback);
    }
    if (turn.converged) {
      bent[s] = with_feedback(moments, turn);
      return;
    }
    // Slow, and sure where the steps lose its way.
    SteadyState state =
        steady_state(EdgeMoments(setup, setting_.law, stations_->basis()), K,
                     stations_->compliance(s), feedback, 10 * setting_.tolerance);
    turn.converged = state.converged;
    bent[s] = std::move(state.moments);
  });
  result.bent =
      std::make_shared<const std::vector<numerics::PeriodicPieces>>(std::move(bent));
  result.found = std::all_of(result.turns.begin(), result.turns.end(),
                             [](const StepwiseTurn& turn) { return turn.converged; });
  return result;
}

ToothModel::Forces ToothModel::forces(RunoutVector runout) const {
  const force::Setup setup = with(runout);
  const EdgeMoments edges(setup, setting_.law, stations_->basis());
  Forces result{.runout = runout};
  if (setting_.model != Model::envelope) {
    result.angles = angles(setup);
  }
  if (setting_.model == Model::envelope || result.angles.size() > most_angles) {
    result.angles.clear();
    result.table = unit_moments(edges, 10 * setting_.tolerance);
    return result;
  }
  const std::size_t n = columns * edges.values();
  result.values.resize(result.angles.size() * n);
  numerics::for_each_index(result.angles.size(), [&](std::size_t i) {
    edges.at(result.angles[i], nullptr, std::span(result.values).subspan(i * n, n));
  });
  return result;
}

namespace {

/// Points of a tooth feed between which an envelope is interpolated.
constexpr std::size_t points_per_tooth_feed = 32;

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
  if (!forces.bent) {
    moments_at(forces, K, phi, moments);
  } else {
    (*forces.bent)[station].value(phi, moments);
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
  return predict_envelope(forces, K, setup, runout, x_0);
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

std::vector<double> ToothModel::profiles(const StationMoments& moments,
                                         const force::Setup& setup,
                                         std::size_t node) const {
  const auto n = static_cast<std::size_t>(setup.cutter.teeth()) * points_per_tooth_feed;
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
  const double step = setup.cut.f_z / static_cast<double>(points_per_tooth_feed);
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

std::shared_ptr<const ToothModel::Profiles> ToothModel::profiles_of(
    const Forces& forces, std::span<const double, columns> K, RunoutVector runout,
    const force::Setup& setup) const {
  constexpr std::size_t most_known =
      10;  // slopes by every unknown lie between two uses
  const auto same = [](RunoutVector a, RunoutVector b) {
    return a.c == b.c && a.s == b.s;
  };
  for (const auto& known : known_) {
    if (known->bent == forces.bent && same(known->forces, forces.runout) &&
        same(known->runout, runout) && std::ranges::equal(known->K, K)) {
      return known;
    }
  }
  std::vector<numerics::PeriodicPieces> stiff;
  if (!forces.bent) {
    stiff.push_back(with_coefficients(forces.table, K));
  }
  const StationMoments moments(*stations_, forces.bent ? *forces.bent : stiff);
  auto made = std::make_shared<Profiles>(
      Profiles{.forces = forces.runout, .runout = runout, .bent = forces.bent});
  std::ranges::copy(K, made->K.begin());
  made->at_nodes.resize(stations_->grid().nodes().size());
  numerics::for_each_index(made->at_nodes.size(), [&](std::size_t node) {
    made->at_nodes[node] = profiles(moments, setup, node);
  });
  if (known_.size() == most_known) {
    known_.erase(known_.begin());
  }
  return known_.emplace_back(std::move(made));
}

std::vector<double> ToothModel::predict_envelope(const Forces& forces,
                                                 std::span<const double, columns> K,
                                                 const force::Setup& setup,
                                                 RunoutVector runout,
                                                 double x_0) const {
  const auto n = static_cast<std::size_t>(setup.cutter.teeth()) * points_per_tooth_feed;
  const double feed = setup.cutter.teeth() * setup.cut.f_z;
  const auto known = profiles_of(forces, K, runout, setup);
  return along_the_wall([&](std::size_t i) {
    const double u = (readings_[i].travel - x_0) / feed;
    const double at = (u - std::floor(u)) * static_cast<double>(n);
    const std::size_t k = std::min(static_cast<std::size_t>(at), n - 1);
    const double t = at - static_cast<double>(k);
    return [&, k, t](std::size_t s, std::size_t node) {
      const double* profile = known->at_nodes[node].data() + s * n;
      return (1 - t) * profile[k] + t * profile[(k + 1) % n];
    };
  });
}

}  // namespace trochoid::surface
