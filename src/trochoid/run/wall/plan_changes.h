#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/plan_wall.h>
#include <trochoid/surface/plan_wall.h>

#include <vector>

namespace trochoid::run {

/// @brief What a way to measure tells of other cuts, walls and places: one thing another at
/// a time, the heights in proportion to the axial depth.
std::vector<results::ChangedWall> plan_changes(const inputs::Case& given,
                                               const surface::WallTrial& trial,
                                               const surface::WallDesign& design);

}  // namespace trochoid::run
