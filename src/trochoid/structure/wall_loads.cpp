#include <trochoid/structure/wall_loads.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trochoid::structure {

namespace {

constexpr int default_x = 21;  ///< odd, so that the middle is among them
constexpr int default_y = 11;
constexpr double tolerance = 2e-4;
constexpr double nothing = 1e-12;  ///< of the largest: rounding at the clamps

std::vector<double> spread(double length, int count) {
  std::vector<double> out;
  for (int i = 0; i + 1 < count; ++i) {
    out.push_back(length * i / (count - 1));
  }
  out.push_back(length);
  return out;
}

/// Deflections under a load of 1, shape (x, y).
std::vector<double> under(const PlateSolution& solution, const Plate& plate,
                          const WallLoads& loads, const LoadedWalls& at,
                          WallLoad load) {
  std::vector<double> w;
  for (const double x : at.x) {
    if (load == WallLoad::line_load) {
      const std::vector<double> per_N = solution.line_load(
          x, at.y, loads.position, plate.height - loads.depth, plate.height);
      for (const double one : per_N) {
        w.push_back(one * loads.depth);
      }
      continue;
    }
    for (const double y : at.y) {
      w.push_back(load == WallLoad::pressure ? solution.pressure(x, y)
                                             : solution.edge_load(x, y));
    }
  }
  return w;
}

/// The load as lengths make it comparable: w D over this has no unit.
double handbook_scale(const Plate& plate, const WallLoads& loads, WallLoad load) {
  switch (load) {
    case WallLoad::pressure:
      return loads.pressure * std::pow(plate.length, 4);
    case WallLoad::edge_load:
      return loads.edge_load * std::pow(plate.height, 3);
    case WallLoad::line_load:
      break;
  }
  return loads.line_load * loads.depth * plate.height * plate.height;
}

}  // namespace

LoadedWalls loaded_walls(const Plate& plate, const WallLoads& loads) {
  LoadedWalls out{.x = loads.x, .y = loads.y, .walls = {}};
  if (out.x.empty()) {
    out.x = spread(plate.length, default_x);
    if (loads.line_load != 0 &&
        std::ranges::find(out.x, loads.position) == out.x.end()) {
      out.x.insert(std::ranges::upper_bound(out.x, loads.position), loads.position);
    }
  }
  if (out.y.empty()) {
    out.y = spread(plate.height, default_y);
  }
  const PlateSolution solution(plate, loads.position, tolerance, loads.depth);
  const double D = flexural_rigidity(plate);
  const std::array<std::pair<WallLoad, double>, 3> given = {
      {{WallLoad::pressure, loads.pressure},
       {WallLoad::edge_load, loads.edge_load},
       {WallLoad::line_load, loads.line_load}}};
  for (const auto& [load, size] : given) {
    if (size == 0) {
      continue;
    }
    LoadedWall wall{
        .load = load, .size = size, .w = under(solution, plate, loads, out, load)};
    for (std::size_t i = 0; i < wall.w.size(); ++i) {
      wall.w[i] *= size;
      if (std::abs(wall.w[i]) > std::abs(wall.largest)) {
        wall.largest = wall.w[i];
        wall.x = out.x[i / out.y.size()];
        wall.y = out.y[i % out.y.size()];
      }
    }
    for (double& w : wall.w) {
      w = std::abs(w) < nothing * std::abs(wall.largest) ? 0.0 : w;
    }
    wall.coefficient = wall.largest * D / handbook_scale(plate, loads, load);  // B-11
    out.walls.push_back(std::move(wall));
  }
  return out;
}

}  // namespace trochoid::structure
