#pragma once

#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/bodies.h>
#include <trochoid/surface/edge_moments.h>

#include <array>
#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief Moments of the force over the spindle angle for unit coefficients.
///
/// As long as the deflection does not change the chip, everything follows from these by
/// sums: shape (columns, values of EdgeMoments).
/// @param tolerance  relative to the largest value of each coefficient
numerics::PeriodicPieces unit_moments(const EdgeMoments& edges, double tolerance);

/// @brief Moments, F_x and F_y over the spindle angle with given coefficients.
/// @param unit  of unit_moments
numerics::PeriodicPieces with_coefficients(const numerics::PeriodicPieces& unit,
                                           std::span<const double, columns> K);

/// @brief Error that the deflection leaves at one height, over the spindle angle.
/// @eq E-4 delta(phi, h) = sigma u(phi, h), u = sum_q G_q(h) m_q(phi)
/// @src [wang2015] eq. 8, 9
/// @param moments  one or several times (basis points + 2) functions
/// @param row      G_q [m/N], shape (basis points)
/// @return one function for each set of moments [m]
numerics::PeriodicPieces deflection(const numerics::PeriodicPieces& moments,
                                    std::span<const double> row, double sigma);

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
