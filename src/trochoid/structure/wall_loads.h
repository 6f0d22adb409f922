#pragma once

#include <trochoid/structure/plate.h>

#include <string_view>
#include <vector>

namespace trochoid::structure {

/// Loads of handbooks, which no cut makes.
enum class WallLoad {
  pressure,   ///< even, over the whole wall
  edge_load,  ///< even, along the whole free edge
  line_load,  ///< even and upright, at one place from the free edge down
};

/// As files spell it.
constexpr std::string_view name_of(WallLoad load) noexcept {
  switch (load) {
    case WallLoad::pressure:
      return "pressure";
    case WallLoad::edge_load:
      return "edge_load";
    case WallLoad::line_load:
      return "line_load";
  }
  return {};
}

/// How a wall is loaded by itself, and where its deflection is wanted.
struct WallLoads {
  double pressure = 0.0;   ///< [N/m^2]
  double edge_load = 0.0;  ///< [N/m]
  double line_load = 0.0;  ///< [N/m]
  double position = 0.0;   ///< of the line along the wall [m]
  double depth = 0.0;      ///< of the line below the free edge [m]
  std::vector<double> x;   ///< along the wall [m]; empty: 21 of them, and the position
  std::vector<double> y;   ///< above the foot [m]; empty: 11 of them
};

/// The wall under one load.
struct LoadedWall {
  WallLoad load = WallLoad::pressure;
  double size = 0.0;         ///< [N/m^2] or [N/m]
  std::vector<double> w;     ///< with the load, row-major, shape (x, y) [m]
  double largest = 0.0;      ///< of them by size [m]
  double x = 0.0;            ///< where that is [m]
  double y = 0.0;            ///< [m]
  double coefficient = 0.0;  ///< of handbooks, without unit
};

struct LoadedWalls {
  std::vector<double> x;  ///< along the wall [m]
  std::vector<double> y;  ///< above the foot [m]
  std::vector<LoadedWall> walls;
};

/// @brief Deflections of a wall under the loads that are not 0, one after the other.
///
/// @eq  B-11  w D/(p a^4) for a pressure p, w D/(q b^3) for a load q along the free edge,
///            w D/(F b^2) for the whole force F of a line, at the largest w
/// @throws std::invalid_argument when the plate or a point is out of its range
LoadedWalls loaded_walls(const Plate& plate, const WallLoads& loads);

}  // namespace trochoid::structure
