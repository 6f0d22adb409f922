#include <trochoid/stock/swept.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace trochoid::stock {

namespace {

/// Cells of the index at most.
constexpr double most_cells = 4e6;
/// So few pieces are all looked at, whatever the map says.
constexpr std::size_t few = 24;
/// More pieces in a cell of the index, on the average, are a crowd.
constexpr double many = 1500;

double square(double x) noexcept {
  return x * x;
}

/// Distance of a point from the projection of a piece.
double distance_to(const Piece& piece, double x, double y) noexcept {
  if (piece.arc()) {
    const double dx = x - piece.center[0];
    const double dy = y - piece.center[1];
    return std::abs(std::hypot(dx, dy) - piece.radius);  // of the whole circle
  }
  const double ax = piece.to[0] - piece.from[0];
  const double ay = piece.to[1] - piece.from[1];
  const double l2 = ax * ax + ay * ay;
  const double along = (x - piece.from[0]) * ax + (y - piece.from[1]) * ay;
  const double u = l2 > 0 ? std::clamp(along / l2, 0.0, 1.0) : 0.0;
  return std::hypot(x - piece.from[0] - u * ax, y - piece.from[1] - u * ay);
}

/// A place on a straight piece.
std::array<double, 2> along(const Piece& piece, double u) noexcept {
  return {piece.from[0] + u * (piece.to[0] - piece.from[0]),
          piece.from[1] + u * (piece.to[1] - piece.from[1])};
}

struct Extent {
  std::array<double, 2> low;
  std::array<double, 2> high;
};

Extent extent(const Piece& piece) noexcept {
  Extent e{};
  for (std::size_t i = 0; i < 2; ++i) {
    if (piece.arc()) {
      e.low[i] = piece.center[i] - piece.radius;
      e.high[i] = piece.center[i] + piece.radius;
    } else {
      std::tie(e.low[i], e.high[i]) = std::minmax(piece.from[i], piece.to[i]);
    }
  }
  return e;
}

}  // namespace

Swept::Swept(Path path, Initial initial, std::vector<Wall> walls)
    : path_(std::move(path)), initial_(std::move(initial)), walls_(std::move(walls)) {
  fill();
}

template <class Function>
void Swept::for_each_cell(const Piece& piece, double reach, const Function& f) const {
  const Extent e = extent(piece);
  const auto place = [&](double x, std::size_t axis, int most) {
    return std::clamp(static_cast<int>(std::floor((x - origin_[axis]) / cell_)), 0,
                      most - 1);
  };
  const double corner = 0.70710678118654757 * cell_;
  const int last_column = place(e.high[0] + reach, 0, columns_);
  const int last_row = place(e.high[1] + reach, 1, rows_);
  for (int i = place(e.low[1] - reach, 1, rows_); i <= last_row; ++i) {
    for (int j = place(e.low[0] - reach, 0, columns_); j <= last_column; ++j) {
      if (distance_to(piece, origin_[0] + (j + 0.5) * cell_,
                      origin_[1] + (i + 0.5) * cell_) <= reach + corner) {
        f(static_cast<std::size_t>(i) * static_cast<std::size_t>(columns_) +
          static_cast<std::size_t>(j));
      }
    }
  }
}

void Swept::fill() {
  const double top = heights(initial_).top;
  double largest = 0.0;
  for (const Wall& wall : walls_) {
    largest = std::max(largest, wall.largest());
    all_flat_ = all_flat_ && wall.is_upright();
  }
  std::vector<std::uint32_t> cutting;
  std::array<double, 2> low{};
  std::array<double, 2> high{};
  for (std::uint32_t i = 0; i < path_.pieces.size(); ++i) {
    const Piece& piece = path_.pieces[i];
    if (!(radius(piece.tool) > 0) ||
        std::min(piece.from[2], piece.to[2]) + wall(piece.tool).lowest() >= top) {
      continue;
    }
    const Extent e = extent(piece);
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = cutting.empty() ? e.low[k] : std::min(low[k], e.low[k]);
      high[k] = cutting.empty() ? e.high[k] : std::max(high[k], e.high[k]);
    }
    cutting.push_back(i);
  }
  if (cutting.empty()) {
    return;
  }
  const double width = high[0] - low[0] + 4 * largest;
  const double depth = high[1] - low[1] + 4 * largest;
  cell_ = std::max(largest, std::sqrt(width * depth / most_cells));
  origin_ = {low[0] - 2 * largest, low[1] - 2 * largest};
  columns_ = static_cast<int>(width / cell_) + 1;
  rows_ = static_cast<int>(depth / cell_) + 1;
  first_.assign(
      static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  chains_ = stock::chains(path_, cutting, [&](const Piece& piece) {
    return wall(piece.tool).is_upright() ? radius(piece.tool) : 0.0;
  });
  index_chains(largest);
}

