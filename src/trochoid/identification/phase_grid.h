#pragma once

#include <trochoid/identification/problem.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::identification {

/// @brief A run averaged over equal cells of the turn: there a phase is a shift.
struct PhaseGrid {
  std::vector<double> weight;                ///< number of samples
  std::vector<std::array<double, 3>> force;  ///< mean [N], or part within the band
  bool even = false;                         ///< the weights are equal
  int harmonics = 0;      ///< of the band that the force is limited to; 0: no limit
  bool centered = false;  ///< the means of the channels count for nothing
  std::array<bool, 3> measured = {true, true, true};  ///< as of the run
  double squares = 0.0;  ///< weighted sum of F^2, centered if so [N^2]

  [[nodiscard]] std::size_t size() const noexcept { return weight.size(); }
};

PhaseGrid phase_grid_of(const FoldedRun& run);

/// @brief The force matrix in the middle of each cell, limited to the band of the force.
/// @param phase  added to the angles [rad]
/// @return row-major, shape (cells, 3, columns)
std::vector<double> matrix_on_grid(const force::ForceMatrix& matrix,
                                   const PhaseGrid& grid, double phase);

/// @brief Products of force matrix and channels at every shift.
struct Products {
  std::size_t columns = 0;
  std::size_t shifts = 0;
  bool mixed = false;
  std::vector<double> G;  ///< C^T W C, shape (shifts or 1: all alike, columns, columns)
  /// Of axis q of the matrix with channel c, shape (shifts, 3, 3, columns); not mixed:
  /// the sum over c = q, shape (shifts, columns).
  std::vector<double> X;

  [[nodiscard]] std::span<const double> gram_at(std::size_t shift) const noexcept {
    const std::size_t size = columns * columns;
    return std::span(G).subspan(G.size() == size ? 0 : shift * size, size);
  }
  [[nodiscard]] std::span<const double> right_at(std::size_t shift) const noexcept {
    const std::size_t size = mixed ? 9 * columns : columns;
    return std::span(X).subspan(shift * size, size);
  }
};

/// @brief Products at every shift of the matrix against the record.
///
/// @eq I-12 G(s) = sum_i w_i C_(i+s)^T C_(i+s),
///          X_qc(s) = sum_i w_i C_q,(i+s) F_c,i
/// @param C      of matrix_on_grid
/// @param count  of shifts, from 0: all, or the first alone
/// @param mixed  whether each axis may be read by any channel
Products products(const PhaseGrid& grid, std::span<const double> C, std::size_t count,
                  bool mixed);

}  // namespace trochoid::identification
