#include <trochoid/surface/height_grid.h>

#include <algorithm>
#include <cmath>

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

}  // namespace trochoid::surface
