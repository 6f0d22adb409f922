#include <trochoid/surface/folded_readings.h>

#include <trochoid/surface/envelope.h>
#include <trochoid/surface/pass.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace trochoid::surface {

namespace {

/// No more readings than this are left as they are.
constexpr std::size_t few = 4000;

/// Bins of a tooth feed, of the stretch along the wall, and of the heights where a
/// scan has many: as fine as what the model interpolates between.
constexpr double per_tooth_feed = 32;
constexpr double along_wall = 24;
constexpr double over_height = 128;

/// The bin of a reading: set, tooth, height, along the wall, within the turn.
using Bin = std::array<std::size_t, 5>;

std::size_t part(double value, double from, double reach, double bins) {
  return reach > 0 ? static_cast<std::size_t>(
                         std::clamp(bins * (value - from) / reach, 0.0, bins - 1))
                   : 0;
}

template <class Of>
std::pair<double, double> range(std::span<const Reading> readings, const Of& of) {
  const auto [low, high] = std::minmax_element(
      readings.begin(), readings.end(),
      [&](const Reading& a, const Reading& b) { return of(a) < of(b); });
  return {of(*low), of(*high) - of(*low)};
}

FoldedReadings each_by_itself(std::span<const Reading> readings) {
  FoldedReadings all{{readings.begin(), readings.end()},
                     std::vector<double>(readings.size(), 1.0),
                     std::vector<std::size_t>(readings.size())};
  std::iota(all.of.begin(), all.of.end(), std::size_t{0});
  return all;
}

std::vector<Bin> bins_of(const Setting& setting, std::span<const Reading> readings,
                         const ToothModel& model) {
  const double teeth = setting.setup.cutter.teeth();
  const double feed = teeth * setting.setup.cut.f_z;
  const auto [x, stretch] = range(readings, [](const Reading& r) { return r.x; });
  const auto [low, depth] = range(readings, [](const Reading& r) { return r.height; });
  force::Setup straight = setting.setup;
  straight.runout = {};
  const std::vector<EdgePlace> tips = edge_places(straight, 0.0);
  // The tooth as the model knows it: of a pulse the one that cuts without runout.
  const auto tooth = [&](std::size_t i, double turn) {
    return setting.model == Model::quasi_static
               ? last_entered(tips, entry_angle(straight),
                              setting.phase + unit::turn * turn)
               : model.tooth(i);
  };
  std::vector<Bin> bins;
  bins.reserve(readings.size());
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Reading& r = readings[i];
    const double turn = r.travel / feed - std::floor(r.travel / feed);
    const std::size_t height = model.heights().exact()
                                   ? model.heights().at(r.height).first
                                   : part(r.height, low, depth, over_height);
    const bool by_angle = setting.model != Model::imprint;
    bins.push_back({r.set, tooth(i, turn), height, part(r.x, x, stretch, along_wall),
                    by_angle ? part(turn, 0.0, 1.0, teeth * per_tooth_feed) : 0});
  }
  return bins;
}

}  // namespace

FoldedReadings fold_readings(const Setting& setting, std::span<const Reading> readings,
                             const ToothModel& model) {
  if (readings.size() <= few) {
    return each_by_itself(readings);
  }
  const double feed = setting.setup.cutter.teeth() * setting.setup.cut.f_z;
  const std::vector<Bin> bins = bins_of(setting, readings, model);
  std::vector<std::size_t> order(readings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return bins[a] != bins[b] ? bins[a] < bins[b] : a < b;
  });
  FoldedReadings folded{.of = std::vector<std::size_t>(readings.size())};
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t i = order[k];
    const Reading& r = readings[i];
    if (k == 0 || bins[i] != bins[order[k - 1]]) {
      folded.means.push_back({.tooth = setting.model == Model::imprint
                                           ? static_cast<int>(bins[i][1])
                                           : r.tooth,
                              .set = r.set});
      folded.count.push_back(0.0);
    }
    Reading& mean = folded.means.back();
    const double n = ++folded.count.back();
    mean.x += (r.x - mean.x) / n;
    mean.height += (r.height - mean.height) / n;
    mean.error += (r.error - mean.error) / n;
    const double travel = r.travel - feed * std::floor(r.travel / feed);
    mean.travel += (travel - mean.travel) / n;
    folded.of[i] = folded.means.size() - 1;
  }
  return folded;
}

}  // namespace trochoid::surface
