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
constexpr std::size_t chain_parts = 12;
/// Ends of the stretches of discs are left to the exact parts [rad].
constexpr double margin = 0.02;
/// Within no arc.
constexpr Arc beyond_all = {0.0, 10 * unit::turn};

double squared(double x) noexcept {
  return x * x;
}

double distance2(const SlicePoint& a, const SlicePoint& b) noexcept {
  return squared(b[0] - a[0]) + squared(b[1] - a[1]);
}

/// What a disc covers of the circle; nothing where it does not cross it.
std::optional<Arc> disc_arc(const SlicePoint& at, double R, double r) noexcept {
  const double D2 = squared(at[0]) + squared(at[1]);
  const double c = (r * r + D2 - R * R) / (2 * r * std::sqrt(D2));
  if (!(std::abs(c) < 1)) return std::nullopt;
  const double beta = std::atan2(at[0], at[1]);
  const double gamma = std::acos(c);
  return Arc{beta - gamma, beta + gamma};
}

/// Both arcs, and so much more on both sides.
Arc hull_of(const Arc& a, const Arc& b, double more) noexcept {
  const double turns = unit::turn * std::round((a.from - b.from) / unit::turn);
  return {std::min(a.from, b.from + turns) - more, std::max(a.to, b.to + turns) + more};
}

bool goes_round(const Arc& arc) noexcept {
  return arc.to - arc.from >= unit::turn;
}

bool is_within(std::span<const Arc> arcs, const Arc& arc) noexcept {
  return std::ranges::any_of(arcs, [&](const Arc& all) {
    const double turns = unit::turn * std::floor((arc.from - all.from) / unit::turn);
    return goes_round(all) || arc.to - turns <= all.to;
  });
}

/// The union of arcs.
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
struct Chain {
  std::size_t from = 0;
  std::size_t to = 0;  ///< behind the last
};

Chain chain_from(std::span<const SlicePart> parts, std::size_t from) noexcept {
  std::size_t to = from + 1;
  while (to < parts.size() && to - from < chain_parts &&
         parts[to - 1].end[1] == parts[to].end[0] && parts[to].R == parts[from].R) {
    ++to;
  }
  return {from, to};
}

/// Parts of chains that do not lie deep in what others cover.
/// @param discs  gets what the discs in the middle of all chains cover
std::vector<std::size_t> parts_left(std::span<const SlicePart> parts, double r,
                                    std::vector<Arc>& discs) {
  std::vector<Chain> chains;
  std::vector<Arc> reach;
  for (std::size_t from = 0; from < parts.size(); from = chains.back().to) {
    const Chain chain = chains.emplace_back(chain_from(parts, from));
    const SlicePoint middle = parts[(chain.from + chain.to) / 2].end[0];
    double far2 = 0.0;
    for (std::size_t i = chain.from; i < chain.to; ++i) {
      for (const SlicePoint& p : parts[i].end) {
        far2 = std::max(far2, distance2(p, middle));
      }
    }
    const double R = parts[from].R;
    const auto disc = disc_arc(middle, R, r);
    const auto most = disc_arc(middle, R + std::sqrt(far2), r);
    if (disc) discs.push_back(*disc);
    reach.push_back(disc && most ? *most : beyond_all);
  }
  const std::vector<Arc> inner = inside_of(discs);
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < chains.size(); ++k) {
    if (is_within(inner, reach[k])) continue;
    for (std::size_t i = chains[k].from; i < chains[k].to; ++i) out.push_back(i);
  }
  return out;
}

}  // namespace

bool is_short(const SlicePart& part, double r) noexcept {
  return !(part.radius > 0) && !part.slopes() &&
         distance2(part.end[0], part.end[1]) < squared(short_part * r);
}

ShortParts short_parts(std::span<const SlicePart> parts, double r) {
  ShortParts out;
  if (parts.size() < worth_discs) {
    for (std::size_t i = 0; i < parts.size(); ++i) out.exactly.push_back(i);
    return out;
  }
  std::vector<Arc> discs;
  const std::vector<std::size_t> left = parts_left(parts, r, discs);
  std::vector<Arc> reach;  // of both discs of each part, and a little
  for (const std::size_t i : left) {
    const SlicePart& part = parts[i];
    const auto a = disc_arc(part.end[0], part.R, r);
    const auto b = disc_arc(part.end[1], part.R, r);
    if (a) discs.push_back(*a);
    if (b) discs.push_back(*b);
    const double length = std::sqrt(distance2(part.end[0], part.end[1]));
    reach.push_back(a && b ? hull_of(*a, *b, 2 * length / r) : beyond_all);
  }
  out.covered = inside_of(std::move(discs));
  out.all_around = std::ranges::any_of(out.covered, goes_round);
  if (out.all_around) return out;
  for (std::size_t k = 0; k < left.size(); ++k) {
    if (!is_within(out.covered, reach[k])) out.exactly.push_back(left[k]);
  }
  return out;
}

}  // namespace trochoid::stock
