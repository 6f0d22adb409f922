#include <trochoid/stock/height_map.h>

#include <trochoid/base/overloaded.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace trochoid::stock {

namespace {

/// Points of the raster at most.
constexpr double most_points = 4e7;
/// An arc is gone in chords this far from it, in parts of a cell.
constexpr double sagitta_in_cells = 0.02;

/// Corners of what is seen from above [m].
struct Outline {
  std::array<double, 2> low;
  std::array<double, 2> high;
};

Outline outline(const Initial& initial) noexcept {
  return std::visit(
      base::Overloaded{
          [](const Box& box) {
            return Outline{{box.low[0], box.low[1]}, {box.high[0], box.high[1]}};
          },
          [](const Cylinder& c) {
            return Outline{{c.axis[0] - c.radius, c.axis[1] - c.radius},
                           {c.axis[0] + c.radius, c.axis[1] + c.radius}};
          },
          [](const HeightField& f) {
            return Outline{{f.origin[0], f.origin[1]},
                           {f.origin[0] + f.cell * (f.columns - 1),
                            f.origin[1] + f.cell * (f.rows - 1)}};
          }},
      initial);
}

/// Top of the stock at the start over a place, its bottom where there is none [m].
double top_of(const Initial& initial, double x, double y) noexcept {
  const Heights all = heights(initial);
  if (const auto* field = std::get_if<HeightField>(&initial)) {
    return top_at(*field, x, y);
  }
  return contains(initial, x, y, 0.5 * (all.bottom + all.top)) ? all.top : all.bottom;
}

/// A straight piece below and around a place.
class Passing {
 public:
  Passing(const Piece& piece, const Wall& wall, double x, double y) noexcept
      : wall_(wall),
        x_(piece.from[0] - x),
        y_(piece.from[1] - y),
        z_(piece.from[2]),
        dx_(piece.to[0] - piece.from[0]),
        dy_(piece.to[1] - piece.from[1]),
        dz_(piece.to[2] - piece.from[2]) {}

  [[nodiscard]] double height(double u) const noexcept {
    return z_ + u * dz_ + wall_.height_at(distance(u));
  }
  /// Where the axis is nearest.
  [[nodiscard]] double nearest() const noexcept {
    const double l2 = dx_ * dx_ + dy_ * dy_;
    return l2 > 0 ? std::clamp(-(x_ * dx_ + y_ * dy_) / l2, 0.0, 1.0) : 0.0;
  }
  [[nodiscard]] double distance(double u) const noexcept {
    const double x = x_ + u * dx_;
    const double y = y_ + u * dy_;
    return std::sqrt(x * x + y * y);
  }
  [[nodiscard]] double slope() const noexcept { return dz_; }
  [[nodiscard]] bool upright() const noexcept { return dx_ == 0 && dy_ == 0; }
  /// From where to where the tool reaches the place; the first beyond the last: nowhere.
  [[nodiscard]] std::array<double, 2> within() const noexcept {
    const double l2 = dx_ * dx_ + dy_ * dy_;
    const double along = -(x_ * dx_ + y_ * dy_);
    const double aside = x_ * dy_ - y_ * dx_;
    const double R = wall_.largest();
    const double rest = R * R * l2 - aside * aside;
    if (!(rest > 0)) return {1.0, 0.0};
    const double half = std::sqrt(rest);
    return {std::max(0.0, (along - half) / l2), std::min(1.0, (along + half) / l2)};
  }

 private:
  const Wall& wall_;
  double x_, y_, z_, dx_, dy_, dz_;
};

/// The lowest value of a convex function (golden section).
template <class Function>
double lowest(const Function& f, double from, double to) noexcept {
  constexpr double golden = 0.6180339887498949;
  double a = to - golden * (to - from);
  double b = from + golden * (to - from);
  double at_a = f(a);
  double at_b = f(b);
  double best = std::min({f(from), f(to), at_a, at_b});
  for (int i = 0; i < 24; ++i) {
    if (at_a < at_b) {
      to = b;
      b = a;
      at_b = at_a;
      a = to - golden * (to - from);
      at_a = f(a);
    } else {
      from = a;
      a = b;
      at_a = at_b;
      b = from + golden * (to - from);
      at_b = f(b);
    }
    best = std::min({best, at_a, at_b});
  }
  return best;
}

}  // namespace

double height_left(const Piece& piece, const Wall& wall, double x, double y) noexcept {
  const Passing passing(piece, wall, x, y);
  if (passing.upright() || passing.slope() == 0) {
    const double u = passing.nearest();
    const double z = std::min(piece.from[2], piece.to[2]);
    return z + wall.height_at(passing.distance(u));
  }
  const auto [from, to] = passing.within();
  if (!(to >= from)) return std::numeric_limits<double>::infinity();
  if (wall.is_upright()) return std::min(passing.height(from), passing.height(to));
  return lowest([&](double u) { return passing.height(u); }, from, to);  // N-17
}

