#pragma once

#include <trochoid/identification/fit.h>
#include <trochoid/identification/folded.h>
#include <trochoid/numerics/columns.h>

#include <array>
#include <span>
#include <vector>

namespace trochoid::identification {

/// @brief What a fit leaves of a run, by harmonics of the spindle.
///
/// One row for each channel and each of 1, cos phi, sin phi, .. sin(K phi), in this order
/// (index_of); scaled so that white noise has its own variance in every row.
struct Spectrum {
  int highest = -1;             ///< K; -1: it cannot be told, for want of whole turns
  double turns = 0.0;           ///< blocks of whole turns that `scatter` is taken from
  std::vector<double> left;     ///< of the mean turn [N], shape (3 (2 K + 1))
  std::vector<double> scatter;  ///< variance by what differs from turn to turn [N^2]

  [[nodiscard]] std::size_t lines() const noexcept {
    return 2 * static_cast<std::size_t>(highest) + 1;
  }
  [[nodiscard]] std::size_t rows() const noexcept {
    return highest < 0 ? 0 : 3 * lines();
  }
};

/// Harmonic of a line: 0, 1, 1, 2, 2, ..
constexpr int harmonic_of(std::size_t line) noexcept {
  return static_cast<int>((line + 1) / 2);
}

/// @brief The spectrum of what a fit leaves, of at most so many harmonics as a turn has
/// samples for, and as the band of the run holds.
/// @eq I-14 r_0 = sum d / sqrt(n), r_k = sqrt(2/n) sum d (cos, sin)(k phi);
///          scatter: 2 n/T times the variance of one turn's mean of d (cos, sin)
/// @param fitted  force at its samples, as Fit::fitted
/// @param band    as FoldedRun::band: rows of the band, 0: no limit
Spectrum spectrum_of(const Run& run, std::span<const std::array<double, 3>> fitted,
                     int band);

/// @brief Columns of the problem in the rows of a spectrum.
/// @param J  rows of this run
/// @return   row-major, shape (rows of the spectrum, columns)
std::vector<double> harmonic_rows(const FoldedRun& folded, const Spectrum& spectrum,
                                  const numerics::Columns& J);

}  // namespace trochoid::identification
