#pragma once

#include <trochoid/identification/folded.h>
#include <trochoid/identification/turn_matrix.h>

#include <vector>

namespace trochoid::identification {

/// @brief Let the rows of a run in a band be read off the Fourier coefficients of the
/// force; nothing without a band, and where there are so few angles that they are
/// looked at one by one, unless a dynamometer that is not rigid asks for harmonics.
///
/// @eq I-11 X_k = sum over m of t_km (a_m, b_m), t_km = sum_g w_g e_kg (cos, sin)(m phi_g),
///          e_k the orthonormal columns of the band over the weighted angles
void map_turn(FoldedRun& run, std::size_t few_angles);

/// @brief Rows of the problem from the coefficients of [C].
/// @param coefficients  row-major, shape (2 highest + 1, 3 columns), of the recorded
///                      angle
/// @param columns  of [C]
/// @return row-major, shape (rows, columns)
std::vector<double> rows_of_turn(const FoldedRun& run,
                                 std::span<const double> coefficients, int columns);

}  // namespace trochoid::identification
