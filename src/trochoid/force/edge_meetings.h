#pragma once

#include <trochoid/force/edge_curve.h>

#include <vector>

namespace trochoid::force {

/// @brief Where along the edges two teeth stand on one ray from the axis of rotation.
///
/// Near the axis an eccentricity turns the teeth so far that one passes the other. There
/// the mark of the one before, as the exact chip model takes it, turns from new to a
/// turn old, whatever the spindle angle: chips jump.
///
/// @return arc lengths [m] for each tooth, shape (teeth); empty lists where chips do not
///         know of it
std::vector<std::vector<double>> meetings(const Edges& edges);

}  // namespace trochoid::force
