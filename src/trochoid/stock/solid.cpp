#include <trochoid/stock/solid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace trochoid::stock {

namespace {

constexpr double most_field_points = 2.5e7;
/// A face so much above the floor hides air below it [m].
constexpr double above_floor = 1e-6;
/// Points so little outside a face are on it, in parts of its size.
constexpr double on_face = 1e-9;

/// Corners of a box around all faces.
Box around(std::span<const Triangle> faces) noexcept {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Box box{{infinite, infinite, infinite}, {-infinite, -infinite, -infinite}};
  for (const Triangle& face : faces) {
    for (const Point& p : face) {
      for (std::size_t i = 0; i < 3; ++i) {
        box.low[i] = std::min(box.low[i], p[i]);
        box.high[i] = std::max(box.high[i], p[i]);
      }
    }
  }
  return box;
}

/// A face over the plane: its height at a place, if it is over it.
class Over {
 public:
  explicit Over(const Triangle& face) noexcept : face_(face) {
    const auto& [a, b, c] = face;
    area_ = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  /// Upright faces are over nothing.
  [[nodiscard]] bool upright() const noexcept { return area_ == 0; }
  [[nodiscard]] bool looks_down() const noexcept { return area_ < 0; }

  /// Whether it is over a place; its height there.
  [[nodiscard]] bool at(double x, double y, double& z) const noexcept {
    const auto& [a, b, c] = face_;
    const auto share = [&](const Point& p, const Point& q) {
      return ((p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x)) / area_;
    };
    const double u = share(b, c);
    const double v = share(c, a);
    const double w = share(a, b);
    if (u < -on_face || v < -on_face || w < -on_face) return false;
    z = u * a[2] + v * b[2] + w * c[2];
    return true;
  }

 private:
  const Triangle& face_;
  double area_;
};

}  // namespace

std::size_t open_edges(std::span<const Triangle> faces) {
  // An edge is gone along one way by a face and the other way by its neighbour.
  std::vector<std::pair<Point, Point>> edges;
  edges.reserve(3 * faces.size());
  for (const Triangle& face : faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      edges.emplace_back(face[i], face[(i + 1) % 3]);
    }
  }
  std::ranges::sort(edges);
  std::size_t open = 0;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t same = i;
    while (same < edges.size() && edges[same] == edges[i]) ++same;
    const auto back =
        std::ranges::equal_range(edges, std::pair{edges[i].second, edges[i].first});
    const std::size_t here = same - i;
    const auto there = static_cast<std::size_t>(std::ranges::distance(back));
    if (edges[i].first != edges[i].second && here > there) open += here - there;
    i = same;
  }
  return open;
}

FromAbove seen_from_above(std::span<const Triangle> faces, double cell) {
  const Box box = around(faces);
  const double width = box.high[0] - box.low[0];
  const double depth = box.high[1] - box.low[1];
  FromAbove out;
  HeightField& field = out.field;
  field.cell = std::max(cell, std::sqrt(width * depth / most_field_points));
  field.origin = {box.low[0], box.low[1]};
  field.columns = static_cast<int>(std::ceil(width / field.cell - 1e-9)) + 1;
  field.rows = static_cast<int>(std::ceil(depth / field.cell - 1e-9)) + 1;
  field.bottom = box.low[2];
  field.highest = box.high[2];
  field.top.assign(
      static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows),
      static_cast<float>(field.bottom));
  for (const Triangle& face : faces) {
    const Over over(face);
    if (over.upright()) continue;
    const Box local = around(std::span(&face, 1));
    const auto first = [&](std::size_t axis) {
      return std::max(0,
                      static_cast<int>(std::ceil(
                          (local.low[axis] - field.origin[axis]) / field.cell - 1e-6)));
    };
    const auto last = [&](std::size_t axis, int count) {
      const double at = (local.high[axis] - field.origin[axis]) / field.cell;
      return std::min(count - 1, static_cast<int>(std::floor(at + 1e-6)));
    };
    for (int i = first(1); i <= last(1, field.rows); ++i) {
      for (int j = first(0); j <= last(0, field.columns); ++j) {
        double z = 0.0;
        if (!over.at(field.origin[0] + j * field.cell, field.origin[1] + i * field.cell,
                     z)) {
          continue;
        }
        if (over.looks_down()) {
          out.undercut = out.undercut || z > field.bottom + above_floor;
          continue;
        }
        float& top = field.top[static_cast<std::size_t>(i) *
                                   static_cast<std::size_t>(field.columns) +
                               static_cast<std::size_t>(j)];
        top = std::max(top, static_cast<float>(z));
      }
    }
  }
  return out;
}

}  // namespace trochoid::stock
