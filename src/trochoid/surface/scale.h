#pragma once

#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/edge_moments.h>

#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief Largest absolute value over a turn of each group of values().
/// @return shape (groups)
std::vector<double> largest_values(const EdgeMoments& edges, std::size_t groups,
                                   const numerics::PeriodicPieces::Function& f);

/// @brief Panels over a turn, or over one tooth where all repeat.
/// @param largest  value of each group; errors are relative to it
numerics::PeriodicPieces::Options panels_for(const EdgeMoments& edges, bool repeats,
                                             std::span<const double> largest,
                                             double tolerance);

}  // namespace trochoid::surface
