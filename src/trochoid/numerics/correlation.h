#pragma once

#include <span>

namespace trochoid::numerics {

/// @brief Circular correlation, on as wide vectors as the machine has.
///
/// out_s = sum over i of a_i b_((i + s) mod n), for the first shifts s from 0.
/// @param[in]  a      shape (n)
/// @param[in]  twice  b two times in a row, so that no index need wrap: shape (2 n)
/// @param[out] out    at most n shifts
void correlate(std::span<const double> a, std::span<const double> twice,
               std::span<double> out) noexcept;

}  // namespace trochoid::numerics
