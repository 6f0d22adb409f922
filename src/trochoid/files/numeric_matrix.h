#pragma once

#include <trochoid/files/numeric_table.h>

#include <optional>
#include <string>
#include <vector>

/// Matrices whose columns have no names.
namespace trochoid::files {

/// A vector, or a part of a matrix: one of its columns or rows.
struct MatrixPart {
  std::size_t rows = 0;     ///< of the whole matrix
  std::size_t columns = 0;  ///< of the whole matrix
  std::optional<std::size_t> column;
  std::optional<std::size_t> row;

  [[nodiscard]] std::size_t count() const;
};

/// A column of a table, and what it is of a matrix.
struct MatrixColumn {
  NumericColumn column;
  MatrixPart part;
};

/// @brief A vector as one column; a matrix as its columns `F(:,1)` ..., or as its rows
/// `F(1,:)` ... where it has more columns than rows.
/// @param like  has the name and path of the matrix, and what else all columns have
/// @return none: a scalar, nothing, or too wide a matrix
std::vector<MatrixColumn> matrix_columns(const NumericColumn& like, std::size_t rows,
                                         std::size_t columns);

/// @brief Take the columns of the only matrix of 3 or 4 columns for Fx, Fy, Fz, or for a
/// time and these, where no column has the name of a force, and say so in a note.
///
/// Does nothing where the case file names columns.
/// @throws base::InputError where several matrices would do
void name_only_matrix(NumericTable& table, const std::string& name,
                      const RecordSource& source);

}  // namespace trochoid::files
