#pragma once

#include <trochoid/structure/frequency_response.h>
#include <trochoid/structure/mode.h>
#include <trochoid/structure/modes_fit.h>

#include <span>
#include <vector>

namespace trochoid::structure {

/// A mode that moves along a direction in the plane of x and y.
struct PlaneMode {
  Mode mode;
  double x = 1.0;  ///< unit direction
  double y = 0.0;
};

/// @brief The directions of modes that were found along x and along y.
///
/// Two modes of nearly one frequency, one found along each axis, are one mode that lies
/// askew, or two that do not know of each other: the cross response tells.
///
/// @eq  D-25 H_xy(omega) = sum over r of a_r / (omega_r^2 - omega^2 + 2 i zeta_r omega_r
///           omega) + U; of a pair ((1/m_x, a), (a, 1/m_y)) = sum of u u^T / m
/// @src derived from M-6: real modes, of unit direction u
/// @param x, y   by frequency, as fitted to the direct responses
/// @param cross  motion along the one axis over force along the other
/// @return by frequency; a second direction of a pair counts where 1/m is above a
///         twentieth of the first
std::vector<PlaneMode> coupled_modes(std::span<const FittedMode> x,
                                     std::span<const FittedMode> y,
                                     const FrequencyResponse& cross);

}  // namespace trochoid::structure
