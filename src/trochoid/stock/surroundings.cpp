#include <trochoid/base/units.h>
#include <trochoid/stock/swept.h>

#include <algorithm>
#include <cmath>

namespace trochoid::stock {

namespace {

/// A helix of a tool that is not flat is taken as chords, this far from it [m].
constexpr double sagitta = 5e-7;
/// Of the wall of a tool that is not flat, and of what its slope rises, a layer takes this
/// part.
constexpr int layers_of_wall = 12;

}  // namespace

Surroundings::Surroundings(const Swept& swept, const Place& place, double reach)
    : swept_(swept),
      place_(place),
      reach_(reach),
      cosine_(std::cos(place.direction)),
      sine_(std::sin(place.direction)) {
  const Nearby nearby = swept.near(place, reach);
  for (const std::uint32_t i : nearby.pieces) {
    if (i > place.last || swept.path().pieces[i].turns_from > place.turns) break;
    if (i != place.last || !place.without_last) add_piece(i);
  }
  for (const std::uint32_t k : nearby.chains) add_chain(k);
}

void Surroundings::add_piece(std::uint32_t index) {
  const Piece& piece = swept_.path().pieces[index];
  const double dx = piece.from[0] - place_.tip[0];
  const double dy = piece.from[1] - place_.tip[1];
  const double farthest = swept_.wall(piece.tool).largest() + reach_ + piece.length;
  if (dx * dx + dy * dy >= farthest * farthest) return;
  const double span = piece.turns_to - piece.turns_from;
  const double until =
      span > 0 ? std::min((place_.turns - piece.turns_from) / span, 1.0) : 1.0;
  const Wall& wall = swept_.wall(piece.tool);
  const bool helix = piece.arc() && piece.from[2] != piece.to[2];
  if (helix && !wall.is_upright()) {
    add_chords(piece, wall, until);
  } else if (const auto near = near_of(piece, wall, until)) {
    near_.push_back(*near);
  }
}

void Surroundings::add_chain(std::uint32_t index) {
  const Chain& chain = swept_.chains()[index];
  const double dx = chain.middle[0] - place_.tip[0];
  const double dy = chain.middle[1] - place_.tip[1];
  const double farthest = chain.radius + chain.spread + reach_;
  if (dx * dx + dy * dy >= farthest * farthest) return;
  chains_.push_back({.place = index,
                     .middle = local(chain.middle[0], chain.middle[1]),
                     .spread = chain.spread,
                     .R = chain.radius,
                     .tip = chain.z - place_.tip[2]});
}

SlicePoint Surroundings::local(double x, double y) const noexcept {
  const double dx = x - place_.tip[0];
  const double dy = y - place_.tip[1];
  return {cosine_ * dx + sine_ * dy, cosine_ * dy - sine_ * dx};
}

bool Surroundings::is_far(const Near& near) const noexcept {
  const double touch = near.wall->largest() + reach_;
  if (near.radius > 0) {
    return std::abs(std::hypot(near.from[0], near.from[1]) - near.radius) >= touch;
  }
  const double dx = near.to[0] - near.from[0];
  const double dy = near.to[1] - near.from[1];
  const double l2 = dx * dx + dy * dy;
  const double u =
      l2 > 0 ? std::clamp(-(near.from[0] * dx + near.from[1] * dy) / l2, 0.0, 1.0)
             : 0.0;
  const double x = near.from[0] + u * dx;
  const double y = near.from[1] + u * dy;
  return x * x + y * y >= touch * touch;
}

std::optional<Surroundings::Near> Surroundings::near_of(const Piece& piece,
                                                        const Wall& wall,
                                                        double until) const {
  Near near{.wall = &wall,
            .radius = piece.radius,
            .turn = piece.turn,
            .until = until,
            .tip = {piece.from[2] - place_.tip[2], piece.to[2] - place_.tip[2]},
            .upright = piece.upright()};
  if (piece.arc()) {
    near.from = local(piece.center[0], piece.center[1]);
    near.start = piece.start - place_.direction;
  } else {
    near.from = local(piece.from[0], piece.from[1]);
    near.to = local(piece.to[0], piece.to[1]);
  }
  if (is_far(near)) return std::nullopt;
  return near;
}

void Surroundings::add_chords(const Piece& piece, const Wall& wall, double until) {
  const double angle = 2 * std::acos(std::max(1 - sagitta / piece.radius, 0.0));
  const int n = static_cast<int>(std::abs(piece.turn) * until / angle) + 1;
  PathPoint a = point_at(piece, 0.0);
  for (int k = 1; k <= n; ++k) {
    const PathPoint b = point_at(piece, until * k / n);
    const Near near{.wall = &wall,
                    .until = 1.0,
                    .tip = {a.place[2] - place_.tip[2], b.place[2] - place_.tip[2]},
                    .from = local(a.place[0], a.place[1]),
                    .to = local(b.place[0], b.place[1])};
    if (!is_far(near)) near_.push_back(near);
    a = b;
  }
}

std::vector<double> Surroundings::heights(std::array<int, 2> sublayers) const {
  struct Slope {
    double low, high;
    double sublayer;  ///< height of one [m]
  };
  const Heights all = stock::heights(swept_.initial());
  const double tip = place_.tip[2];
  const double from = std::max(all.bottom - tip, 0.0);
  const double to = all.top - tip;
  if (!(to > from)) {
    return {};
  }
  std::vector<double> ends{from, to};
  std::vector<Slope> slopes;
  const auto add = [&](double z) {
    if (z > from && z < to) ends.push_back(z);
  };
  for (const NearChain& chain : chains_) add(chain.tip);
  for (const Near& near : near_) {
    const auto [low, high] = near.tips();
    if (!near.wall->is_upright()) {
      const double top = high + near.wall->highest();
      add(low + near.wall->lowest());
      add(top);
      slopes.push_back({low + near.wall->lowest(), top,
                        (top - low - near.wall->lowest()) / layers_of_wall});
      continue;
    }
    add(low);
    if (near.upright || low == high) {
      continue;
    }
    add(high);
    // A helix comes back to the same place after a turn.
    const double share = std::max(1.0, std::abs(near.turn) * near.until / unit::turn);
    slopes.push_back(
        {low, high, (high - low) / (share * sublayers[near.radius > 0 ? 1 : 0])});
  }
  std::ranges::sort(ends);
  std::vector<double> out{from};
  for (const double end : ends) {
    const double start = out.back();
    if (end - start < 1e-10) {
      continue;
    }
    int parts = 1;
    for (const Slope& slope : slopes) {
      if (slope.low < end - 1e-10 && slope.high > start + 1e-10) {
        parts = std::max(
            parts, static_cast<int>(std::ceil((end - start) / slope.sublayer - 1e-9)));
      }
    }
    for (int i = 1; i <= parts; ++i) {
      out.push_back(i == parts ? end : start + (end - start) * i / parts);
    }
  }
  return out;
}

std::vector<double> Surroundings::levels() const {
  const Heights all = stock::heights(swept_.initial());
  const double tip = place_.tip[2];
  std::vector<double> out{all.bottom - tip, all.top - tip};
  for (const NearChain& chain : chains_) out.push_back(chain.tip);
  for (const Near& near : near_) {
    out.push_back(near.tips().first);
  }
  std::ranges::sort(out);
  return out;
}

}  // namespace trochoid::stock
