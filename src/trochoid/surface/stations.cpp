#include <trochoid/surface/stations.h>

#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace trochoid::surface {

namespace {

/// More places than this are interpolated between as many Chebyshev points.
constexpr std::size_t most_stations = 12;

std::vector<double> distinct(std::span<const double> x) {
  std::vector<double> sorted(x.begin(), x.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  return sorted;
}

}  // namespace

Stations::Stations(const BodiesAt& bodies, std::span<const double> x,
                   std::span<const double> heights, double a_p, Load load)
    : x_(distinct(x)), along_(x_.front(), x_.back(), static_cast<int>(most_stations)) {
  // A rigid wall is the same everywhere.
  if (!bodies(x_.front()).wall) {
    x_.resize(1);
  }
  interpolated_ = x_.size() > most_stations;
  if (interpolated_) {
    x_ = along_.points();
  }
  std::vector<std::optional<Compliance>> solved(x_.size());
  rows_.resize(x_.size());
  numerics::for_each_index(x_.size(), [&](std::size_t i) {
    solved[i].emplace(bodies(x_[i]), a_p, x_[i], load);
    rows_[i] = solved[i]->rows(heights);
  });
  for (auto& compliance : solved) {
    compliances_.push_back(std::move(*compliance));
  }
}

std::vector<double> Stations::weights(double x) const {
  std::vector<double> weights(x_.size());
  if (interpolated_) {
    along_.weights(x, weights);
    return weights;
  }
  const auto nearest = std::min_element(x_.begin(), x_.end(), [x](double a, double b) {
    return std::abs(a - x) < std::abs(b - x);
  });
  weights[static_cast<std::size_t>(nearest - x_.begin())] = 1.0;
  return weights;
}

}  // namespace trochoid::surface
