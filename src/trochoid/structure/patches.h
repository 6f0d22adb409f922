#pragma once

#include <trochoid/structure/plate.h>

#include <span>
#include <vector>

namespace trochoid::structure {

/// Cuts of a plate into patches, so that few polynomials suffice on each.
struct Patches {
  std::vector<double> x;      ///< ascending, from 0 to the length [m]
  std::vector<double> y;      ///< ascending, from 0 to the height [m]
  std::vector<double> loads;  ///< the x that they are made for, none at a clamp [m]
  double depth = 0.0;         ///< from the free edge down: where patches suit loads [m]
};

/// @brief Cut a wall at its loads, and at distances from them that grow geometrically.
///
/// A load on the free edge bends the wall over its reach: the distance to the next
/// clamped side. Patches begin with twice that and each is three times as long as the
/// one before. Where the thickness changes, there is a cut as well.
/// @param x of the loads, in [0, length]; those nearer to a
/// clamped end than a twentieth of the shorter side bend the
/// wall so little that they are taken to be there
/// @param depth  from the free edge down to the lowest load [m]; two reaches at least
Patches patches(const Plate& plate, std::span<const double> x, double depth);

}  // namespace trochoid::structure
