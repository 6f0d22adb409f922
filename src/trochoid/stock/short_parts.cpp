#include <trochoid/stock/short_parts.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace trochoid::stock {

namespace {

using geometry::Arc;

/// A part shorter than this part of the radius is short; from so many on discs pay.
constexpr double short_part = 0.25;
constexpr std::size_t worth_discs = 16;
/// Parts that follow one another, of which one tells most.
constexpr std::size_t row_parts = 6;
/// Ends of the stretches of discs are left to the exact parts [rad].
constexpr double margin = 1e-4;
/// Within no arc.
constexpr Arc beyond_all = {0.0, 10 * unit::turn};

double squared(double x) noexcept {
  return x * x;
}

double distance2(const SlicePoint& a, const SlicePoint& b) noexcept {
  return squared(b[0] - a[0]) + squared(b[1] - a[1]);
}

/// Where a disc stands.
struct Polar {
  double D2 = 0.0;    ///< squared distance from the axis [m^2]
  double beta = 0.0;  ///< [rad]
};

Polar polar_of(const SlicePoint& at) noexcept {
  return {squared(at[0]) + squared(at[1]), std::atan2(at[0], at[1])};
}

/// What a disc covers of the circle; nothing where it does not cross it.
std::optional<Arc> arc_of(const Polar& at, double R, double r) noexcept {
  const double c = (r * r + at.D2 - R * R) / (2 * r * std::sqrt(at.D2));
  if (!(std::abs(c) < 1)) return std::nullopt;
  const double gamma = std::acos(c);
  return Arc{at.beta - gamma, at.beta + gamma};
}

/// All that a disc may cover; nothing where it does not reach the circle.
std::optional<Arc> reach_of(const Polar& at, double R, double r) noexcept {
  if (at.D2 >= squared(R + r)) return std::nullopt;
  return arc_of(at, R, r).value_or(beyond_all);
}

/// Both of them.
std::optional<Arc> hull_of(const std::optional<Arc>& a,
                           const std::optional<Arc>& b) noexcept {
  if (!a || !b) return a ? a : b;
  const double turns = unit::turn * std::round((a->from - b->from) / unit::turn);
  return Arc{std::min(a->from, b->from + turns), std::max(a->to, b->to + turns)};
}

bool is_within(std::span<const Arc> arcs, const Arc& arc) noexcept {
  return std::ranges::any_of(arcs, [&](const Arc& all) {
    const double turns = unit::turn * std::floor((arc.from - all.from) / unit::turn);
    return goes_round(all) || arc.to - turns <= all.to;
  });
}

/// The union without a margin at its ends.
std::vector<Arc> inside_of(std::vector<Arc> arcs) {
  std::vector<Arc> out = joined(std::move(arcs));
  for (Arc& arc : out) {
    if (goes_round(arc)) continue;
    const double less = std::min(margin, 0.25 * (arc.to - arc.from));
    arc = {arc.from + less, arc.to - less};
  }
  return out;
}

/// Parts that follow one another.
struct PartRow {
  std::size_t from = 0;
  std::size_t to = 0;  ///< behind the last
};

PartRow row_from(std::span<const SlicePart> parts, std::size_t from) noexcept {
  std::size_t to = from + 1;
  while (to < parts.size() && to - from < row_parts &&
         parts[to - 1].end[1] == parts[to].end[0] && parts[to].R == parts[from].R) {
    ++to;
  }
  return {from, to};
}

/// Parts of rows that do not lie deep in what others cover.
/// @param discs  gets what the discs in the middle of all rows cover
std::vector<std::size_t> parts_left(std::span<const SlicePart> parts, double r,
                                    std::vector<Arc>& discs) {
  std::vector<PartRow> rows;
  std::vector<Arc> reach;
  for (std::size_t from = 0; from < parts.size();) {
    const PartRow row = row_from(parts, from);
    from = row.to;
    const SlicePoint middle = parts[(row.from + row.to) / 2].end[0];
    double far2 = 0.0;
    for (std::size_t i = row.from; i < row.to; ++i) {
      for (const SlicePoint& p : parts[i].end) {
        far2 = std::max(far2, distance2(p, middle));
      }
    }
    const double R = parts[row.from].R;
    const Polar at = polar_of(middle);
    const auto most = reach_of(at, R + std::sqrt(far2), r);
    if (!most) continue;
    if (const auto disc = arc_of(at, R, r)) discs.push_back(*disc);
    rows.push_back(row);
    reach.push_back(*most);
  }
  const std::vector<Arc> inner = inside_of(discs);
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (is_within(inner, reach[k])) continue;
    for (std::size_t i = rows[k].from; i < rows[k].to; ++i) out.push_back(i);
  }
  return out;
}

}  // namespace

