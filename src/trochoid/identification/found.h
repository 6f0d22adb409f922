#pragma once

#include <cstddef>
#include <vector>

namespace trochoid::identification {

/// What an unknown of a fit is.
enum class FoundKind { coefficient, exponent, offset, eccentricity_x, eccentricity_y };

/// An unknown that has a value and an error.
struct Found {
  FoundKind kind = FoundKind::coefficient;
  /// Coefficient in the order of files, exponent of t, r, a, or tooth; from 0.
  std::size_t at = 0;
  std::size_t group = 0;  ///< of a coefficient
  double value = 0.0;     ///< [SI]
};

/// @brief Unknowns that were found together, phases and constants of channels left out.
struct FoundTogether {
  std::vector<Found> unknowns;
  std::vector<double> covariance;  ///< of the intervals [SI], row-major
};

}  // namespace trochoid::identification
