#include <trochoid/stock/slice_part.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

namespace trochoid::stock {

namespace {

/// The place of the farthest disc is found to this: what it reaches is then right to its
/// square over the radius [m]. The coarse one is for a question with yes or no.
constexpr double fine = 2e-9;
constexpr double coarse = 2e-7;
constexpr int most_steps = 60;

/// Whether a point is less than R from another.
bool is_near(const SlicePoint& p, double x, double y, double R) noexcept {
  const double dx = x - p[0];
  const double dy = y - p[1];
  return dx * dx + dy * dy < R * R;
}

/// Whether an angle about a centre is in the sweep that begins at `start`.
bool in_sweep(double angle, double start, double sweep) noexcept {
  const double ahead = sweep > 0 ? angle - start : start - angle;
  return ahead - unit::turn * std::floor(ahead / unit::turn) <= std::abs(sweep);
}

/// Distance from the line between the ends [m].
double distance_from(const SlicePart& part, double x, double y) noexcept {
  const auto& [a, b] = part.end;
  const double dx = b[0] - a[0];
  const double dy = b[1] - a[1];
  const double l2 = dx * dx + dy * dy;
  const double along = (x - a[0]) * dx + (y - a[1]) * dy;
  const double u = l2 > 0 ? std::clamp(along / l2, 0.0, 1.0) : 0.0;
  const double px = x - a[0] - u * dx;
  const double py = y - a[1] - u * dy;
  return std::sqrt(px * px + py * py);
}

/// The disc at a place of the line, seen from a point.
class Line {
 public:
  Line(const SlicePart& part, double x, double y) noexcept
      : part_(part),
        x_(part.end[0][0] - x),
        y_(part.end[0][1] - y),
        dx_(part.end[1][0] - part.end[0][0]),
        dy_(part.end[1][1] - part.end[0][1]),
        rise_(part.height[1] - part.height[0]) {}

  struct At {
    double depth;
    double slope;  ///< of the depth over u
  };
  [[nodiscard]] At at(double u) const noexcept {
    const Wall::At wall = part_.wall->at(part_.height[0] + u * rise_);
    const double px = x_ + u * dx_;
    const double py = y_ + u * dy_;
    const double distance = std::sqrt(px * px + py * py);
    const double away = distance > 0 ? (px * dx_ + py * dy_) / distance : 0.0;
    return {wall.radius - distance, wall.slope * rise_ - away};
  }
  [[nodiscard]] double length() const noexcept {
    return std::sqrt(dx_ * dx_ + dy_ * dy_);
  }
  [[nodiscard]] Overlap overlap(double u, double depth) const noexcept {
    return {depth, {part_.end[0][0] + u * dx_, part_.end[0][1] + u * dy_}};
  }

 private:
  const SlicePart& part_;
  double x_, y_, dx_, dy_, rise_;
};

/// The largest depth, or the first that is found positive.
/// @param only_sign  stop as soon as it is known
Overlap deepest(const SlicePart& part, double x, double y, bool only_sign) noexcept {
  const Line line(part, x, y);
  Line::At low = line.at(0.0);
  if (low.slope <= 0 || (only_sign && low.depth > 0)) {
    return line.overlap(0.0, low.depth);
  }
  Line::At high = line.at(1.0);
  if (high.slope >= 0 || (only_sign && high.depth > 0)) {
    return line.overlap(1.0, high.depth);
  }
  const double wanted = only_sign ? coarse : fine;
  const double enough = std::min(wanted / std::max(line.length(), wanted), 0.01);
  double from = 0.0;
  double to = 1.0;
  bool halve = false;
  for (int i = 0; i < most_steps && to - from > enough; ++i) {
    // A concave function stays below its tangents.
    const double bound = std::min(low.depth + low.slope * (to - from),
                                  high.depth - high.slope * (to - from));
    if (only_sign && bound < 0) break;
    const double secant = from + (to - from) * low.slope / (low.slope - high.slope);
    const double margin = 0.02 * (to - from);
    const double u =
        halve ? 0.5 * (from + to) : std::clamp(secant, from + margin, to - margin);
    const Line::At here = line.at(u);
    if (only_sign && here.depth > 0) return line.overlap(u, here.depth);
    const double before = to - from;
    if (here.slope > 0) {
      from = u;
      low = here;
    } else {
      to = u;
      high = here;
    }
    halve = to - from > 0.5 * before;
  }
  return low.depth > high.depth ? line.overlap(from, low.depth)
                                : line.overlap(to, high.depth);
}

}  // namespace

bool covers(const SlicePart& part, double x, double y) noexcept {
  if (part.radius > 0) {
    const double dx = x - part.center[0];
    const double dy = y - part.center[1];
    if (in_sweep(std::atan2(dy, dx), part.start, part.turn)) {
      return std::abs(std::hypot(dx, dy) - part.radius) < part.R;
    }
    return is_near(part.end[0], x, y, part.R) || is_near(part.end[1], x, y, part.R);
  }
  const double distance = distance_from(part, x, y);
  if (!part.slopes()) return distance < part.R;
  if (distance >= part.R) return false;
  if (distance < part.smallest || is_near(part.end[0], x, y, part.disc(0)) ||
      is_near(part.end[1], x, y, part.disc(1))) {
    return true;
  }
  return deepest(part, x, y, true).depth > 0;
}

Overlap overlap(const SlicePart& part, double x, double y) noexcept {
  return deepest(part, x, y, false);
}

}  // namespace trochoid::stock
