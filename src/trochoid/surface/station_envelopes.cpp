#include <trochoid/surface/station_envelopes.h>

#include <trochoid/surface/envelope.h>
#include <trochoid/surface/turn.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::surface {

StationMoments::StationMoments(const Stations& stations,
                               std::span<const numerics::PeriodicPieces> moments)
    : pieces(moments) {
  for (const numerics::PeriodicPieces& here : moments) {
    most = std::max(most, here.largest(stations.largest()));
  }
}

StationEnvelopes::StationEnvelopes(const Stations& stations,
                                   const StationMoments& moments,
                                   const force::Setup& setup, std::size_t node,
                                   Level level)
    : count_(stations.count()),
      side_(*side_of(setup.cut.engagement)),
      R_(setup.cutter.profile.D / 2),
      feed_(setup.cutter.teeth() * setup.cut.f_z),
      teeth_(edge_places(setup, stations.height(node, level))) {
  const std::size_t functions = moments.pieces.front().functions();
  std::vector<double> weights(count_ * functions);
  for (std::size_t s = 0; s < count_; ++s) {
    const auto row = stations.row(s, node, level);
    for (std::size_t q = 0; q < row.size(); ++q) {
      weights[s * functions + q] = side_.sigma * row[q];  // E-4
    }
  }
  const std::vector<Part> parts = parts_that_count(moments.most);
  if (moments.pieces.size() == 1) {
    deflections_.push_back(moments.pieces.front().combined(weights, parts));
    return;
  }
  for (std::size_t s = 0; s < count_; ++s) {
    deflections_.push_back(moments.pieces[s].combined(
        std::span(weights).subspan(s * functions, functions), parts));
  }
}

std::vector<StationEnvelopes::Part> StationEnvelopes::parts_that_count(
    double most) const {
  constexpr double wider = 1.2;  // the feed moves the cutter while it turns
  constexpr double whole = 0.5;  // of a sine: beyond, all of the turn may count
  std::vector<Part> parts;
  for (const EdgePlace& tooth : teeth_) {
    // The nearest pass of the largest tooth leaves no more than feed^2/8R and its
    // deflection; one that leaves more by both deflections does not count.
    const double rise = 2 * most + feed_ * feed_ / (8 * tooth.R);
    const double sine = std::sqrt(2 * wider * rise / tooth.R);
    const double wall = side_.theta + tooth.behind;
    const double reach = sine < whole ? wider * std::asin(sine) : unit::turn;
    parts.push_back({wall - reach, wall + reach});
  }
  return parts;
}

std::vector<double> StationEnvelopes::profiles(std::size_t count) const {
  std::vector<double> out(count_ * count);
  std::vector<double> delta(count_);
  std::vector<double> lowest(count_);  // what delta never falls below [m]
  for (std::size_t s = 0; s < count_; ++s) {
    lowest[s] = deflections_.size() > 1 ? deflections_[s].lower_bound(0)
                                        : deflections_.front().lower_bound(s);
  }
  std::vector<double> best(count_);
  for (std::size_t k = 0; k < count; ++k) {
    const double x = feed_ * static_cast<double>(k) / static_cast<double>(count);
    std::fill(best.begin(), best.end(), std::numeric_limits<double>::infinity());
    double open = std::numeric_limits<double>::infinity();  // best, above the lowest
    for_each_pass(
        {side_, R_, feed_, 0.0, teeth_}, x, [&](double bound) { return bound < open; },
        [&](std::size_t, double phi, double rise) {
          for (std::size_t s = 0; s < deflections_.size(); ++s) {
            deflections_[s].value(
                phi, deflections_.size() > 1 ? std::span(delta).subspan(s, 1) : delta);
          }
          open = -std::numeric_limits<double>::infinity();
          for (std::size_t s = 0; s < count_; ++s) {
            best[s] = std::min(best[s], rise + delta[s]);  // E-9
            open = std::max(open, best[s] - lowest[s]);
          }
        });
    for (std::size_t s = 0; s < count_; ++s) {
      out[s * count + k] = best[s];
    }
  }
  return out;
}

}  // namespace trochoid::surface
