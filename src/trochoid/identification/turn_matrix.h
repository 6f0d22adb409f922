#pragma once

#include <trochoid/force/forces.h>

#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::identification {

/// @brief The force matrix of one runout over a whole turn, as Fourier coefficients:
/// once known, every phase is a rotation.
struct TurnMatrix {
  int highest = 0;        ///< harmonic of the spindle
  std::size_t width = 0;  ///< entries of [C]: 3 x columns
  /// a_0, a_1, b_1, a_2, ...: row-major, shape (2 highest + 1, width)
  std::vector<double> coefficients;
};

/// How finely a turn is looked at.
struct TurnGrid {
  int angles = 256;  ///< equal steps, a power of two
  int highest = 63;  ///< harmonic kept, below angles/2
  /// Whether edges enter within less than two steps: the steps in which the matrix
  /// jumps are then halved until the jump is found.
  bool sudden = false;
};

/// @brief Fourier coefficients of [C] over the turn.
TurnMatrix turn_matrix(const force::ForceMatrix& matrix, const TurnGrid& grid);

/// @brief The coefficients of [C] times those of a law: of the force, with a width of 3.
/// @param K  shape (columns of [C])
TurnMatrix times(const TurnMatrix& turn, std::span<const double> K);

/// @brief The same of a matrix, without the coefficients of [C] on the way.
TurnMatrix turn_of_force(const force::ForceMatrix& matrix, const TurnGrid& grid,
                         std::span<const double> K);

/// @brief Angles of a turn at which the matrix jumps, found in so many equal steps [rad].
std::vector<double> jump_angles(const force::ForceMatrix& matrix, int angles);

/// @brief The coefficients of [C](phi + phase) as functions of phi.
///
/// @eq I-10 a_m(phase) = a_m cos(m phase) + b_m sin(m phase),
///          b_m(phase) = b_m cos(m phase) - a_m sin(m phase)
/// @return shape of `coefficients`
std::vector<double> at_phase(const TurnMatrix& turn, double phase);

/// @brief Their derivatives by the phase [1/rad].
/// @eq I-10 da_m/dphase = m b_m(phase), db_m/dphase = -m a_m(phase)
std::vector<double> slope_at_phase(const TurnMatrix& turn, double phase);

}  // namespace trochoid::identification
