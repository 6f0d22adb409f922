#include <trochoid/stock/wall.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::stock {

namespace {

/// Steps of t in a piece: radii are then good to some 1e-9 of the largest.
constexpr std::size_t steps = 192;
/// Steps of a quarter of a turn: heights are then good to some 1e-6 of the radius.
constexpr std::size_t angles = 512;
constexpr double angle_step = std::numbers::pi / 2 / angles;
/// Slopes nearer to the lower end of a piece are those here: at a tip they have no limit.
constexpr double least_t = 1e-4;
/// Bisections that find a height to rounding.
constexpr int halvings = 60;

/// The cubic through four neighbours, and its slope a step.
Wall::At cubic(const double* v, double x) noexcept {
  const auto i = std::clamp(static_cast<std::size_t>(x), std::size_t{1}, steps - 2);
  const double u = x - static_cast<double>(i);
  const double a = v[i - 1];
  const double b = v[i];
  const double c = v[i + 1];
  const double d = v[i + 2];
  const double c1 = -a / 3 - b / 2 + c - d / 6;
  const double c2 = (a + c) / 2 - b;
  const double c3 = (d - a) / 6 + (b - c) / 2;
  return {b + u * (c1 + u * (c2 + u * c3)), c1 + u * (2 * c2 + 3 * u * c3)};
}

}  // namespace

Wall Wall::upright(double radius) {
  Wall wall;
  wall.largest_ = radius;
  return wall;
}

Wall::Wall(std::span<const double> ends, const std::function<double(double)>& radius)
    : lowest_(ends.front()), highest_(ends.back()) {
  double widest = 0.0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    pieces_.push_back({ends[i], ends[i + 1], values_.size()});
    for (std::size_t k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      widest = std::max(widest, radius(ends[i] + (ends[i + 1] - ends[i]) * t * t));
      values_.push_back(widest);
    }
  }
  largest_ = widest;
  for (std::size_t i = 0; i <= angles; ++i) {
    const double r = largest_ * std::sin(static_cast<double>(i) * angle_step);
    heights_.push_back(r <= values_.front() ? lowest_ : find_height(r));
  }
}

Wall::At Wall::at(double height) const noexcept {
  if (pieces_.empty()) return {height < 0 ? 0.0 : largest_, 0.0};
  if (height < lowest_) return {};
  if (height >= highest_) return {largest_, 0.0};
  const auto next = std::ranges::upper_bound(pieces_, height, {},
                                             [](const Piece& p) { return p.from; });
  const Piece& piece = *std::prev(next);
  const double length = piece.to - piece.from;
  const double t = std::sqrt((height - piece.from) / length);
  const At found = cubic(&values_[piece.first], t * steps);
  const double beyond = std::max(t, least_t);
  const double per_step =
      t < least_t ? cubic(&values_[piece.first], beyond * steps).slope : found.slope;
  return {found.radius, std::max(per_step * steps / (2 * beyond * length), 0.0)};
}

double Wall::find_height(double radius) const noexcept {
  double low = lowest_;
  double high = highest_;
  for (int i = 0; i < halvings && high - low > 1e-13; ++i) {
    const double middle = 0.5 * (low + high);
    (this->radius(middle) < radius ? low : high) = middle;
  }
  return high;
}

double Wall::height_at(double radius) const noexcept {
  if (radius > largest_) return std::numeric_limits<double>::infinity();
  if (heights_.empty()) return lowest_;
  const double x = std::asin(std::max(radius, 0.0) / largest_) / angle_step;
  const auto i = std::min(static_cast<std::size_t>(x), angles - 1);
  const double u = x - static_cast<double>(i);
  return (1 - u) * heights_[i] + u * heights_[i + 1];
}

}  // namespace trochoid::stock