std::optional<Arc> disc_arc(const SlicePoint& at, double R, double r) noexcept {
  return arc_of(polar_of(at), R, r);
}

bool goes_round(const Arc& arc) noexcept {
  return arc.to - arc.from >= unit::turn;
}

std::vector<Arc> joined(std::vector<Arc> arcs) {
  for (Arc& arc : arcs) {
    const double turns = unit::turn * std::floor(arc.from / unit::turn);
    arc = {arc.from - turns, arc.to - turns};
  }
  std::ranges::sort(arcs, {}, &Arc::from);
  std::vector<Arc> out;
  for (const Arc& arc : arcs) {
    if (!out.empty() && arc.from <= out.back().to) {
      out.back().to = std::max(out.back().to, arc.to);
    } else {
      out.push_back(arc);
    }
  }
  // The last ones may reach round to the first.
  while (out.size() > 1 && out.back().to - unit::turn >= out.front().from) {
    out.back().to = std::max(out.back().to, out.front().to + unit::turn);
    out.erase(out.begin());
  }
  return out;
}

std::vector<std::size_t> chains_left(std::span<const NearChain> chains, double height,
                                     double r, std::vector<Arc>& discs) {
  std::vector<std::size_t> out;
  std::vector<Arc> reach;
  for (std::size_t k = 0; k < chains.size(); ++k) {
    const NearChain& chain = chains[k];
    if (chain.tip > height) continue;
    const Polar at = polar_of(chain.middle);
    const auto most = reach_of(at, chain.R + chain.spread, r);
    if (!most) continue;
    if (const auto disc = arc_of(at, chain.R, r)) discs.push_back(*disc);
    out.push_back(k);
    reach.push_back(*most);
  }
  const std::vector<Arc> inner = inside_of(discs);
  std::size_t left = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!is_within(inner, reach[k])) out[left++] = out[k];
  }
  out.resize(left);
  return out;
}

bool is_short(const SlicePart& part, double r) noexcept {
  return !(part.radius > 0) && !part.slopes() &&
         distance2(part.end[0], part.end[1]) < squared(short_part * r);
}

ShortParts short_parts(std::span<const SlicePart> parts, double r,
                       std::vector<Arc> discs) {
  ShortParts out;
  if (discs.empty() && parts.size() < worth_discs) {
    for (std::size_t i = 0; i < parts.size(); ++i) out.exactly.push_back(i);
    return out;
  }
  const std::vector<std::size_t> left = parts_left(parts, r, discs);
  std::vector<std::optional<Arc>> reach;
  SlicePoint known{};
  Polar at_known = polar_of(known);
  const auto polar = [&](const SlicePoint& p) {
    if (p != known) at_known = polar_of(known = p);
    return at_known;
  };
  for (const std::size_t i : left) {
    const SlicePart& part = parts[i];
    const Polar a = polar(part.end[0]);
    const Polar b = polar(part.end[1]);
    if (const auto disc = arc_of(a, part.R, r)) discs.push_back(*disc);
    if (const auto disc = arc_of(b, part.R, r)) discs.push_back(*disc);
    // All that the part covers is so near to one of its ends.
    const double far =
        std::sqrt(squared(part.R) + 0.25 * distance2(part.end[0], part.end[1]));
    reach.push_back(hull_of(reach_of(a, far, r), reach_of(b, far, r)));
  }
  out.covered = inside_of(std::move(discs));
  out.all_around = std::ranges::any_of(out.covered, goes_round);
  if (out.all_around) return out;
  for (std::size_t k = 0; k < left.size(); ++k) {
    if (reach[k] && !is_within(out.covered, *reach[k])) {
      out.exactly.push_back(left[k]);
    }
  }
  return out;
}

}  // namespace trochoid::stock
