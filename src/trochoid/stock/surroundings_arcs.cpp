#include <trochoid/base/units.h>
#include <trochoid/stock/short_parts.h>
#include <trochoid/stock/slice_part.h>
#include <trochoid/stock/swept.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace trochoid::stock {

namespace {

using geometry::StockBoundary;

/// Ends of arcs so close together are one: ties are the rule in paths of CAM programs [rad].
constexpr double tie = 2e-7;
/// Places on boundaries are found to this [m].
constexpr double on_boundary = 1e-9;
/// Angles at which a circle is asked for the edges of slopes.
constexpr int looks = 144;
/// Edges of a slope are found to this [rad].
constexpr double crossing = 1e-10;
/// Where a circle without any boundary is asked: never on the axis of an old slot [rad].
constexpr double anywhere = 1.2345;
constexpr double first_theta = -std::numbers::pi / 2;

double wrapped(double theta) noexcept {
  return theta - unit::turn * std::floor((theta - first_theta) / unit::turn);
}

/// An angle where stock may begin or end.
struct Candidate {
  double theta;
  StockBoundary boundary;
};

}  // namespace

class Surroundings::Search {
 public:
  Search(const Surroundings& around, double height, double r)
      : around_(around), height_(height), z_(around.place_.tip[2] + height), r_(r) {}

  std::vector<geometry::EngagedArc> arcs() {
    const Heights all = stock::heights(around_.swept_.initial());
    if (!(z_ > all.bottom && z_ < all.top)) {
      return {};
    }
    for (const Near& near : around_.near_) {
      add_part(near);
    }
    add_chains();
    add_short();
    add_slopes();
    add_initial();
    return joined();
  }

 private:
  /// The part of a piece, from one fraction of it to another, that is below this height.
  void add_part(const Near& near) {
    const double base = near.wall->lowest();
    const double z0 = near.tip[0] + base - height_;
    const double z1 = near.tip[1] + base - height_;
    double from = 0.0;
    double to = near.until;
    if (z0 == z1) {
      if (z0 > 0) return;
    } else if (z1 < z0) {
      from = std::max(0.0, z0 / (z0 - z1));
    } else {
      to = std::min(to, -z0 / (z1 - z0));
    }
    if (!(to >= from)) return;
    const auto above_tip = [&](double u) { return base - z0 - u * (z1 - z0); };
    SlicePart part{.R = near.wall->largest(), .radius = near.radius};
    if (!near.wall->is_upright()) {
      const std::array<double, 2> height{above_tip(from), above_tip(to)};
      const double lower = near.wall->radius(std::min(height[0], height[1]));
      part.R = near.wall->radius(std::max(height[0], height[1]));
      if (!(part.R > 0)) return;
      if (lower < part.R && !near.upright) {
        part.wall = near.wall;
        part.height = height;
        part.smallest = lower;
      }
    }
    if (near.radius > 0) {
      const double whole = near.turn * (to - from);
      const double sign = near.turn > 0 ? 1.0 : -1.0;
      part.center = near.from;
      part.turn = sign * std::min(std::abs(whole), unit::turn);
      part.start = near.start + near.turn * to - part.turn;
      const auto at = [&](double angle) {
        return SlicePoint{near.from[0] + near.radius * std::cos(angle),
                          near.from[1] + near.radius * std::sin(angle)};
      };
      part.end = {at(part.start), at(part.start + part.turn)};
    } else {
      const double dx = near.to[0] - near.from[0];
      const double dy = near.to[1] - near.from[1];
      part.end = {SlicePoint{near.from[0] + from * dx, near.from[1] + from * dy},
                  SlicePoint{near.from[0] + to * dx, near.from[1] + to * dy}};
    }
    if (part.slopes()) {
      slopes_.push_back(part);
      return;
    }
    if (is_short(part, r_)) {
      short_.push_back(part);
    } else {
      add_exactly(part);
    }
  }

