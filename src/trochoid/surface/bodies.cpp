#include <trochoid/surface/bodies.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace trochoid::surface {

namespace {

/// Points over the axial depth: the influence is a cubic with a kink in its third
/// derivative, and the force along an edge is smooth but for its ends.
constexpr int basis_points = 16;

/// Of the wall's deflection: what it adds to the error is far below a reading's noise.
constexpr double plate_tolerance = 2e-4;

}  // namespace

BodiesAt bodies_at(const std::optional<structure::Cantilever>& cutter,
                   const std::optional<structure::Plate>& wall, double a_p,
                   double below) {
  return [cutter, wall, a_p, below](double x) {
    Bodies bodies{.cutter = cutter};
    if (wall) {
      const double top = wall->height - below;
      bodies.wall = Wall{.plate = std::make_shared<structure::PlateSolution>(
                             *wall, x, plate_tolerance, a_p + below),
                         .height = top,
                         .length = wall->length,
                         .thickness = structure::thickness_at(*wall, top - a_p / 2)};
    }
    return bodies;
  };
}

BodiesAt bodies_solved_once(const BodyDimensions& dimensions, double a_p) {
  struct Known {
    std::mutex mutex;
    std::map<double, Bodies> at;
  };
  return [bodies = bodies_at(dimensions.cutter, dimensions.wall, a_p),
          known = std::make_shared<Known>()](double x) {
    {
      const std::lock_guard lock(known->mutex);
      if (const auto found = known->at.find(x); found != known->at.end()) {
        return found->second;
      }
    }
    // Not under the lock: a thread that waits for others may begin another task here.
    Bodies solved = bodies(x);
    const std::lock_guard lock(known->mutex);
    return known->at.emplace(x, std::move(solved)).first->second;
  };
}

Compliance::Compliance(const Bodies& bodies, double a_p, double x, Load load)
    : bodies_(bodies), a_p_(a_p), x_(x), load_(load), basis_(0.0, a_p, basis_points) {}

std::vector<double> Compliance::of_cutter(std::span<const double> heights,
                                          std::span<const double> loads) const {
  std::vector<double> G(heights.size() * loads.size());
  if (bodies_.cutter) {
    for (std::size_t i = 0; i < heights.size(); ++i) {
      for (std::size_t k = 0; k < loads.size(); ++k) {
        G[i * loads.size() + k] =
            structure::compliance(*bodies_.cutter, heights[i], loads[k]);
      }
    }
  }
  return G;
}

std::vector<double> Compliance::on_the_wall(std::span<const double> heights) const {
  const double tip = bodies_.wall->height - a_p_;
  std::vector<double> y;
  for (const double height : heights) {
    y.push_back(std::min(std::min(height, a_p_) + tip, bodies_.wall->height));
  }
  return y;
}

void Compliance::clear_above(std::span<const double> heights,
                             std::span<const double> loads,
                             std::vector<double>& G) const {
  for (std::size_t i = 0; i < G.size(); ++i) {
    if (heights[i / loads.size()] > a_p_ || loads[i % loads.size()] > a_p_) {
      G[i] = 0.0;  // above the free edge there is no wall
    }
  }
}

std::vector<double> Compliance::of_wall(std::span<const double> heights,
                                        std::span<const double> loads) const {
  std::vector<double> G(heights.size() * loads.size());
  if (bodies_.wall) {
    G = bodies_.wall->plate->influence(x_, on_the_wall(heights), x_,
                                       on_the_wall(loads));
    clear_above(heights, loads, G);
  }
  return G;
}

std::vector<double> Compliance::of_cutter_couples(
    std::span<const double> heights) const {
  const std::vector<double>& points = basis_.points();
  std::vector<double> G(heights.size() * points.size());
  for (std::size_t i = 0; bodies_.cutter && i < G.size(); ++i) {
    G[i] = structure::couple_compliance(*bodies_.cutter, heights[i / points.size()],
                                        points[i % points.size()]);
  }
  return G;
}

std::vector<double> Compliance::of_wall_couples(std::span<const double> heights,
                                                structure::Along along) const {
  const std::vector<double>& points = basis_.points();
  std::vector<double> G(heights.size() * points.size());
  if (bodies_.wall) {
    const std::vector<double> seen = on_the_wall(heights);
    const std::vector<double> loaded = on_the_wall(points);
    G = bodies_.wall->plate->couple({x_, seen}, {x_, loaded}, along);
    clear_above(heights, points, G);
  }
  return G;
}

std::vector<double> Compliance::concentrated_on_cutter(
    std::span<const double> heights) const {
  const std::array<double, 1> middle = {a_p_ / 2};
  return of_cutter(heights, middle);
}

std::vector<double> Compliance::concentrated_on_wall(
    std::span<const double> heights) const {
  if (!bodies_.wall) {
    return std::vector<double>(heights.size());
  }
  const double top = bodies_.wall->height;
  std::vector<double> observed(heights.begin(), heights.end());
  for (double& y : observed) {
    y = std::clamp(y + top - a_p_, 0.0, top);  // the foot is 0 but for rounding
  }
  std::vector<double> c =
      bodies_.wall->plate->line_load(x_, observed, x_, top - a_p_, top);
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (heights[i] > a_p_) {
      c[i] = 0.0;  // above the free edge there is no wall
    }
  }
  return c;
}

std::vector<double> Compliance::concentrated(std::span<const double> heights) const {
  std::vector<double> c = concentrated_on_cutter(heights);
  const std::vector<double> wall = concentrated_on_wall(heights);
  for (std::size_t i = 0; i < c.size(); ++i) {
    c[i] += wall[i];
  }
  return c;
}

std::vector<double> Compliance::rows(std::span<const double> heights) const {
  const std::size_t points = basis_.size();
  std::vector<double> G(heights.size() * points);
  if (load_ == Load::distributed) {
    G = of_cutter(heights, basis_.points());
    const std::vector<double> wall = of_wall(heights, basis_.points());
    for (std::size_t i = 0; i < G.size(); ++i) {
      G[i] += wall[i];  // E-5
    }
    return G;
  }
  const std::vector<double> c = concentrated(heights);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    for (std::size_t q = 0; q < points; ++q) {
      G[i * points + q] = c[i];  // E-6, the moments add up to F_y
    }
  }
  return G;
}

}  // namespace trochoid::surface
