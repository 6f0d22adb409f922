#pragma once

#include <trochoid/force/turn_polynomial.h>

#include <span>

namespace trochoid::force {

/// @brief The three functions at any angles, on as wide vectors as the machine has.
///
/// Fastest where neighbours in phi ascend: a stretch of angles in one segment is one loop.
/// @param[in]  phi  angles of the tip of tooth 1 [rad], shape (n)
/// @param[out] out  row-major, shape (n, 3)
void evaluate(const TurnPolynomial& turn, std::span<const double> phi,
              std::span<double> out) noexcept;

}  // namespace trochoid::force