void Swept::index_chains(double largest) {
  const auto each = [&](const auto& f) {
    for (std::uint32_t k = 0; k < chains_.size(); ++k) {
      const Chain& chain = chains_[k];
      Piece piece = path_.pieces[chain.first];
      double reach = radius(piece.tool) + largest;
      if (!chain.alone) {
        piece.from = Point{chain.middle[0], chain.middle[1], chain.z};
        piece.to = piece.from;
        reach += chain.spread;
      }
      for_each_cell(piece, reach, [&](std::size_t cell) { f(cell, k); });
    }
  };
  each([&](std::size_t cell, std::uint32_t k) {
    ++first_[cell + 1];
    const Chain& chain = chains_[k];
    if (!chain.is_hidden()) indexed_ += chain.last + 1 - chain.first;
  });
  for (std::size_t i = 1; i < first_.size(); ++i) {
    used_ += first_[i] > 0 ? 1U : 0U;
    first_[i] += first_[i - 1];
  }
  in_cells_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  each([&](std::size_t cell, std::uint32_t k) { in_cells_[next[cell]++] = k; });
}

std::span<const std::uint32_t> Swept::in_cell(double x, double y) const noexcept {
  const double u = (x - origin_[0]) / cell_;
  const double v = (y - origin_[1]) / cell_;
  if (!(u >= 0 && v >= 0 && u < columns_ && v < rows_)) {
    return {};
  }
  const std::size_t cell =
      static_cast<std::size_t>(v) * static_cast<std::size_t>(columns_) +
      static_cast<std::size_t>(u);
  return std::span(in_cells_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
}

Nearby Swept::near(const Place& place, double reach) const {
  const std::span<const std::uint32_t> all = in_cell(place.tip[0], place.tip[1]);
  const bool by_map = map_ && (!all_flat_ || crowded()) && mapped_ > 0 &&
                      path_.pieces[mapped_ - 1].turns_to <= place.turns &&
                      all.size() > few;
  Nearby out;
  if (by_map) map_->add_near(place.tip[0], place.tip[1], reach, out.pieces);
  for (const std::uint32_t k : all) {
    const Chain& chain = chains_[k];
    if (chain.first > place.last ||
        path_.pieces[chain.first].turns_from > place.turns) {
      break;
    }
    if (by_map && chain.last < mapped_) continue;
    const bool hidden = chain.hidden_by < place.last &&
                        path_.pieces[chain.hidden_by].turns_to <= place.turns;
    if (hidden) continue;
    const bool whole =
        chain.last < place.last && path_.pieces[chain.last].turns_to <= place.turns;
    if (!chain.alone && whole && !by_map) {
      out.chains.push_back(k);
      continue;
    }
    const std::uint32_t first = by_map ? std::max(chain.first, mapped_) : chain.first;
    for (std::uint32_t i = first; i <= chain.last; ++i) out.pieces.push_back(i);
  }
  return out;
}

bool Swept::crowded() const noexcept {
  return static_cast<double>(indexed_) > many * static_cast<double>(used_);
}

void Swept::keep_map(double cell) {
  map_.emplace(initial_, cell);
  mapped_ = 0;
}

void Swept::sweep_to(double turns) {
  if (!map_) return;
  for (; mapped_ < path_.pieces.size() && path_.pieces[mapped_].turns_to <= turns;
       ++mapped_) {
    const Piece& piece = path_.pieces[mapped_];
    map_->cut(piece, mapped_, wall(piece.tool));
  }
}

namespace {

/// Stretches of x that are swept at one y.
class Scan {
 public:
  Scan(const Swept& swept, double height) : swept_(swept), z_(height) {}

  /// Adds the stretch of a piece at y.
  void add(const Piece& piece, double y) {
    const double R = swept_.radius(piece.tool);
    double from = 0.0;
    double to = 1.0;
    const double z0 = piece.from[2];
    const double z1 = piece.to[2];
    if (z0 == z1) {
      if (z0 > z_) return;
    } else if (z1 < z0) {
      from = std::max(0.0, (z0 - z_) / (z0 - z1));
    } else {
      to = std::min(1.0, (z_ - z0) / (z1 - z0));
    }
    if (!(to >= from)) return;
    if (piece.arc()) {
      add_sector(piece, R, from, to, y);
    } else {
      add_capsule(along(piece, from), along(piece, to), R, y);
    }
  }

  /// Length of [low, high] that is swept; begins anew.
  double swept_length(double low, double high) {
    std::ranges::sort(stretches_, {}, &geometry::Stretch::from);
    double length = 0.0;
    double at = low;
    for (const geometry::Stretch& s : stretches_) {
      const double from = std::max(at, s.from);
      const double to = std::min(high, s.to);
      if (to > from) {
        length += to - from;
        at = to;
      }
    }
    stretches_.clear();
    return length;
  }

 private:
  /// What touches the one before becomes a part of it: most pieces follow one another.
  void take(geometry::Stretch s) {
    if (!stretches_.empty() && s.from <= stretches_.back().to &&
        s.to >= stretches_.back().from) {
      geometry::Stretch& last = stretches_.back();
      last = {std::min(last.from, s.from), std::max(last.to, s.to)};
    } else {
      stretches_.push_back(s);
    }
  }

  void add_disc(double x, double y0, double R, double y) {
    const double rest = R * R - square(y - y0);
    if (rest > 0) {
      take({x - std::sqrt(rest), x + std::sqrt(rest)});
    }
  }

  void add_capsule(const std::array<double, 2>& a, const std::array<double, 2>& b,
                   double R, double y) {
    add_disc(a[0], a[1], R, y);
    add_disc(b[0], b[1], R, y);
    const double dx = b[0] - a[0];
    const double dy = b[1] - a[1];
    const double l = std::hypot(dx, dy);
    if (!(l > 0)) return;
    // |cross| <= R l and 0 <= along <= l^2 on the line y
    double lo = -std::numeric_limits<double>::infinity();
    double hi = std::numeric_limits<double>::infinity();
    const auto limit = [&](double slope, double constant, double low, double high) {
      if (slope == 0) {
        if (constant < low || constant > high) hi = lo;
        return;
      }
      const double p = (low - constant) / slope;
      const double q = (high - constant) / slope;
      lo = std::max(lo, std::min(p, q));
      hi = std::min(hi, std::max(p, q));
    };
    limit(-dy, dx * (y - a[1]), -R * l, R * l);
    limit(dx, dy * (y - a[1]), 0.0, l * l);
    if (hi > lo) {
      take({a[0] + lo, a[0] + hi});
    }
  }

  /// Its two end discs, and the part of the ring between the angles of its ends.
  void add_sector(const Piece& piece, double R, double from, double to, double y) {
    for (const double u : {from, to}) {
      const Point end = point_at(piece, u).place;
      add_disc(end[0], end[1], R, y);
    }
    const double dy = y - piece.center[1];
    const double outer = piece.radius + R;
    const double inner = std::max(0.0, piece.radius - R);
    if (!(std::abs(dy) < outer)) return;
    std::vector<double>& ends = crossings_;
    ends.clear();
    for (const double r : {inner, outer}) {
      const double rest = r * r - dy * dy;
      if (!(rest > 0)) continue;
      ends.push_back(-std::sqrt(rest));
      ends.push_back(std::sqrt(rest));
    }
    const double turn = piece.turn * (to - from);
    const double start = piece.start + piece.turn * from;
    for (const double angle : {start, start + turn}) {
      const double along = dy / std::sin(angle);
      if (along > 0 && along < outer) ends.push_back(along * std::cos(angle));
    }
    std::ranges::sort(ends);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const double x = 0.5 * (ends[i] + ends[i + 1]);
      const double r = std::hypot(x, dy);
      if (r < inner || r > outer) continue;
      const double behind = std::copysign(1.0, turn) * (std::atan2(dy, x) - start);
      const double past = behind - unit_turn * std::floor(behind / unit_turn);
      if (past <= std::abs(turn)) {
        take({piece.center[0] + ends[i], piece.center[0] + ends[i + 1]});
      }
    }
  }

  static constexpr double unit_turn = 6.283185307179586;
  const Swept& swept_;
  double z_;
  std::vector<geometry::Stretch> stretches_;
  std::vector<double> crossings_;  ///< of a ring with the line, from its centre
};

/// Stock along x at y, before anything is cut.
geometry::Stretch whole(const Initial& initial, double y) noexcept {
  if (const auto* box = std::get_if<Box>(&initial)) {
    if (y > box->low[1] && y < box->high[1]) return {box->low[0], box->high[0]};
  } else if (const auto* c = std::get_if<Cylinder>(&initial)) {
    const double rest = square(c->radius) - square(y - c->axis[1]);
    if (rest > 0) return {c->axis[0] - std::sqrt(rest), c->axis[0] + std::sqrt(rest)};
  }
  return {};
}

/// Ends of tips between which cross-sections are alike, or change evenly.
std::vector<double> levels(const Path& path, Heights within) {
  std::vector<double> out{within.bottom, within.top};
  for (const Piece& piece : path.pieces) {
    for (const double z : {piece.from[2], piece.to[2]}) {
      if (z > within.bottom && z < within.top) out.push_back(z);
    }
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end(),
                        [](double a, double b) { return b - a < 1e-10; }),
            out.end());
  return out;
}

