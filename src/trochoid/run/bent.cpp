#include <trochoid/run/bent.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <array>

namespace trochoid::run {

namespace {

constexpr int steps = 40;  ///< along each body; enough to draw it

void append_even(double from, double to, std::vector<double>& heights) {
  for (int i = 0; i <= steps; ++i) {
    heights.push_back(from + (to - from) * i / steps);
  }
}

/// One body under the moments of the force: u(h) = sum_q G(h, z_q) m_q.
std::vector<double> under_moments(std::span<const double> G,
                                  std::span<const double> moments) {
  std::vector<double> u(G.size() / moments.size());
  for (std::size_t i = 0; i < G.size(); ++i) {
    u[i / moments.size()] += G[i] * moments[i % moments.size()];  // E-5
  }
  return u;
}

/// The wall under a force spread evenly over the axial depth; 0 above its edge.
std::vector<double> under_line(const surface::Wall& wall, double x, double a_p,
                               std::span<const double> heights) {
  std::vector<double> y;
  for (const double height : heights) {
    y.push_back(std::min(height - a_p, 0.0) + wall.height);
  }
  auto u = wall.plate->line_load(x, y, x, wall.height - a_p, wall.height);
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (heights[i] > a_p) {
      u[i] = 0.0;
    }
  }
  return u;
}

void scale(double factor, std::vector<double>& values) {
  for (double& v : values) {
    v *= factor;
  }
}

}  // namespace

std::vector<double> bent_heights(const inputs::Case& given) {
  std::vector<double> heights;
  const double a_p = given.setup.cut.a_p;
  append_even(0.0, a_p, heights);
  if (given.machine.wall) {
    append_even(a_p - given.machine.wall->height, a_p, heights);
  }
  if (given.machine.cutter_body) {
    append_even(0.0, given.machine.cutter_body->overhang, heights);
  }
  std::sort(heights.begin(), heights.end());
  // Equal ones may differ by rounding.
  const auto end = std::unique(heights.begin(), heights.end(), [](double a, double b) {
    return b - a < 1e-9 * unit::mm;
  });
  heights.erase(end, heights.end());
  return heights;
}

Bent bent(const inputs::Case& given, const surface::Bodies& bodies,
          std::span<const double> moments, double sigma) {
  const double F_y = moments.back();
  const double a_p = given.setup.cut.a_p;
  const double x = given.machine.wall ? given.machine.wall->position : 0.0;
  Bent shape{.F_normal = sigma * F_y, .heights = bent_heights(given)};
  const bool spread = given.machine.surface->load == surface::Load::distributed;
  const surface::Compliance compliance(
      bodies, a_p, x,
      spread ? surface::Load::distributed : surface::Load::concentrated);
  std::vector<double> on_cutter = shape.heights;
  for (double& h : on_cutter) {
    h = std::max(h, 0.0);
  }
  if (spread) {
    const auto points = compliance.basis().points();
    const auto along = moments.first(points.size());
    shape.cutter = under_moments(compliance.of_cutter(on_cutter, points), along);
    shape.wall = under_moments(compliance.of_wall(shape.heights, points), along);
    scale(sigma, shape.cutter);
    scale(sigma, shape.wall);
  } else {
    const std::array<double, 1> middle = {a_p / 2};
    shape.cutter = compliance.of_cutter(on_cutter, middle);  // E-6
    shape.wall.resize(shape.heights.size());
    if (bodies.wall) {
      shape.wall = under_line(*bodies.wall, x, a_p, shape.heights);
    }
    scale(shape.F_normal, shape.cutter);
    scale(shape.F_normal, shape.wall);
  }
  for (std::size_t i = 0; i < shape.heights.size(); ++i) {
    if (shape.heights[i] < 0) {
      shape.cutter[i] = 0.0;
    }
  }
  return shape;
}

base::Table bent_table(const Bent& bent) {
  base::Table table{"bent.csv",
                    {{"height_mm", {}}, {"cutter_mm", {}}, {"wall_mm", {}}}};
  for (std::size_t i = 0; i < bent.heights.size(); ++i) {
    table.columns[0].values.push_back(unit::in(bent.heights[i], unit::mm));
    table.columns[1].values.push_back(bent.cutter[i] / unit::mm);
    table.columns[2].values.push_back(bent.wall[i] / unit::mm);
  }
  return table;
}

}  // namespace trochoid::run