  void add_exactly(const SlicePart& part) {
    const std::size_t first = candidates_.size();
    part.radius > 0 ? add_sector(part) : add_capsule(part);
    add_covered(part, first);
  }

  /// Chains whose pieces count: opened, and the others as the discs in their middle.
  void add_chains() {
    for (const std::size_t k : chains_left(around_.chains_, height_, r_, discs_)) {
      const Chain& chain = around_.swept_.chains()[around_.chains_[k].place];
      for (std::uint32_t i = chain.first; i <= chain.last; ++i) {
        const Piece& piece = around_.swept_.path().pieces[i];
        const Wall& wall = around_.swept_.wall(piece.tool);
        if (const auto near = around_.near_of(piece, wall, 1.0)) add_part(*near);
      }
    }
  }

  void add_short() {
    const ShortParts found = short_parts(short_, r_, std::move(discs_));
    all_covered_ = all_covered_ || found.all_around;
    for (const geometry::Arc& arc : found.covered) {
      const double from = wrapped(arc.from);
      covered_.push_back({from, from + arc.to - arc.from});
      candidates_.push_back({from, {}});
      candidates_.push_back({wrapped(arc.to), {}});
    }
    for (const std::size_t i : found.exactly) add_exactly(short_[i]);
  }

  /// The stretches of the circle that a part covers, between its own candidates.
  void add_covered(const SlicePart& part, std::size_t first) {
    const auto is_covered = [&](double theta) {
      return covers(part, r_ * std::sin(theta), r_ * std::cos(theta));
    };
    if (first == candidates_.size()) {
      all_covered_ = all_covered_ || is_covered(anywhere);
      return;
    }
    own_.clear();
    for (std::size_t i = first; i < candidates_.size(); ++i) {
      own_.push_back(candidates_[i].theta);
    }
    std::ranges::sort(own_);
    for (std::size_t i = 0; i < own_.size(); ++i) {
      const double from = own_[i];
      const double to = i + 1 < own_.size() ? own_[i + 1] : own_[0] + unit::turn;
      if (to - from > tie && is_covered(0.5 * (from + to))) {
        covered_.push_back({from, to});
      }
    }
  }

  void add(double x, double y, const StockBoundary& boundary) {
    candidates_.push_back({wrapped(std::atan2(x, y)), boundary});
  }

  /// Line q . n = o with stock beyond, n a unit vector; f says which places count.
  template <class Function>
  void add_line(double nx, double ny, double o, const Function& counts) {
    if (std::abs(o) > r_ + 1e-12) return;
    const double root = std::sqrt(std::max(r_ * r_ - o * o, 0.0));
    const StockBoundary boundary{StockBoundary::Kind::line, std::atan2(nx, ny), o};
    for (const double s : {-root, root}) {
      const double x = o * nx + s * ny;
      const double y = o * ny - s * nx;
      if (counts(x, y)) add(x, y, boundary);
    }
  }

  template <class Function>
  void add_circle(double cx, double cy, double R, StockBoundary::Kind kind,
                  const Function& counts) {
    const double D = std::hypot(cx, cy);
    if (D < 1e-12) return;
    const double c = (r_ * r_ + D * D - R * R) / (2 * r_ * D);
    if (std::abs(c) > 1 + 1e-12) return;
    const double gamma = std::acos(std::clamp(c, -1.0, 1.0));
    const StockBoundary boundary{kind, std::atan2(cx, cy), D, R};
    for (const double theta : {boundary.beta - gamma, boundary.beta + gamma}) {
      if (counts(r_ * std::sin(theta), r_ * std::cos(theta))) {
        candidates_.push_back({wrapped(theta), boundary});
      }
    }
  }