/// Whether the walls of a piece lie along the lines of a scan.
bool is_along_x(const Piece& piece) noexcept {
  return !piece.arc() && piece.from[1] == piece.to[1] && piece.from[0] != piece.to[0];
}

/// Where the stock of the start has walls along x.
std::vector<double> walls_along_x(const Initial& initial) {
  if (const auto* box = std::get_if<Box>(&initial)) return {box->low[1], box->high[1]};
  return {};
}

struct ScanLine {
  double y;       ///< [m]
  double height;  ///< that it stands for [m]
};

/// Lines in the middles of strips between breaks, none of them higher than a step.
/// @param breaks  the first and the last among them
std::vector<ScanLine> scan_lines(std::vector<double> breaks, const Initial& initial,
                                 double step) {
  constexpr double same = 1e-9;
  const auto [low, high] = std::ranges::minmax(breaks);
  for (const double y : walls_along_x(initial)) {
    if (y > low && y < high) breaks.push_back(y);
  }
  std::ranges::sort(breaks);
  std::vector<ScanLine> out;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double strip = breaks[i + 1] - breaks[i];
    if (!(strip > same)) continue;
    const auto lines = static_cast<std::size_t>(strip / step) + 1;
    const double h = strip / static_cast<double>(lines);
    for (std::size_t k = 0; k < lines; ++k) {
      out.push_back({breaks[i] + (static_cast<double>(k) + 0.5) * h, h});
    }
  }
  return out;
}

