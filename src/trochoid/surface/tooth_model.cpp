#include <trochoid/surface/tooth_model.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/surface/envelope.h>
#include <trochoid/surface/probe.h>
#include <trochoid/surface/turn.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::surface {

namespace {

/// Points of a tooth feed between which an envelope is interpolated.
constexpr std::size_t points_per_feed = 32;

std::vector<double> distinct_heights(std::span<const Reading> readings) {
  std::vector<double> heights;
  for (const Reading& r : readings) {
    heights.push_back(r.height);
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  return heights;
}

/// Those, and what slopes over the height need.
std::vector<double> heights_and_around(std::span<const Reading> readings, double a_p) {
  std::vector<double> heights;
  for (const double height : distinct_heights(readings)) {
    const auto around = heights_around(height, a_p);
    heights.insert(heights.end(), around.begin(), around.end());
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

ToothModel::ToothModel(const Setting& setting, std::span<const Reading> readings)
    : ToothModel(setting, readings,
                 std::make_shared<Stations>(
                     setting.bodies, places_along(readings),
                     heights_and_around(readings, setting.setup.cut.a_p),
                     setting.setup.cut.a_p, setting.load)) {}

ToothModel::ToothModel(const Setting& setting, std::span<const Reading> readings,
                       std::shared_ptr<const Stations> stations)
    : setting_(setting),
      readings_(readings.begin(), readings.end()),
      heights_(distinct_heights(readings)),
      stations_(std::move(stations)) {
  const double feed = setting.setup.cutter.teeth() * setting.setup.cut.f_z;
  for (const Reading& r : readings_) {
    const auto height = std::lower_bound(heights_.begin(), heights_.end(), r.height);
    places_.push_back({.phi = setting.phase + unit::turn * r.travel / feed,
                       .height = static_cast<std::size_t>(height - heights_.begin()),
                       .weights = stations_->weights(r.x)});
  }
  for (const double height : heights_) {
    rows_.push_back(stations_->height_index(height));
  }
  find_teeth();
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

double ToothModel::angle_of(const Place& place, const force::Setup& setup) const {
  double phi = place.phi;
  if (setting_.model == Model::imprint) {
    phi = side_of(setup.cut.engagement)->theta +
          edge_places(setup, heights_[place.height])[place.tooth].behind;
  }
  return phi - unit::turn * std::floor(phi / unit::turn);
}

ToothModel::Forces ToothModel::forces(RunoutVector runout) const {
  const force::Setup setup = with(runout);
  const EdgeMoments edges(setup, setting_.law, stations_->basis());
  Forces result{.runout = runout};
  if (setting_.model == Model::envelope) {
    result.table = unit_moments(edges, 10 * setting_.tolerance);
    return result;
  }
  for (const Place& place : places_) {
    result.angles.push_back(angle_of(place, setup));
  }
  std::sort(result.angles.begin(), result.angles.end());
  result.angles.erase(std::unique(result.angles.begin(), result.angles.end()),
                      result.angles.end());
  const std::size_t n = columns * edges.values();
  result.values.resize(result.angles.size() * n);
  numerics::for_each_index(result.angles.size(), [&](std::size_t i) {
    edges.at(result.angles[i], nullptr, std::span(result.values).subspan(i * n, n));
  });
  return result;
}

/// delta at the angle of a place from single values of the force.
double ToothModel::deflection_at(const Forces& forces,
                                 std::span<const double, columns> K,
                                 const Place& place) const {
  const std::size_t points = stations_->basis().size();
  const std::size_t n = points + 2;
  const force::Setup setup = with(forces.runout);
  const double phi = angle_of(place, setup);
  const auto at = static_cast<std::size_t>(
      std::lower_bound(forces.angles.begin(), forces.angles.end(), phi) -
      forces.angles.begin());
  const double* m = forces.values.data() + at * columns * n;
  double sum = 0.0;
  for (std::size_t s = 0; s < stations_->count(); ++s) {
    const auto row = stations_->row(s, rows_[place.height]);
    for (std::size_t c = 0; place.weights[s] != 0 && c < columns; ++c) {
      for (std::size_t q = 0; q < points; ++q) {
        sum += place.weights[s] * K[c] * row[q] * m[c * n + q];  // E-4
      }
    }
  }
  return side_of(setup.cut.engagement)->sigma * sum;
}

std::vector<double> ToothModel::predict(const Forces& forces,
                                        std::span<const double, columns> K,
                                        RunoutVector runout, double x_0) const {
  const force::Setup setup = with(runout);
  if (setting_.model == Model::envelope) {
    return predict_envelope(forces, K, setup, x_0);
  }
  const std::vector<EdgePlace> tips = edge_places(setup, 0.0);
  std::vector<std::vector<EdgePlace>> teeth;
  teeth.reserve(heights_.size());
  for (const double height : heights_) {
    teeth.push_back(edge_places(setup, height));
  }
  std::vector<double> errors(places_.size());
  numerics::for_each_index(places_.size(), [&](std::size_t i) {
    const Place& place = places_[i];
    const std::size_t tooth = setting_.model == Model::quasi_static
                                  ? last_entered(tips, entry_angle(setup), place.phi)
                                  : place.tooth;
    errors[i] = deflection_at(forces, K, place) -
                (teeth[place.height][tooth].R - setup.cutter.profile.D / 2);
  });
  return errors;
}

/// de/dh of the mean envelope at a height.
double ToothModel::slope(const numerics::PeriodicPieces& moments, std::size_t station,
                         double height, const force::Setup& setup) const {
  constexpr int points = 6;  // of a tooth feed: the same above and below
  const Side side = *side_of(setup.cut.engagement);
  const double feed = setup.cutter.teeth() * setup.cut.f_z;
  const int count = points * setup.cutter.teeth();
  const auto around = heights_around(height, setup.cut.a_p);
  const auto mean = [&](double at) {
    const auto row = stations_->row(station, stations_->height_index(at));
    const HeightCut cut{
        side, setup.cutter.profile.D / 2, feed,
        0.0,  edge_places(setup, at),     deflection(moments, row, side.sigma)};
    double sum = 0.0;
    for (int k = 0; k < count; ++k) {
      sum += envelope_error(cut, feed * k / count).error / count;
    }
    return sum;
  };
  return (mean(around[2]) - mean(around[0])) / (around[2] - around[0]);
}

std::vector<double> ToothModel::predict_envelope(const Forces& forces,
                                                 std::span<const double, columns> K,
                                                 const force::Setup& setup,
                                                 double x_0) const {
  const Side side = *side_of(setup.cut.engagement);
  const auto n = static_cast<std::size_t>(setup.cutter.teeth()) * points_per_feed;
  const double feed = setup.cutter.teeth() * setup.cut.f_z;
  const double step = feed / static_cast<double>(n);
  const auto moments = with_coefficients(forces.table, K);
  std::vector<std::vector<double>> profiles(stations_->count() * heights_.size());
  numerics::for_each_index(profiles.size(), [&](std::size_t i) {
    const std::size_t h = i % heights_.size();
    const auto row = stations_->row(i / heights_.size(), rows_[h]);
    const HeightCut cut{
        side, setup.cutter.profile.D / 2,      feed,
        0.0,  edge_places(setup, heights_[h]), deflection(moments, row, side.sigma)};
    for (std::size_t k = 0; k < n; ++k) {
      profiles[i].push_back(envelope_error(cut, static_cast<double>(k) * step).error);
    }
    if (setting_.probe_radius > 0) {
      profiles[i] = probe_reading(profiles[i], step, setting_.probe_radius);
      const double more =
          reading_on_slope(setting_.probe_radius,
                           slope(moments, i / heights_.size(), heights_[h], setup));
      for (double& e : profiles[i]) {
        e += more;
      }
    }
  });
  std::vector<double> errors(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const double u = (readings_[i].travel - x_0) / feed;
    const double at = (u - std::floor(u)) * static_cast<double>(n);
    const std::size_t k = std::min(static_cast<std::size_t>(at), n - 1);
    const double t = at - static_cast<double>(k);
    for (std::size_t s = 0; s < stations_->count(); ++s) {
      const auto& profile = profiles[s * heights_.size() + places_[i].height];
      errors[i] +=
          places_[i].weights[s] * ((1 - t) * profile[k] + t * profile[(k + 1) % n]);
    }
  }
  return errors;
}

}  // namespace trochoid::surface
