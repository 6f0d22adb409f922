#include <trochoid/surface/tooth_model.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/surface/pass.h>
#include <trochoid/surface/turn.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

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
  result.bent.resize(stations_->count());
  result.turns.resize(stations_->count());
  numerics::for_each_index(stations_->count(), [&](std::size_t s) {
    const Marched* start =
        close_by != nullptr && close_by->found ? &close_by->turns[s] : nullptr;
    Marched& turn = result.turns[s];
    turn = march(setup, setting_.law, K, stations_->compliance(s), feedback, start);
    if (!turn.converged && start != nullptr) {
      turn = march(setup, setting_.law, K, stations_->compliance(s), feedback);
    }
    if (turn.converged) {
      result.bent[s] = with_feedback(moments, turn);
      return;
    }
    // Slow, and sure where the march loses its way.
    SteadyState state =
        steady_state(EdgeMoments(setup, setting_.law, stations_->basis()), K,
                     stations_->compliance(s), feedback, 10 * setting_.tolerance);
    turn.converged = state.converged;
    result.bent[s] = std::move(state.moments);
  });
  result.found = std::all_of(result.turns.begin(), result.turns.end(),
                             [](const Marched& turn) { return turn.converged; });
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

}  // namespace trochoid::surface
