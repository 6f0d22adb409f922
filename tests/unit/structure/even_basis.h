#pragma once

#include <cstddef>

namespace trochoid::structure {

/// @brief The textbook Ritz plate with shapes that are even about the middle.
///
/// X_m = 1 - cos(2 m pi x / a), Y_n = 1 - cos((2 n - 1) pi y / 2 b), m, n = 1..terms,
/// flexural rigidity 1.
/// @return deflection at (x, b) under 1 N there
double even_basis_deflection(double length, double height, double nu, std::size_t terms,
                             double x);

}  // namespace trochoid::structure
