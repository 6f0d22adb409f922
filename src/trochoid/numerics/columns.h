#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::numerics {

/// @brief A tall matrix by its columns, one after the other, or rows of one.
struct Columns {
  std::span<const double> values;
  std::size_t rows = 0;
  std::size_t stride = 0;  ///< from column to column

  Columns(std::span<const double> all, std::size_t rows_of_all) noexcept
      : Columns(all, rows_of_all, rows_of_all) {}
  Columns(std::span<const double> from_first, std::size_t some_rows,
          std::size_t rows_of_all) noexcept
      : values(from_first), rows(some_rows), stride(rows_of_all) {}

  [[nodiscard]] std::size_t count() const noexcept {
    return rows == 0 || values.size() < rows ? 0 : 1 + (values.size() - rows) / stride;
  }
  [[nodiscard]] std::span<const double> operator[](std::size_t c) const noexcept {
    return values.subspan(c * stride, rows);
  }
  /// The first so many of them, at least one.
  [[nodiscard]] Columns first(std::size_t columns) const noexcept {
    return {values.first((columns - 1) * stride + rows), rows, stride};
  }
};

/// Sum of a_i b_i, in the order of i; b is at least as long as a.
inline double dot(std::span<const double> a, std::span<const double> b) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Euclidean norm.
inline double norm(std::span<const double> v) noexcept {
  return std::sqrt(dot(v, v));
}

/// @brief All products of columns, on as wide vectors as the machine has.
/// @param[out] out  A^T B, row-major, shape (columns of A, columns of B)
void inner_products(const Columns& A, const Columns& B, std::span<double> out) noexcept;

/// @brief out += factor A x.
/// @param[in]     x    shape (columns)
/// @param[in,out] out  shape (rows)
void add_combination(const Columns& A, std::span<const double> x, double factor,
                     std::span<double> out) noexcept;

/// The same matrix row by row.
/// @param columns  one after the other, shape (columns, rows)
std::vector<double> by_rows(std::span<const double> columns, std::size_t rows);

/// A^T A, shape (columns, columns).
std::vector<double> gram_of(const Columns& A);

}  // namespace trochoid::numerics