/// Area swept at a height.
double swept_area(const Swept& swept, double z, double step) {
  struct Reach {
    double from, to;
    const Piece* piece;
  };
  std::vector<Reach> reaches;
  for (const Chain& chain : swept.chains()) {
    if (chain.is_hidden()) continue;
    for (std::uint32_t i = chain.first; i <= chain.last; ++i) {
      const Piece& piece = swept.path().pieces[i];
      const double R = swept.radius(piece.tool);
      if (R > 0 && std::min(piece.from[2], piece.to[2]) <= z) {
        const Extent e = extent(piece);
        reaches.push_back({e.low[1] - R, e.high[1] + R, &piece});
      }
    }
  }
  if (reaches.empty()) return 0.0;
  std::ranges::stable_sort(reaches, {}, &Reach::from);  // moves in a row stay in a row
  std::vector<double> breaks{reaches.front().from,
                             std::ranges::max_element(reaches, {}, &Reach::to)->to};
  for (const Reach& r : reaches) {
    if (is_along_x(*r.piece)) breaks.insert(breaks.end(), {r.from, r.to});
  }
  Scan scan(swept, z);
  std::vector<Reach> active;
  std::size_t next = 0;
  double sum = 0.0;
  for (const ScanLine& line : scan_lines(std::move(breaks), swept.initial(), step)) {
    const double y = line.y;
    for (; next < reaches.size() && reaches[next].from < y; ++next) {
      active.push_back(reaches[next]);
    }
    std::erase_if(active, [&](const Reach& r) { return r.to <= y; });
    const geometry::Stretch stock = whole(swept.initial(), y);
    if (!(stock.to > stock.from)) continue;
    for (const Reach& r : active) {
      scan.add(*r.piece, y);
    }
    sum += line.height * scan.swept_length(stock.from, stock.to);
  }
  return sum;
}

}  // namespace

double volume_removed(const Swept& swept, double step) {
  if (swept.map() != nullptr) return swept.map()->removed(swept.initial());
  constexpr std::array<double, 2> nodes = {0.21132486540518708, 0.78867513459481287};
  const std::vector<double> z = levels(swept.path(), heights(swept.initial()));
  const bool sloped = std::ranges::any_of(swept.path().pieces, [](const Piece& p) {
    return !p.upright() && p.from[2] != p.to[2];
  });
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < z.size(); ++i) {
    const double height = z[i + 1] - z[i];
    if (!sloped) {
      sum += height * swept_area(swept, z[i] + 0.5 * height, step);
      continue;
    }
    constexpr int parts = 4;
    for (int k = 0; k < parts; ++k) {
      for (const double node : nodes) {
        sum += height / (2 * parts) *
               swept_area(swept, z[i] + height * (k + node) / parts, step);
      }
    }
  }
  return sum;
}

}  // namespace trochoid::stock