  void add_capsule(const SlicePart& part) {
    const auto& [a, b] = part.end;
    const double l = std::hypot(b[0] - a[0], b[1] - a[1]);
    const double dx = l > 0 ? (b[0] - a[0]) / l : 0.0;
    const double dy = l > 0 ? (b[1] - a[1]) / l : 0.0;
    const double before = a[0] * dx + a[1] * dy;
    const double after = b[0] * dx + b[1] * dy;
    if (l > 0) {
      const auto beside = [&](double x, double y) {
        const double s = x * dx + y * dy;
        return s >= before - on_boundary && s <= after + on_boundary;
      };
      const double axis = a[1] * dx - a[0] * dy;
      add_line(-dy, dx, axis + part.R, beside);
      add_line(dy, -dx, part.R - axis, beside);
    }
    const auto outside = StockBoundary::Kind::outside;
    add_circle(a[0], a[1], part.R, outside, [&](double x, double y) {
      return !(l > 0) || x * dx + y * dy <= before + on_boundary;
    });
    if (l > 0) {
      add_circle(b[0], b[1], part.R, outside, [&](double x, double y) {
        return x * dx + y * dy >= after - on_boundary;
      });
    }
  }

  void add_sector(const SlicePart& part) {
    const auto all = [](double, double) { return true; };
    for (const auto& end : part.end) {
      add_circle(end[0], end[1], part.R, StockBoundary::Kind::outside, all);
    }
    add_circle(part.center[0], part.center[1], part.radius + part.R,
               StockBoundary::Kind::outside, all);
    if (part.radius > part.R) {
      add_circle(part.center[0], part.center[1], part.radius - part.R,
                 StockBoundary::Kind::inside, all);
    }
  }