HeightMap::HeightMap(const Initial& initial, double cell)
    : bottom_(heights(initial).bottom), top_(heights(initial).top) {
  const Outline all = outline(initial);
  const double width = all.high[0] - all.low[0];
  const double depth = all.high[1] - all.low[1];
  const double coarse = std::max(cell, std::sqrt(width * depth / most_points));
  size_ = {static_cast<int>(std::ceil(width / coarse)),
           static_cast<int>(std::ceil(depth / coarse))};
  cell_ = {width / size_[0], depth / size_[1]};
  origin_ = {all.low[0] + 0.5 * cell_[0], all.low[1] + 0.5 * cell_[1]};
  height_.reserve(static_cast<std::size_t>(size_[0]) *
                  static_cast<std::size_t>(size_[1]));
  for (int i = 0; i < size_[1]; ++i) {
    for (int j = 0; j < size_[0]; ++j) {
      const Point p = center(i, j);
      height_.push_back(static_cast<float>(top_of(initial, p[0], p[1])));
    }
  }
  piece_.assign(height_.size(), untouched);
}

HeightMap::Range HeightMap::range(double from, double to,
                                  std::size_t axis) const noexcept {
  const double last = size_[axis] - 1;
  const double a = std::ceil((from - origin_[axis]) / cell_[axis]);
  const double b = std::floor((to - origin_[axis]) / cell_[axis]);
  return {static_cast<int>(std::clamp(a, 0.0, last + 1)),
          static_cast<int>(std::clamp(b, -1.0, last))};
}

void HeightMap::cut(const Piece& piece, std::uint32_t index, const Wall& wall) {
  const double R = wall.largest();
  const double low = std::min(piece.from[2], piece.to[2]);
  if (!(R > 0) || low + wall.lowest() >= top_) return;
  if (piece.arc()) {
    cut_arc(piece, index, wall);
    return;
  }
  const auto [x0, x1] = std::minmax(piece.from[0], piece.to[0]);
  const auto [y0, y1] = std::minmax(piece.from[1], piece.to[1]);
  const Range rows = range(y0 - R, y1 + R, 1);
  const Range columns = range(x0 - R, x1 + R, 0);
  for (int i = rows.first; i <= rows.last; ++i) {
    for (int j = columns.first; j <= columns.last; ++j) {
      const Point p = center(i, j);
      const std::size_t k = at(i, j);
      const auto here = static_cast<double>(height_[k]);
      const Passing passing(piece, wall, p[0], p[1]);
      // No lower than the lowest tip could leave it from the nearest place.
      const double distance = passing.distance(passing.nearest());
      if (distance >= R || low + wall.height_at(distance) >= here) continue;
      const double z = std::max(height_left(piece, wall, p[0], p[1]), bottom_);
      if (z < here) {
        height_[k] = static_cast<float>(z);
        piece_[k] = index;
      }
    }
  }
}

void HeightMap::cut_arc(const Piece& piece, std::uint32_t index, const Wall& wall) {
  const double cosine = std::max(1 - sagitta_in_cells * cell_[0] / piece.radius, 0.0);
  const int n = static_cast<int>(std::abs(piece.turn) / (2 * std::acos(cosine))) + 1;
  Piece chord = piece;
  chord.radius = 0.0;
  for (int k = 1; k <= n; ++k) {
    chord.from = point_at(piece, static_cast<double>(k - 1) / n).place;
    chord.to = point_at(piece, static_cast<double>(k) / n).place;
    cut(chord, index, wall);
  }
}

void HeightMap::add_near(double x, double y, double reach,
                         std::vector<std::uint32_t>& pieces) const {
  const double far = reach + 1.5 * std::max(cell_[0], cell_[1]);
  const auto begin = static_cast<std::ptrdiff_t>(pieces.size());
  std::uint32_t before = untouched;
  const Range rows = range(y - far, y + far, 1);
  for (int i = rows.first; i <= rows.last; ++i) {
    const double dy = center(i, 0)[1] - y;
    const double half = std::sqrt(std::max(far * far - dy * dy, 0.0));
    const Range columns = range(x - half, x + half, 0);
    for (int j = columns.first; j <= columns.last; ++j) {
      const std::uint32_t piece = piece_[at(i, j)];
      if (piece == before || piece == untouched) continue;
      pieces.push_back(piece);
      before = piece;
    }
  }
  std::sort(pieces.begin() + begin, pieces.end());
  pieces.erase(std::unique(pieces.begin() + begin, pieces.end()), pieces.end());
}

double HeightMap::removed(const Initial& initial) const noexcept {
  double sum = 0.0;
  for (int i = 0; i < size_[1]; ++i) {
    for (int j = 0; j < size_[0]; ++j) {
      const Point p = center(i, j);
      const double left = std::max(static_cast<double>(height_[at(i, j)]), bottom_);
      sum += std::max(top_of(initial, p[0], p[1]) - left, 0.0);
    }
  }
  return sum * cell_[0] * cell_[1];
}

}  // namespace trochoid::stock
