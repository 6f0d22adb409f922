#include <trochoid/surface/station_envelopes.h>

#include <trochoid/surface/envelope.h>
#include <trochoid/surface/turn.h>

#include <algorithm>
#include <limits>

namespace trochoid::surface {

StationEnvelopes::StationEnvelopes(const Stations& stations, StationMoments moments,
                                   const force::Setup& setup, std::size_t node,
                                   Level level)
    : stations_(stations),
      moments_(moments),
      side_(*side_of(setup.cut.engagement)),
      R_(setup.cutter.profile.D / 2),
      feed_(setup.cutter.teeth() * setup.cut.f_z),
      teeth_(edge_places(setup, stations.height(node, level))) {
  for (std::size_t s = 0; s < stations.count(); ++s) {
    const auto row = stations.row(s, node, level);
    const numerics::PeriodicPieces& here = moments[moments.size() == 1 ? 0 : s];
    lowest_.push_back(deflection(here, row, side_.sigma).lower_bound(0));
    for (const double G : row) {
      rows_.push_back(side_.sigma * G);
    }
  }
}

std::vector<double> StationEnvelopes::profiles(std::size_t count) const {
  const std::size_t stations = lowest_.size();
  const std::size_t points = stations_.basis().size();
  std::vector<double> out(stations * count);
  std::vector<double> moments(moments_.front().functions());
  std::vector<double> best(stations);
  for (std::size_t k = 0; k < count; ++k) {
    const double x = feed_ * static_cast<double>(k) / static_cast<double>(count);
    std::fill(best.begin(), best.end(), std::numeric_limits<double>::infinity());
    double open = std::numeric_limits<double>::infinity();  // best, above the lowest
    for_each_pass(
        {side_, R_, feed_, 0.0, teeth_}, x, [&](double bound) { return bound < open; },
        [&](std::size_t, double phi, double rise) {
          moments_.front().value(phi, moments);
          open = -std::numeric_limits<double>::infinity();
          for (std::size_t s = 0; s < stations; ++s) {
            if (s > 0 && moments_.size() > 1) {
              moments_[s].value(phi, moments);
            }
            double error = rise;  // E-9
            for (std::size_t q = 0; q < points; ++q) {
              error += rows_[s * points + q] * moments[q];
            }
            best[s] = std::min(best[s], error);
            open = std::max(open, best[s] - lowest_[s]);
          }
        });
    for (std::size_t s = 0; s < stations; ++s) {
      out[s * count + k] = best[s];
    }
  }
  return out;
}

}  // namespace trochoid::surface