  /// The part on a slope that covers an angle, looked for from `first` on; none: their
  /// number.
  [[nodiscard]] std::size_t slope_over(double theta, std::size_t first) const noexcept {
    const double x = r_ * std::sin(theta);
    const double y = r_ * std::cos(theta);
    const std::size_t n = slopes_.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = (first + i) % n;
      if (covers(slopes_[k], x, y)) return k;
    }
    return n;
  }

  /// Where the circle enters and leaves what the parts on slopes cover together.
  void add_slopes() {
    if (slopes_.empty()) return;
    const std::size_t none = slopes_.size();
    double at = first_theta;
    std::size_t before = slope_over(at, 0);
    for (int i = 1; i <= looks; ++i) {
      const double next = first_theta + unit::turn * i / looks;
      const std::size_t after = slope_over(next, before % none);
      if (before != none && after == none) add_crossing(before, at, next);
      if (before == none && after != none) add_crossing(after, next, at);
      at = next;
      before = after;
    }
  }

  /// From an angle that a part covers to one that none does.
  void add_crossing(std::size_t part, double from, double to) {
    for (int tries = 0; tries < 8; ++tries) {
      const double edge = leave(slopes_[part], from, to);
      const std::size_t other = slope_over(edge + std::copysign(tie, to - from), part);
      if (other == slopes_.size() || other == part) {
        add_tangent(slopes_[part], edge);
        return;
      }
      part = other;
      from = edge;
    }
  }

  /// Where the circle leaves a part: false position with halved ends.
  [[nodiscard]] double leave(const SlicePart& part, double from,
                             double to) const noexcept {
    const auto depth = [&](double theta) {
      return overlap(part, r_ * std::sin(theta), r_ * std::cos(theta)).depth;
    };
    double a = from;
    double b = to;
    double at_a = depth(a);
    double at_b = depth(b);
    double theta = 0.5 * (a + b);
    for (int i = 0; i < 60 && std::abs(b - a) > crossing && at_a != at_b; ++i) {
      theta = b - at_b * (b - a) / (at_b - at_a);
      const double here = depth(theta);
      if (std::abs(here) < 1e-14) break;
      if ((here > 0) != (at_b > 0)) {
        a = b;
        at_a = at_b;
      } else {
        at_a *= 0.5;
      }
      b = theta;
      at_b = here;
    }
    return theta;
  }

  /// The boundary there is the tangent of the disc that reaches farthest.
  void add_tangent(const SlicePart& part, double theta) {
    const double x = r_ * std::sin(theta);
    const double y = r_ * std::cos(theta);
    const Overlap found = overlap(part, x, y);
    const double nx = x - found.center[0];
    const double ny = y - found.center[1];
    const double l = std::hypot(nx, ny);
    StockBoundary tangent{};
    if (l > 0) {
      tangent = {StockBoundary::Kind::line, std::atan2(nx, ny), (x * nx + y * ny) / l};
    }
    candidates_.push_back({wrapped(theta), tangent});
  }

  void add_initial() {
    const auto all = [](double, double) { return true; };
    const double c = around_.cosine_;
    const double s = around_.sine_;
    const Point& tip = around_.place_.tip;
    const Initial& initial = around_.swept_.initial();
    if (const auto* box = std::get_if<Box>(&initial)) {
      add_line(c, -s, box->low[0] - tip[0], all);
      add_line(-c, s, tip[0] - box->high[0], all);
      add_line(s, c, box->low[1] - tip[1], all);
      add_line(-s, -c, tip[1] - box->high[1], all);
    } else if (const auto* round = std::get_if<Cylinder>(&initial)) {
      const double dx = round->axis[0] - tip[0];
      const double dy = round->axis[1] - tip[1];
      add_circle(c * dx + s * dy, c * dy - s * dx, round->radius,
                 StockBoundary::Kind::inside, all);
    } else {
      add_field(std::get<HeightField>(initial).cell);
    }
  }

  /// Where the circle enters and leaves a field of heights: samples, two a cell, then
  /// halving.
  void add_field(double cell) {
    const int samples =
        std::clamp(static_cast<int>(2 * unit::turn * r_ / cell), 36, 720);
    bool before = in_initial(first_theta);
    for (int i = 1; i <= samples; ++i) {
      double lo = first_theta + unit::turn * (i - 1) / samples;
      double hi = first_theta + unit::turn * i / samples;
      const bool after = in_initial(hi);
      if (after != before) {
        for (int k = 0; k < 40; ++k) {
          const double middle = 0.5 * (lo + hi);
          (in_initial(middle) == before ? lo : hi) = middle;
        }
        candidates_.push_back({wrapped(0.5 * (lo + hi)), {}});
      }
      before = after;
    }
  }

  [[nodiscard]] bool in_initial(double theta) const noexcept {
    const double x = r_ * std::sin(theta);
    const double y = r_ * std::cos(theta);
    const double c = around_.cosine_;
    const double s = around_.sine_;
    const Point& tip = around_.place_.tip;
    return contains(around_.swept_.initial(), tip[0] + c * x - s * y,
                    tip[1] + s * x + c * y, z_);
  }

  /// N-3, but for the stretches in covered_.
  [[nodiscard]] bool in_stock(double theta) const noexcept {
    const double x = r_ * std::sin(theta);
    const double y = r_ * std::cos(theta);
    for (const SlicePart& part : slopes_) {
      if (covers(part, x, y)) return false;
    }
    return in_initial(theta);
  }

  /// How many parts cover each stretch between ends.
  /// @param ends  first candidate of each, ascending
  [[nodiscard]] std::vector<int> times_covered(
      const std::vector<std::size_t>& ends) const {
    const std::size_t n = ends.size();
    const auto theta_of = [&](std::size_t i) { return candidates_[i].theta; };
    const double first = theta_of(ends.front());
    const auto end_at = [&](double angle) {  // the last that is not above
      double theta = wrapped(angle);
      // Rounding may put an end on the other side of the cut.
      if (theta < first - tie) theta += unit::turn;
      if (theta > first + unit::turn - tie) return std::size_t{0};
      const auto above = std::ranges::upper_bound(ends, theta + 1e-12, {}, theta_of);
      return static_cast<std::size_t>(
          std::max<std::ptrdiff_t>(above - ends.begin() - 1, 0));
    };
    std::vector<int> steps(n + 1);
    int whole = 0;  // over the place where the circle is cut open
    for (const geometry::Arc& arc : covered_) {
      const std::size_t from = end_at(arc.from);
      const std::size_t to = end_at(arc.to);
      if (from == to && arc.to - arc.from < std::numbers::pi) continue;
      if (to <= from) ++whole;
      ++steps[from];
      --steps[to];
    }
    std::vector<int> out(n);
    int times = whole;
    for (std::size_t i = 0; i < n; ++i) {
      times += steps[i];
      out[i] = times;
    }
    return out;
  }

  /// The boundary among those that meet at an end, which has stock on one side only.
  [[nodiscard]] StockBoundary boundary_at(std::size_t from, std::size_t to,
                                          double inward) const noexcept {
    constexpr double a_little = 1e-6;
    for (std::size_t i = from; i < to; ++i) {
      const StockBoundary& b = candidates_[i].boundary;
      const double theta = candidates_[i].theta;
      const auto has_stock = [&](double at) {
        const geometry::Stretch s = clipped(b, at, {r_ * (1 - 1e-15), r_});
        return s.to > s.from;
      };
      if (b.kind != StockBoundary::Kind::none && has_stock(theta + inward * a_little) &&
          !has_stock(theta - inward * a_little)) {
        return b;
      }
    }
    return {};
  }

  /// Arcs of the stretches between candidates that are in stock.
  [[nodiscard]] std::vector<geometry::EngagedArc> joined() {
    if (all_covered_) return {};
    if (candidates_.empty()) {
      if (!in_stock(anywhere)) return {};
      return {{{first_theta, first_theta + unit::turn}}};
    }
    std::ranges::sort(candidates_, {}, &Candidate::theta);
    std::vector<std::size_t> ends;  // first candidate of each cluster
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (i == 0 || candidates_[i].theta - candidates_[i - 1].theta > tie) {
        ends.push_back(i);
      }
    }
    const std::size_t n = ends.size();
    const auto theta = [&](std::size_t i) {
      return candidates_[ends[i % n]].theta + (i >= n ? unit::turn : 0.0);
    };
    const auto boundary = [&](std::size_t i, double inward) {
      const std::size_t k = i % n;
      return boundary_at(ends[k], k + 1 < n ? ends[k + 1] : candidates_.size(), inward);
    };
    const std::vector<int> times = times_covered(ends);
    std::vector<bool> stock(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double gap = theta(i + 1) - theta(i);
      stock[i] = gap > tie && times[i] == 0 && in_stock(theta(i) + 0.5 * gap);
    }
    const auto out_at = static_cast<std::size_t>(
        std::find(stock.begin(), stock.end(), false) - stock.begin());
    if (out_at == n) {
      return {{{first_theta, first_theta + unit::turn}}};
    }
    std::vector<geometry::EngagedArc> out;
    for (std::size_t i = out_at; i < out_at + n;) {
      if (!stock[i % n]) {
        ++i;
        continue;
      }
      std::size_t k = i;
      while (stock[k % n]) ++k;
      const double shift = i >= n ? unit::turn : 0.0;
      const double from = theta(i) - shift;
      double to = theta(k % n);
      to += to < from ? unit::turn : 0.0;
      out.push_back({{from, to}, boundary(i, 1.0), boundary(k, -1.0)});
      i = k;
    }
    std::ranges::sort(out, {}, [](const auto& a) { return a.arc.from; });
    return out;
  }

  const Surroundings& around_;
  double height_;
  double z_;
  double r_;
  std::vector<SlicePart> slopes_;
  std::vector<SlicePart> short_;
  std::vector<geometry::Arc> discs_;    ///< that are covered by chains
  std::vector<geometry::Arc> covered_;  ///< by parts that are level
  std::vector<double> own_;
  bool all_covered_ = false;
  std::vector<Candidate> candidates_;
};

std::vector<geometry::EngagedArc> Surroundings::arcs(double height, double r) const {
  return Search(*this, height, r).arcs();
}

}  // namespace trochoid::stock
