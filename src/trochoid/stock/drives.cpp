#include <trochoid/stock/drives.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

namespace trochoid::stock {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Kinks up to this angle are passed at full feed [rad].
constexpr double smooth = 1 * unit::deg;
/// Ends so near are one place [m].
constexpr double same_place = 1e-9;

/// The largest value along a direction of what each axis can do by itself.
double along(const std::array<double, 3>& each, const Point& direction) noexcept {
  double most = infinite;
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = std::abs(direction[i]);
    if (part > 1e-12) most = std::min(most, each[i] / part);
  }
  return most;
}

/// An arc meets all directions of its plane: what holds in each is taken.
Speed limits_of(const Piece& piece, double rapid_feed, const Drives& drives) noexcept {
  Speed out;
  out.most = piece.feed > 0 ? piece.feed : rapid_feed;
  if (!piece.arc()) {
    const Point u = tangent(piece, 0.0);
    out.acceleration = along(drives.acceleration, u);
    out.most = std::min(out.most, along(drives.feed, u));
    return out;
  }
  const double a = std::min(drives.acceleration[0], drives.acceleration[1]);
  const double flat = piece.horizontal / piece.length;
  const double up = std::abs(piece.to[2] - piece.from[2]) / piece.length;
  const Point worst{flat, flat, up};
  out.acceleration = along(drives.acceleration, worst);
  out.most = std::min({out.most, along(drives.feed, worst),
                       std::sqrt(a * piece.radius) / flat});  // N-13
  return out;
}

/// The largest speed from a piece to the next one.
double passing_speed(const Piece& before, const Piece& after,
                     const Drives& drives) noexcept {
  double gap = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    gap = std::max(gap, std::abs(before.to[i] - after.from[i]));
  }
  const bool rests = after.time_from > before.time_to;
  if (gap > same_place || rests || before.tool != after.tool) return 0.0;
  const Point a = tangent(before, 1.0);
  const Point b = tangent(after, 0.0);
  double cosine = 0.0;
  Point change{};
  for (std::size_t i = 0; i < 3; ++i) {
    cosine += a[i] * b[i];
    change[i] = b[i] - a[i];
  }
  const double turn = std::acos(std::clamp(cosine, -1.0, 1.0));
  if (turn <= smooth) return infinite;
  const double size = std::hypot(change[0], change[1], change[2]);
  for (double& part : change) part /= size;
  const double half = std::cos(turn / 2);
  return std::sqrt(along(drives.acceleration, change) * drives.corner_tolerance * half /
                   (1 - half));  // N-13
}

/// The clock of the path becomes that of the machine; rests stay as they are.
void set_clock(Path& path, const std::vector<Speed>& speeds) {
  double later = 0.0;       // than at the programmed feed [s]
  double more_turns = 0.0;  // of the spindle
  for (std::size_t i = 0; i < path.pieces.size(); ++i) {
    Piece& piece = path.pieces[i];
    const double time = time_to(speeds[i], piece.length, piece.length);
    const double extra = time - (piece.time_to - piece.time_from);
    const double turns = time * piece.spindle / unit::turn;
    const double extra_turns = turns - (piece.turns_to - piece.turns_from);
    piece.time_from += later;
    piece.turns_from += more_turns;
    piece.time_to = piece.time_from + time;
    piece.turns_to = piece.turns_from + turns;
    later += extra;
    more_turns += extra_turns;
  }
  path.time += later;
  path.turns += more_turns;
}

}  // namespace

double acceleration_along(const Drives& drives, const Point& direction) noexcept {
  return along(drives.acceleration, direction);
}

double feed_along(const Drives& drives, const Point& direction) noexcept {
  return along(drives.feed, direction);
}

double speed_at(const Speed& speed, double length, double s) noexcept {
  if (!std::isfinite(speed.acceleration)) return speed.most;
  const double a = 2 * speed.acceleration;
  return std::sqrt(std::min({speed.most * speed.most, speed.first * speed.first + a * s,
                             speed.last * speed.last + a * (length - s)}));  // N-12
}

double time_to(const Speed& speed, double length, double s) noexcept {
  if (!std::isfinite(speed.acceleration)) return s / speed.most;
  const double a = speed.acceleration;
  const double first2 = speed.first * speed.first;
  const double last2 = speed.last * speed.last;
  const double top2 =
      std::min(speed.most * speed.most, 0.5 * (first2 + last2) + a * length);
  const double top = std::sqrt(top2);
  const double level_from = std::max(0.0, (top2 - first2) / (2 * a));
  const double level_to = std::max(level_from, length - (top2 - last2) / (2 * a));
  double time = 0.0;
  const auto ramp = [&](double v2, double distance) {  // from v2 up, or down to it
    const double v = std::sqrt(v2);
    return distance > 0 ? 2 * distance / (v + std::sqrt(v2 + 2 * a * distance)) : 0.0;
  };
  time += ramp(first2, std::min(s, level_from));
  if (s > level_from) time += (std::min(s, level_to) - level_from) / top;
  if (s > level_to) {
    time += ramp(last2, length - level_to) - ramp(last2, length - s);
  }
  return time;
}

std::vector<Speed> speeds(const Path& path, double rapid_feed) {
  std::vector<Speed> out;
  out.reserve(path.pieces.size());
  for (const Piece& piece : path.pieces) {
    const double v = piece.feed > 0 ? piece.feed : rapid_feed;
    out.push_back({v, v, v, infinite});
  }
  return out;
}

std::vector<Speed> speeds(Path& path, double rapid_feed, const Drives& drives) {
  const std::size_t n = path.pieces.size();
  std::vector<Speed> out;
  out.reserve(n);
  for (const Piece& piece : path.pieces) {
    out.push_back(limits_of(piece, rapid_feed, drives));
  }
  const auto reached = [&](double v, std::size_t i) {
    return std::sqrt(v * v + 2 * out[i].acceleration * path.pieces[i].length);
  };
  double next = 0.0;  // backward: what is slow enough for all that comes
  for (std::size_t i = n; i-- > 0;) {
    out[i].last = std::min(out[i].most, next);
    out[i].first = std::min(out[i].most, reached(out[i].last, i));
    next = i == 0 ? 0.0
                  : std::min(out[i].first,
                             passing_speed(path.pieces[i - 1], path.pieces[i], drives));
  }
  for (std::size_t i = 0; i < n; ++i) {  // forward: what is reached
    out[i].first = std::min(out[i].first, i == 0 ? 0.0 : out[i - 1].last);
    out[i].last = std::min(out[i].last, reached(out[i].first, i));
  }
  set_clock(path, out);
  return out;
}

}  // namespace trochoid::stock
