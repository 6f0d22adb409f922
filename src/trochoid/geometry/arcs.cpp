#include <trochoid/geometry/arcs.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::geometry {

namespace {

/// Next to `near`.
double image(double theta, double near) noexcept {
  return near + std::remainder(theta - near, unit::turn);
}

}  // namespace

std::span<const EngagedArc> Arcs::at(double height) const noexcept {
  const auto above = std::ranges::upper_bound(layers, height, {}, &ArcLayer::from);
  if (above == layers.begin()) return {};
  const ArcLayer& layer = *std::prev(above);
  return height <= layer.to ? std::span<const EngagedArc>(layer.arcs)
                            : std::span<const EngagedArc>();
}

Stretch clipped(const StockBoundary& b, double theta, Stretch ray) noexcept {
  if (b.kind == StockBoundary::Kind::none) {
    return ray;
  }
  const double c = std::cos(theta - b.beta);
  if (b.kind == StockBoundary::Kind::line) {
    const double r_b = b.distance / c;  // N-5
    if (c > 0) {
      ray.from = std::max(ray.from, r_b);
    } else if (c < 0) {
      ray.to = std::min(ray.to, r_b);
    } else if (b.distance > 0) {
      ray.to = ray.from;
    }
    return ray;
  }
  const double s = b.distance * std::sin(theta - b.beta);
  const double square = b.radius * b.radius - s * s;
  const bool outside = b.kind == StockBoundary::Kind::outside;
  if (square <= 0) {
    return outside ? ray : Stretch{ray.from, ray.from};
  }
  const double root = std::sqrt(square);
  const double nearer = b.distance * c - root;
  const double farther = b.distance * c + root;
  if (!outside) {
    return {std::max(ray.from, nearer), std::min(ray.to, farther)};
  }
  if (farther < ray.to) {
    return {std::max(ray.from, farther), ray.to};
  }
  return {ray.from, std::min(ray.to, nearer)};
}

double theta_at_radius(const StockBoundary& b, double theta, double r) noexcept {
  const double side = std::remainder(theta - b.beta, unit::turn) < 0 ? -1.0 : 1.0;
  double c = 2.0;
  switch (b.kind) {
    case StockBoundary::Kind::none:
      return theta;
    case StockBoundary::Kind::line:
      c = b.distance / r;
      break;
    case StockBoundary::Kind::outside:
    case StockBoundary::Kind::inside:
      c = (r * r + b.distance * b.distance - b.radius * b.radius) /
          (2 * r * b.distance);
      break;
  }
  if (!(std::abs(c) <= 1)) {
    const double apart = std::abs(std::remainder(theta - b.beta, unit::turn));
    const bool around = b.kind != StockBoundary::Kind::line && b.radius > b.distance;
    // A circle about the axis is closest on the other side: not a boundary on more than
    // half a turn.
    if (around && apart <= std::numbers::pi / 2) return theta;
    return image(b.beta - side * apart, theta);
  }
  return image(b.beta + side * std::acos(c), theta);
}

}  // namespace trochoid::geometry
