#include <trochoid/surface/stations.h>

#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace trochoid::surface {
namespace {

/// More heights than this are interpolated, between so many nodes.
constexpr std::size_t most_exact = 40;
constexpr std::size_t interpolated = 65;

}  // namespace

HeightGrid::HeightGrid(std::span<const double> heights)
    : nodes_(heights.begin(), heights.end()) {
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  exact_ = nodes_.size() <= most_exact;
  if (exact_) {
    return;
  }
  const double low = nodes_.front();
  const double high = nodes_.back();
  nodes_.resize(interpolated);
  for (std::size_t i = 0; i < interpolated; ++i) {
    nodes_[i] = low + (high - low) * static_cast<double>(i) /
                          static_cast<double>(interpolated - 1);
  }
  nodes_.back() = high;
}

HeightShare HeightGrid::at(double height) const noexcept {
  if (exact_) {
    const auto above = std::lower_bound(nodes_.begin(), nodes_.end(), height);
    auto at = static_cast<std::size_t>(above - nodes_.begin());
    at = std::min(at, nodes_.size() - 1);
    if (at > 0 && height - nodes_[at - 1] < std::abs(nodes_[at] - height)) {
      --at;  // heights of one mean differ by rounding
    }
    return {.first = at};
  }
  const double step = nodes_[1] - nodes_[0];
  const double u = (height - nodes_.front()) / step;
  const double last = static_cast<double>(nodes_.size() - 4);
  const double first = std::clamp(std::floor(u) - 1, 0.0, last);
  const double t = u - first;  // of four nodes at 0, 1, 2, 3
  return {static_cast<std::size_t>(first),
          4,
          {-(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2,
           -t * (t - 1) * (t - 3) / 2, t * (t - 1) * (t - 2) / 6}};  // E-18
}

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
  largest_.resize(basis().size());
  for (const std::vector<double>& rows : rows_) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      double& most = largest_[k % largest_.size()];
      most = std::max(most, std::abs(rows[k]));
    }
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
