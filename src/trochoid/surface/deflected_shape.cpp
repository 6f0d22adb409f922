#include <trochoid/surface/deflected_shape.h>

#include <trochoid/base/units.h>

#include <algorithm>

namespace trochoid::surface {

namespace {

constexpr int steps = 40;  ///< along each body; enough to draw it

void append_even(double from, double to, std::vector<double>& heights) {
  for (int i = 0; i < steps; ++i) {
    heights.push_back(from + (to - from) * i / steps);
  }
  heights.push_back(to);  // not a bit more: the wall ends at the axial depth
}

/// sum_q G(h, z_q) m_q of one body, in the direction of the normal.
std::vector<double> under_moments(std::span<const double> G,
                                  std::span<const double> moments, double sigma) {
  std::vector<double> u(G.size() / moments.size());
  for (std::size_t i = 0; i < G.size(); ++i) {
    u[i / moments.size()] += G[i] * moments[i % moments.size()];  // E-5
  }
  for (double& value : u) {
    value *= sigma;
  }
  return u;
}

std::vector<double> under_force(std::vector<double> G, double F_normal) {
  for (double& value : G) {
    value *= F_normal;  // E-6
  }
  return G;
}

}  // namespace

std::vector<double> shape_heights(const Bodies& bodies, double a_p) {
  std::vector<double> heights;
  append_even(0.0, a_p, heights);
  if (bodies.wall) {
    append_even(a_p - bodies.wall->height, a_p, heights);
  }
  if (bodies.cutter) {
    append_even(0.0, bodies.cutter->overhang, heights);
  }
  std::sort(heights.begin(), heights.end());
  // Equal ones may differ by rounding.
  const auto end = std::unique(heights.begin(), heights.end(), [](double a, double b) {
    return b - a < 1e-9 * unit::mm;
  });
  heights.erase(end, heights.end());
  return heights;
}

DeflectedShape deflected_shape(const Compliance& compliance,
                               std::span<const double> moments, double sigma) {
  DeflectedShape shape{
      .F_normal = sigma * moments.back(),
      .heights = shape_heights(compliance.bodies(), compliance.axial_depth())};
  std::vector<double> on_cutter = shape.heights;
  for (double& h : on_cutter) {
    h = std::max(h, 0.0);
  }
  if (compliance.load() == Load::distributed) {
    const auto points = compliance.basis().points();
    const auto along = moments.first(points.size());
    shape.cutter = under_moments(compliance.of_cutter(on_cutter, points), along, sigma);
    shape.wall = under_moments(compliance.of_wall(shape.heights, points), along, sigma);
  } else {
    shape.cutter =
        under_force(compliance.concentrated_on_cutter(on_cutter), shape.F_normal);
    shape.wall =
        under_force(compliance.concentrated_on_wall(shape.heights), shape.F_normal);
  }
  for (std::size_t i = 0; i < shape.heights.size(); ++i) {
    if (shape.heights[i] < 0) {
      shape.cutter[i] = 0.0;
    }
  }
  return shape;
}

}  // namespace trochoid::surface
