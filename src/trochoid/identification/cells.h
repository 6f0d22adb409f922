#pragma once

#include <trochoid/identification/problem.h>

#include <array>
#include <cstddef>
#include <vector>

namespace trochoid::identification {

/// @brief A run averaged over equal cells of the turn: there a phase is a shift.
struct Cells {
  std::vector<double> weight;                ///< number of samples
  std::vector<std::array<double, 3>> force;  ///< mean [N], or part within the band
  bool even = false;                         ///< the weights are equal
  int harmonics = 0;      ///< of the band that the force is limited to; 0: no limit
  bool centered = false;  ///< the means of the channels count for nothing
  double squares = 0.0;   ///< weighted sum of F^2, centered if so [N^2]

  [[nodiscard]] std::size_t size() const noexcept { return weight.size(); }
};

Cells cells_of(const FoldedRun& run);

/// @brief The force matrix in the middle of each cell, limited to the band of the force.
/// @param phase  added to the angles [rad]
/// @return row-major, shape (cells, 3, columns)
std::vector<double> matrix_in_cells(const force::ForceMatrix& matrix,
                                    const Cells& cells, double phase);

/// @brief Products of force matrix and channels at one shift.
struct Products {
  std::vector<double> G;  ///< C^T W C, shape (columns, columns)
  /// Of axis q of the matrix with channel c: at (3 q + c) columns, shape (3, 3,
  /// columns).
  std::vector<double> X;
};

/// @brief Products at every shift of the matrix against the record.
///
/// @eq I-12 G(s) = sum_i w_i C_(i+s)^T C_(i+s),
///          X_qc(s) = sum_i w_i C_q,(i+s) F_c,i
/// @param C      of matrix_in_cells
/// @param count  of shifts, from 0: all, or the first alone
/// @param mixed  whether each axis may be read by any channel
std::vector<Products> products(const Cells& cells, const std::vector<double>& C,
                               std::size_t count, bool mixed);

}  // namespace trochoid::identification
