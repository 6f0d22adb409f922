#pragma once

#include <array>
#include <limits>
#include <variant>
#include <vector>

namespace trochoid::stock {

/// Edges along the axes.
struct Box {
  std::array<double, 3> low{};   ///< [m]
  std::array<double, 3> high{};  ///< [m]
};

/// Upright.
struct Cylinder {
  std::array<double, 2> axis{};  ///< x, y [m]
  double radius = 0.0;           ///< [m]
  double bottom = 0.0;           ///< z [m]
  double top = 0.0;              ///< z [m]
};

/// @brief Heights over a raster, linear between its points; no stock beside it.
struct HeightField {
  std::array<double, 2> origin{};  ///< of the first point [m]
  double cell = 0.0;               ///< from point to point [m]
  int columns = 0;                 ///< points in x
  int rows = 0;                    ///< points in y
  double bottom = 0.0;             ///< z of the floor [m]
  /// z of the top [m], row after row, shape (rows, columns); not above `bottom`: none
  std::vector<float> top;
  double highest = 0.0;  ///< of them [m]
};

/// What is there before the first move.
using Initial = std::variant<Box, Cylinder, HeightField>;

/// Heights between which there is stock anywhere [m].
struct Heights {
  double bottom = 0.0;
  double top = 0.0;
};
Heights heights(const Initial& stock) noexcept;

/// Top of the stock over a place, the floor beside it [m].
double top_at(const HeightField& field, double x, double y) noexcept;

/// Whether a point is in it.
bool contains(const Initial& stock, double x, double y, double z) noexcept;

/// Volume of all of it [m^3].
double volume(const Initial& stock) noexcept;

}  // namespace trochoid::stock
