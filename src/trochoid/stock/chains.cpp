#include <trochoid/stock/chains.h>

#include <trochoid/stock/short_parts.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>

namespace trochoid::stock {

namespace {

/// A piece of a chain is at most this part of the radius long, and a chain reaches so far
/// from where it begins.
constexpr double longest_piece = 0.25;
constexpr double longest_chain = 0.4;
constexpr std::uint32_t most_pieces = 24;
/// So many chains come near one before it is looked at again whether they hide it.
constexpr int worth_a_look = 6;
/// Arcs of discs have to overlap by this [rad], and circles lie inside by this part.
constexpr double overlap_angle = 1e-6;
constexpr double a_little = 1e-9;

double distance(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}

std::array<double, 2> in_plane(const Point& p) noexcept {
  return {p[0], p[1]};
}

bool may_be_chained(const Piece& piece, double R) noexcept {
  return R > 0 && !piece.arc() && piece.from[2] == piece.to[2] &&
         piece.horizontal <= longest_piece * R;
}

/// @param first, last  pieces of a chain
Chain chain_of(const Path& path, std::uint32_t first, std::uint32_t last, double R) {
  Chain out{.first = first, .last = last, .alone = false, .radius = R};
  out.middle = in_plane(path.pieces[first + (last - first + 1) / 2].from);
  out.z = path.pieces[first].from[2];
  for (std::uint32_t i = first; i <= last; ++i) {
    const Piece& piece = path.pieces[i];
    for (const Point& end : {piece.from, piece.to}) {
      out.spread = std::max(out.spread, distance(out.middle, in_plane(end)));
    }
  }
  return out;
}

std::vector<Chain> chained(const Path& path, const std::vector<std::uint32_t>& pieces,
                           const std::function<double(const Piece&)>& radius) {
  std::vector<Chain> out;
  for (std::size_t k = 0; k < pieces.size();) {
    const std::uint32_t first = pieces[k];
    const Piece& start = path.pieces[first];
    const double R = radius(start);
    if (!may_be_chained(start, R)) {
      out.push_back({.first = first, .last = first});
      ++k;
      continue;
    }
    std::uint32_t last = first;
    for (++k; k < pieces.size() && pieces[k] == last + 1; ++k) {
      const Piece& next = path.pieces[last + 1];
      if (last + 1 - first >= most_pieces || next.tool != start.tool ||
          next.from != path.pieces[last].to || !may_be_chained(next, R) ||
          next.to[2] != start.from[2] ||
          distance(in_plane(start.from), in_plane(next.to)) > longest_chain * R) {
        break;
      }
      ++last;
    }
    out.push_back(chain_of(path, first, last, R));
  }
  return out;
}

/// Chains that are not hidden so far, by where they are.
class Hiding {
 public:
  explicit Hiding(std::vector<Chain>& all) : all_(all), near_(all.size()) {
    for (const Chain& one : all) cell_ = std::max(cell_, one.radius);
  }

  void run() {
    if (!(cell_ > 0)) return;
    for (std::size_t k = 0; k < all_.size(); ++k) {
      if (!all_[k].alone) add(k);
    }
  }

 private:
  using Key = std::int64_t;
  [[nodiscard]] static Key key(std::int64_t i, std::int64_t j) noexcept {
    return i * 2'000'003 + j;
  }
  [[nodiscard]] std::int64_t place(double x) const noexcept {
    return static_cast<std::int64_t>(std::floor(x / cell_));
  }

  template <class Function>
  void for_each_near(const Chain& chain, const Function& f) {
    const std::int64_t i = place(chain.middle[0]);
    const std::int64_t j = place(chain.middle[1]);
    for (std::int64_t a = i - 1; a <= i + 1; ++a) {
      for (std::int64_t b = j - 1; b <= j + 1; ++b) {
        const auto cell = cells_.find(key(a, b));
        if (cell == cells_.end()) continue;
        for (const std::size_t k : cell->second) f(k);
      }
    }
  }

  void add(std::size_t k) {
    const Chain& chain = all_[k];
    looks_.clear();
    for_each_near(chain, [&](std::size_t other) {
      if (can_hide(chain, all_[other]) && ++near_[other] >= worth_a_look) {
        near_[other] = 0;
        looks_.push_back(other);
      }
    });
    cells_[key(place(chain.middle[0]), place(chain.middle[1]))].push_back(k);
    for (const std::size_t other : looks_) {
      if (is_hidden(other)) hide(other, chain.last);
    }
  }

  [[nodiscard]] static bool can_hide(const Chain& by, const Chain& chain) noexcept {
    return by.z <= chain.z &&
           distance(by.middle, chain.middle) < by.radius * (1 - a_little);
  }

  /// N-27
  [[nodiscard]] bool is_hidden(std::size_t k) {
    const Chain& chain = all_[k];
    const double reach = (chain.radius + chain.spread) * (1 + a_little);
    arcs_.clear();
    for_each_near(chain, [&](std::size_t other) {
      const Chain& by = all_[other];
      if (other == k || !can_hide(by, chain)) return;
      const SlicePoint at{by.middle[0] - chain.middle[0],
                          by.middle[1] - chain.middle[1]};
      if (const auto arc = disc_arc(at, by.radius, reach);
          arc && arc->to - arc->from > 2 * overlap_angle) {
        arcs_.push_back({arc->from + overlap_angle, arc->to - overlap_angle});
      }
    });
    return std::ranges::any_of(joined(arcs_), goes_round);
  }

  void hide(std::size_t k, std::uint32_t by) {
    Chain& chain = all_[k];
    chain.hidden_by = by;
    auto& cell = cells_[key(place(chain.middle[0]), place(chain.middle[1]))];
    std::erase(cell, k);
  }

  std::vector<Chain>& all_;
  std::vector<int> near_;  ///< how many came near since the last look
  double cell_ = 0.0;
  std::unordered_map<Key, std::vector<std::size_t>> cells_;
  std::vector<std::size_t> looks_;
  std::vector<geometry::Arc> arcs_;
};

}  // namespace

std::vector<Chain> chains(const Path& path, const std::vector<std::uint32_t>& pieces,
                          const std::function<double(const Piece&)>& radius) {
  std::vector<Chain> out = chained(path, pieces, radius);
  Hiding(out).run();
  return out;
}

}  // namespace trochoid::stock
