#pragma once

#include <trochoid/force/turn_polynomial.h>

#include <array>
#include <complex>
#include <vector>

namespace trochoid::force {

/// @brief Mean of the three functions over a turn.
std::array<double, 3> mean(const TurnPolynomial& turn);

/// @brief Harmonic n of the three functions, in closed form but for the panels.
///
/// @eq F-14 c_n = integral of F exp(-i n phi) over a turn / 2 pi, n from 0
/// @src derived; the amplitude of cos and sin together is 2 |c_n| for n > 0
std::array<std::complex<double>, 3> harmonic(const TurnPolynomial& turn, int n);

/// @brief The slopes of the three functions over phi, jumps left out.
TurnPolynomial derivative(const TurnPolynomial& turn);

/// @brief Where one of the three functions jumps [rad], ascending in (0, 2 pi]: a straight
/// edge comes into the cut or leaves it.
/// @param least  jump that counts, in the unit of the functions
std::vector<double> jumps(const TurnPolynomial& turn, double least);

/// A smallest or largest value and where it is.
struct Extreme {
  double phi = 0.0;  ///< [rad]
  double value = 0.0;
};

/// The extremes of one function over a turn.
struct Extremes {
  Extreme min;
  Extreme max;
};

/// @brief Of each of the three functions; at a jump, of either side.
std::array<Extremes, 3> extremes(const TurnPolynomial& turn);

}  // namespace trochoid::force
