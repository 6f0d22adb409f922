#include <trochoid/surface/stations.h>

#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace trochoid::surface {

namespace {

/// Stations on a stretch as long as the wall, or as twice its height if that is less.
constexpr double stations_per_wall = 10;

/// How many stations resolve a stretch: the compliance changes with the distance from
/// the clamped ends, over lengths like the wall's own.
std::size_t station_count(const std::optional<Wall>& wall, double stretch,
                          std::size_t most) {
  if (!wall || stretch == 0) {
    return 1;
  }
  const double size =
      std::min(wall->length > 0 ? wall->length : 2 * wall->height, 2 * wall->height);
  return std::min(most, 3 + static_cast<std::size_t>(
                                std::ceil(stations_per_wall * stretch / size)));
}

std::vector<double> distinct(std::span<const double> x) {
  std::vector<double> sorted(x.begin(), x.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  return sorted;
}

/// Slopes over the height are taken over this part of the axial depth, both ways.
constexpr double slope_step = 0.01;

}  // namespace

std::array<double, 3> heights_around(double height, double a_p) {
  return {std::max(0.0, height - slope_step * a_p), height,
          std::min(a_p, height + slope_step * a_p)};
}

Stations::Stations(const BodiesAt& bodies, std::span<const double> x,
                   std::span<const double> heights, const LoadedWall& loaded)
    : x_(distinct(x)), grid_(heights), along_(x_.front(), x_.back(), 1) {
  for (const double node : grid_.nodes()) {
    const auto around = heights_around(node, loaded.a_p);
    heights_.insert(heights_.end(), around.begin(), around.end());
  }
  const Bodies first = bodies(x_.front());
  const std::size_t enough =
      station_count(first.wall, x_.back() - x_.front(), loaded.most_stations);
  const double first_x = x_.front();
  if (enough == 1) {
    x_.resize(1);
  } else if (x_.size() > enough) {
    interpolated_ = true;
    along_ = numerics::LagrangeBasis(x_.front(), x_.back(), static_cast<int>(enough));
    x_ = along_.points();
  }
  std::vector<std::optional<Compliance>> solved(x_.size());
  rows_.resize(x_.size());
  numerics::for_each_index(x_.size(), [&](std::size_t i) {
    solved[i].emplace(x_[i] == first_x ? first : bodies(x_[i]), loaded.a_p, x_[i],
                      loaded.load);
    rows_[i] = solved[i]->rows(heights_);
  });
  for (auto& compliance : solved) {
    compliances_.push_back(std::move(*compliance));
  }
}

void Stations::weights(double x, std::span<double> out) const noexcept {
  if (interpolated_) {
    along_.weights(x, out);
    return;
  }
  const auto nearest = std::min_element(x_.begin(), x_.end(), [x](double a, double b) {
    return std::abs(a - x) < std::abs(b - x);
  });
  std::fill(out.begin(), out.end(), 0.0);
  out[static_cast<std::size_t>(nearest - x_.begin())] = 1.0;
}

}  // namespace trochoid::surface
