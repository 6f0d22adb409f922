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
  std::array<bool, 3> measured = {true, true, true};  ///< as of the run
  double squares = 0.0;  ///< weighted sum of F^2, centered if so [N^2]

  [[nodiscard]] std::size_t size() const noexcept { return weight.size(); }
};

Cells cells_of(const FoldedRun& run);

/// @brief The force matrix in the middle of each cell, limited to the band of the force.
/// @param phase  added to the angles [rad]
/// @return row-major, shape (cells, 3, columns)
std::vector<double> matrix_in_cells(const force::ForceMatrix& matrix,
                                    const Cells& cells, double phase);

}  // namespace trochoid::identification
