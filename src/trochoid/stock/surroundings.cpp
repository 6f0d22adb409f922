#include <trochoid/base/units.h>
#include <trochoid/stock/swept.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trochoid::stock {

namespace {

using geometry::StockBoundary;

/// Ends of arcs so close together are one: ties are the rule in paths of CAM programs [rad].
constexpr double tie = 2e-7;
/// Places on boundaries are found to this [m].
constexpr double on_boundary = 1e-9;
/// Where a circle without any boundary is asked: never on the axis of an old slot [rad].
constexpr double anywhere = 1.2345;
double squared(double x) noexcept {
  return x * x;
}

constexpr double first_theta = -std::numbers::pi / 2;

double wrapped(double theta) noexcept {
  return theta - unit::turn * std::floor((theta - first_theta) / unit::turn);
}

/// Whether an angle about a centre is in the sweep that begins at `start`.
bool in_sweep(double angle, double start, double sweep) noexcept {
  const double ahead = sweep > 0 ? angle - start : start - angle;
  return ahead - unit::turn * std::floor(ahead / unit::turn) <= std::abs(sweep);
}

/// An angle where stock may begin or end.
struct Candidate {
  double theta;
  StockBoundary boundary;
};

}  // namespace

Surroundings::Surroundings(const Swept& swept, const Place& place, double reach)
    : swept_(swept),
      place_(place),
      reach_(reach),
      cosine_(std::cos(place.direction)),
      sine_(std::sin(place.direction)) {
  const auto local = [&](double x, double y) {
    const double dx = x - place_.tip[0];
    const double dy = y - place_.tip[1];
    return std::array{cosine_ * dx + sine_ * dy, cosine_ * dy - sine_ * dx};
  };
  for (const std::uint32_t i : swept.near(place.tip[0], place.tip[1])) {
    const Piece& piece = swept.path().pieces[i];
    if (i > place.last || piece.turns_from > place.turns) {
      break;
    }
    if (i == place.last && place.without_last) {
      continue;
    }
    const double span = piece.turns_to - piece.turns_from;
    Near near{.piece = &piece,
              .radius = swept.radius(piece.tool),
              .until = span > 0 ? std::min((place.turns - piece.turns_from) / span, 1.0)
                                : 1.0};
    const double touch = near.radius + reach;
    if (piece.arc()) {
      const auto c = local(piece.center[0], piece.center[1]);
      near.x0 = c[0];
      near.y0 = c[1];
      near.start = piece.start - place.direction;
      if (std::abs(std::hypot(c[0], c[1]) - piece.radius) >= touch) {
        continue;
      }
    } else {
      const auto a = local(piece.from[0], piece.from[1]);
      const auto b = local(piece.to[0], piece.to[1]);
      near.x0 = a[0];
      near.y0 = a[1];
      near.x1 = b[0];
      near.y1 = b[1];
      const double dx = b[0] - a[0];
      const double dy = b[1] - a[1];
      const double l2 = dx * dx + dy * dy;
      const double u =
          l2 > 0 ? std::clamp(-(a[0] * dx + a[1] * dy) / l2, 0.0, 1.0) : 0.0;
      if (squared(a[0] + u * dx) + squared(a[1] + u * dy) >= touch * touch) {
        continue;
      }
    }
    near_.push_back(near);
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
  for (const Near& near : near_) {
    const Piece& piece = *near.piece;
    const double z0 = piece.from[2] - tip;
    const double z1 = z0 + near.until * (piece.to[2] - piece.from[2]);
    const auto [low, high] = std::minmax(z0, z1);
    if (low > from && low < to) {
      ends.push_back(low);
    }
    if (piece.upright() || low == high) {
      continue;
    }
    if (high > from && high < to) {
      ends.push_back(high);
    }
    // A helix comes back to the same place after a turn.
    const double share = std::max(1.0, std::abs(piece.turn) * near.until / unit::turn);
    slopes.push_back(
        {low, high, (high - low) / (share * sublayers[piece.arc() ? 1 : 0])});
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
  for (const Near& near : near_) {
    const Piece& piece = *near.piece;
    const double z0 = piece.from[2] - tip;
    const double z1 = z0 + near.until * (piece.to[2] - piece.from[2]);
    out.push_back(std::min(z0, z1));
  }
  std::ranges::sort(out);
  return out;
}

class Surroundings::Search {
 public:
  Search(const Surroundings& around, double height, double r)
      : around_(around), z_(around.place_.tip[2] + height), r_(r) {}

  std::vector<geometry::EngagedArc> arcs() {
    const Heights all = stock::heights(around_.swept_.initial());
    if (!(z_ > all.bottom && z_ < all.top)) {
      return {};
    }
    for (const Near& near : around_.near_) {
      add_part(near);
    }
    add_initial();
    return joined();
  }

 private:
  void add_part(const Near& near) {
    const Piece& piece = *near.piece;
    const double z0 = piece.from[2];
    const double z1 = piece.to[2];
    double from = 0.0;
    double to = near.until;
    if (z0 == z1) {
      if (z0 > z_) return;
    } else if (z1 < z0) {
      from = std::max(0.0, (z0 - z_) / (z0 - z1));
    } else {
      to = std::min(to, (z_ - z0) / (z1 - z0));
    }
    if (!(to >= from)) return;
    Part part{near.radius, piece.radius, near.x0, near.y0};
    if (piece.arc()) {
      const double whole = piece.turn * (to - from);
      const double sign = piece.turn > 0 ? 1.0 : -1.0;
      part.turn = sign * std::min(std::abs(whole), unit::turn);
      part.start = near.start + piece.turn * to - part.turn;
      const auto at = [&](double angle) {
        return std::array{near.x0 + piece.radius * std::cos(angle),
                          near.y0 + piece.radius * std::sin(angle)};
      };
      part.end = {at(part.start), at(part.start + part.turn)};
    } else {
      const double dx = near.x1 - near.x0;
      const double dy = near.y1 - near.y0;
      part.end = {std::array{near.x0 + from * dx, near.y0 + from * dy},
                  std::array{near.x0 + to * dx, near.y0 + to * dy}};
    }
    parts_.push_back(part);
    piece.arc() ? add_sector(part) : add_capsule(part);
  }

  struct Part {
    double R;       ///< of the tool
    double radius;  ///< of the path; 0: straight
    double x, y;    ///< centre of an arc
    double start = 0.0;
    double turn = 0.0;
    std::array<std::array<double, 2>, 2> end{};
  };

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

  void add_capsule(const Part& part) {
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

  void add_sector(const Part& part) {
    const auto all = [](double, double) { return true; };
    for (const auto& end : part.end) {
      add_circle(end[0], end[1], part.R, StockBoundary::Kind::outside, all);
    }
    add_circle(part.x, part.y, part.radius + part.R, StockBoundary::Kind::outside, all);
    if (part.radius > part.R) {
      add_circle(part.x, part.y, part.radius - part.R, StockBoundary::Kind::inside,
                 all);
    }
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
      add_field();
    }
  }

  /// Where the circle enters and leaves a field of heights: samples, then halving.
  void add_field() {
    constexpr int samples = 720;
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

  /// N-3
  [[nodiscard]] bool in_stock(double theta) const noexcept {
    const double x = r_ * std::sin(theta);
    const double y = r_ * std::cos(theta);
    for (const Part& part : parts_) {
      if (covers(part, x, y)) return false;
    }
    return in_initial(theta);
  }

  static bool covers(const Part& part, double x, double y) noexcept {
    const double R2 = part.R * part.R;
    const auto& [a, b] = part.end;
    if (part.radius > 0) {
      const double dx = x - part.x;
      const double dy = y - part.y;
      if (in_sweep(std::atan2(dy, dx), part.start, part.turn)) {
        return std::abs(std::hypot(dx, dy) - part.radius) < part.R;
      }
      return squared(x - a[0]) + squared(y - a[1]) < R2 ||
             squared(x - b[0]) + squared(y - b[1]) < R2;
    }
    const double dx = b[0] - a[0];
    const double dy = b[1] - a[1];
    const double l2 = dx * dx + dy * dy;
    const double along = (x - a[0]) * dx + (y - a[1]) * dy;
    const double u = l2 > 0 ? std::clamp(along / l2, 0.0, 1.0) : 0.0;
    return squared(x - a[0] - u * dx) + squared(y - a[1] - u * dy) < R2;
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
    std::vector<bool> stock(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double gap = theta(i + 1) - theta(i);
      stock[i] = gap > tie && in_stock(theta(i) + 0.5 * gap);
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
  double z_;
  double r_;
  std::vector<Part> parts_;
  std::vector<Candidate> candidates_;
};

std::vector<geometry::EngagedArc> Surroundings::arcs(double height, double r) const {
  return Search(*this, height, r).arcs();
}

}  // namespace trochoid::stock
