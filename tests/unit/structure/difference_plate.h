#pragma once

#include <Eigen/SparseCholesky>
#include <cstddef>
#include <vector>

namespace trochoid::structure {

/// @brief A wall by finite differences, for comparison: no shapes, no Ritz basis.
///
/// The energy with curvatures by differences at the nodes and twist in the cells.
/// Flexural rigidity 1. The error falls with the square of the spacing.
class DifferencePlate {
 public:
  /// @param columns, rows  of cells along the length and the height
  DifferencePlate(double length, double height, double nu, std::size_t columns,
                  std::size_t rows);

  /// Deflections for point forces at nodes; both numbered by `node`.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& force) const;

  /// Number of the node in a column 1..columns-1 and a row 1..rows.
  [[nodiscard]] Eigen::Index node(std::size_t column, std::size_t row) const;
  [[nodiscard]] Eigen::Index size() const;

 private:
  std::size_t columns_;
  std::size_t rows_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> llt_;
};

}  // namespace trochoid::structure
