#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// Small dense matrices many times over, on as wide vectors as the machine has.
namespace trochoid::numerics {

/// Columns are padded with zeros to a multiple of this.
inline constexpr std::size_t padding = 8;

/// @brief Room that a column of n numbers takes.
constexpr std::size_t padded(std::size_t n) noexcept {
  return (n + padding - 1) / padding * padding;
}

/// @brief A dense matrix whose columns are padded: its kernels need no remainders.
struct PaddedMatrix {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> values;  ///< column-major, shape (padded(rows), columns)

  [[nodiscard]] double* column(std::size_t j) noexcept {
    return values.data() + j * padded(rows);
  }
  [[nodiscard]] const double* column(std::size_t j) const noexcept {
    return values.data() + j * padded(rows);
  }
  /// Columns from one on.
  [[nodiscard]] std::span<const double> from(std::size_t j) const noexcept {
    return std::span(values).subspan(j * padded(rows));
  }
};

inline PaddedMatrix padded_zeros(std::size_t rows, std::size_t columns) {
  return {rows, columns, std::vector<double>(padded(rows) * columns)};
}

/// @brief y = A x.
/// @param[in]  A  padded columns, shape (y.size(), x.size())
/// @param[out] y  shape (padded rows), not part of x
void padded_product(std::span<const double> A, std::span<const double> x,
                    std::span<double> y) noexcept;

/// @brief y -= A x.
/// @param[in]     A  padded columns, shape (y.size(), x.size())
/// @param[in,out] y  shape (padded rows), not part of x
void subtract_padded_product(std::span<const double> A, std::span<const double> x,
                             std::span<double> y) noexcept;

/// @brief y = A^T x.
/// @param[in]  A  padded columns, shape (x.size(), y.size())
/// @param[in]  x  shape (padded rows), zeros at the end
/// @param[out] y  not part of x
void padded_transposed_product(std::span<const double> A, std::span<const double> x,
                               std::span<double> y) noexcept;

/// @brief [A B] becomes [. A^-1 B], by Gauss-Jordan elimination with row exchanges.
///
/// Many right sides cost no more a column than the matrix itself, and nothing is solved
/// afterwards: for what is applied more often than it has columns.
/// @param[in,out] M  A square, shape (n, n), and B: padded columns of n = M.rows rows.
///                   The columns of A hold nothing of use then; of a singular A
///                   neither do those of B: not finite.
/// @param         room  for two numbers a column
void eliminate(PaddedMatrix& M, std::span<double> room) noexcept;

}  // namespace trochoid::numerics
