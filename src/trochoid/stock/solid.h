#pragma once

#include <trochoid/stock/initial.h>
#include <trochoid/stock/path.h>

#include <array>
#include <cstddef>
#include <span>

namespace trochoid::stock {

/// A face of a body [m], its corners counter-clockwise seen from outside.
using Triangle = std::array<Point, 3>;

/// How many edges of faces have no other face on their far side: 0 for a closed body.
std::size_t open_edges(std::span<const Triangle> faces);

/// A body as a machine of three axes sees it.
struct FromAbove {
  HeightField field;
  /// Below its top there is air somewhere: it counts as stock.
  bool undercut = false;
};

/// @brief Heights of a closed body, from above.
/// @param cell  from point to point [m]; larger where there would be too many
FromAbove seen_from_above(std::span<const Triangle> faces, double cell);

}  // namespace trochoid::stock
