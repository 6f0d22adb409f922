#include <trochoid/numerics/padded.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

// Highway compiles this file once for each kind of vectors, and picks one when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trochoid/numerics/padded.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trochoid::numerics {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, padding>;
using Vector = hn::Vec<Tag>;

constexpr Tag tag;

/// A matrix of padded columns.
struct Columns {
  const double* values = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
};

/// A x for the rows of so many vectors, in two chains each: one would wait for itself.
template <std::size_t vectors>
HWY_INLINE void rows_of_product(const Columns& A, const double* x, Vector (&sum)[4]) {
  const std::size_t lanes = hn::Lanes(tag);
  Vector other[4];
  for (std::size_t v = 0; v < vectors; ++v) {
    sum[v] = hn::Zero(tag);
    other[v] = hn::Zero(tag);
  }
  const double* column = A.values;
  std::size_t j = 0;
  for (; j + 2 <= A.count; j += 2, column += 2 * A.stride) {
    const Vector x_0 = hn::Set(tag, x[j]);
    const Vector x_1 = hn::Set(tag, x[j + 1]);
    for (std::size_t v = 0; v < vectors; ++v) {
      sum[v] = hn::MulAdd(hn::LoadU(tag, column + v * lanes), x_0, sum[v]);
      other[v] =
          hn::MulAdd(hn::LoadU(tag, column + A.stride + v * lanes), x_1, other[v]);
    }
  }
  if (j < A.count) {
    const Vector x_0 = hn::Set(tag, x[j]);
    for (std::size_t v = 0; v < vectors; ++v) {
      sum[v] = hn::MulAdd(hn::LoadU(tag, column + v * lanes), x_0, sum[v]);
    }
  }
  for (std::size_t v = 0; v < vectors; ++v) {
    sum[v] = hn::Add(sum[v], other[v]);
  }
}

template <std::size_t vectors, bool subtract>
HWY_INLINE void block(const Columns& A, const double* x, double* y) {
  const std::size_t lanes = hn::Lanes(tag);
  Vector sum[4];
  rows_of_product<vectors>(A, x, sum);
  for (std::size_t v = 0; v < vectors; ++v) {
    double* const at = y + v * lanes;
    hn::StoreU(subtract ? hn::Sub(hn::LoadU(tag, at), sum[v]) : sum[v], tag, at);
  }
}

template <bool subtract>
HWY_INLINE void all_blocks(Columns A, const double* x, double* y) {
  const std::size_t lanes = hn::Lanes(tag);
  std::size_t left = A.stride / lanes;
  for (; left >= 4; left -= 4) {
    block<4, subtract>(A, x, y);
    A.values += 4 * lanes;
    y += 4 * lanes;
  }
  if (left == 3) block<3, subtract>(A, x, y);
  if (left == 2) block<2, subtract>(A, x, y);
  if (left == 1) block<1, subtract>(A, x, y);
}

// Highway's table takes no noexcept functions.
void product_of(const double* A, std::size_t stride, std::span<const double> x,
                double* y) {
  all_blocks<false>({A, stride, x.size()}, x.data(), y);
}

void subtract_product_of(const double* A, std::size_t stride, std::span<const double> x,
                         double* y) {
  all_blocks<true>({A, stride, x.size()}, x.data(), y);
}

/// So many columns times x.
template <std::size_t columns>
HWY_INLINE void dots(const double* A, std::size_t stride, const double* x, double* y) {
  const std::size_t lanes = hn::Lanes(tag);
  Vector sum[columns];
  for (Vector& s : sum) s = hn::Zero(tag);
  for (std::size_t i = 0; i < stride; i += lanes) {
    const Vector at = hn::LoadU(tag, x + i);
    for (std::size_t j = 0; j < columns; ++j) {
      sum[j] = hn::MulAdd(hn::LoadU(tag, A + j * stride + i), at, sum[j]);
    }
  }
  for (std::size_t j = 0; j < columns; ++j) {
    y[j] = hn::GetLane(hn::SumOfLanes(tag, sum[j]));
  }
}

void transposed_product_of(const double* A, std::size_t stride, const double* x,
                           std::span<double> y) {
  std::size_t j = 0;
  for (; j + 4 <= y.size(); j += 4) dots<4>(A + j * stride, stride, x, &y[j]);
  for (; j < y.size(); ++j) dots<1>(A + j * stride, stride, x, &y[j]);
}

/// Take two pivots' columns from those behind them, in the rows of so many vectors.
template <std::size_t vectors>
HWY_INLINE void take(const double* pivots, std::size_t stride, const double* shares,
                     std::size_t columns, double* first) {
  const std::size_t lanes = hn::Lanes(tag);
  Vector pivot[vectors];
  Vector other[vectors];
  for (std::size_t v = 0; v < vectors; ++v) {
    pivot[v] = hn::LoadU(tag, pivots + v * lanes);
    other[v] = hn::LoadU(tag, pivots + stride + v * lanes);
  }
  for (std::size_t j = 0; j < columns; ++j, first += stride) {
    const Vector share = hn::Set(tag, shares[2 * j]);
    const Vector other_share = hn::Set(tag, shares[2 * j + 1]);
    for (std::size_t v = 0; v < vectors; ++v) {
      double* const at = first + v * lanes;
      const Vector left = hn::NegMulAdd(pivot[v], share, hn::LoadU(tag, at));
      hn::StoreU(hn::NegMulAdd(other[v], other_share, left), tag, at);
    }
  }
}

/// The row of the pivot of column k: k itself unless it is small beside others.
std::size_t pivot_row(const double* column, std::size_t k, std::size_t n) {
  constexpr double small = 0.1;
  double most[4] = {};
  std::size_t i = k + 1;
  for (; i + 4 <= n; i += 4) {
    for (std::size_t c = 0; c < 4; ++c) {
      most[c] = std::max(most[c], std::abs(column[i + c]));
    }
  }
  for (; i < n; ++i) most[0] = std::max(most[0], std::abs(column[i]));
  const double largest = std::max({most[0], most[1], most[2], most[3]});
  if (!(std::abs(column[k]) < small * largest)) return k;
  for (i = k + 1; std::abs(column[i]) < largest; ++i) continue;
  return i;
}

/// Exchange two rows in columns.
void exchange(std::size_t a, std::size_t b, double* first, std::size_t stride,
              std::size_t columns) {
  for (std::size_t j = 0; a != b && j < columns; ++j, first += stride) {
    std::swap(first[a], first[b]);
  }
}

/// Columns k and k + 1 from all behind them: two at once, as each passes over memory.
/// @param shares  room for two numbers a column
void eliminate_pair(double* pivots, std::size_t k, std::size_t n, std::size_t behind,
                    double* shares) {
  const std::size_t stride = padded(n);
  double* const others = pivots + stride;
  double* const first = others + stride;
  exchange(k, pivot_row(pivots, k, n), pivots, stride, behind + 2);
  const double per_pivot = 1 / pivots[k];
  const double share = others[k] * per_pivot;
  for (std::size_t i = 0; i < n; ++i) others[i] -= share * pivots[i];
  others[k] = share;
  const std::size_t p = pivot_row(others, k + 1, n);
  exchange(k + 1, p, pivots, stride, behind + 2);
  const double per_other = 1 / others[k + 1];
  for (std::size_t j = 0; j < behind; ++j) {
    const double* const column = first + j * stride;
    shares[2 * j] = column[k] * per_pivot;
    shares[2 * j + 1] = (column[k + 1] - pivots[k + 1] * shares[2 * j]) * per_other;
  }
  const std::size_t lanes = hn::Lanes(tag);
  std::size_t i = 0;
  for (; i + 4 * lanes <= stride; i += 4 * lanes) {
    take<4>(pivots + i, stride, shares, behind, first + i);
  }
  for (; i < stride; i += lanes) {
    take<1>(pivots + i, stride, shares, behind, first + i);
  }
  for (std::size_t j = 0; j < behind; ++j) {
    first[j * stride + k] = shares[2 * j] - others[k] * shares[2 * j + 1];
    first[j * stride + k + 1] = shares[2 * j + 1];
  }
}

/// @param shares  room for two numbers a column
void eliminate_in(double* A, std::size_t n, std::size_t columns, double* shares) {
  const std::size_t stride = padded(n);
  std::size_t k = 0;
  for (; k + 2 <= n; k += 2) {
    eliminate_pair(A + k * stride, k, n, columns - k - 2, shares);
  }
  if (k == n) {
    return;
  }
  const double* const pivots = A + k * stride;  // the last: its row is its own
  for (std::size_t j = k + 1; j < columns; ++j) {
    double* const column = A + j * stride;
    const double share = column[k] / pivots[k];
    for (std::size_t i = 0; i < n; ++i) column[i] -= share * pivots[i];
    column[k] = share;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace trochoid::numerics
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trochoid::numerics {

HWY_EXPORT(product_of);
HWY_EXPORT(subtract_product_of);
HWY_EXPORT(transposed_product_of);
HWY_EXPORT(eliminate_in);

void padded_product(std::span<const double> A, std::span<const double> x,
                    std::span<double> y) noexcept {
  HWY_DYNAMIC_DISPATCH(product_of)(A.data(), y.size(), x, y.data());
}

void subtract_padded_product(std::span<const double> A, std::span<const double> x,
                             std::span<double> y) noexcept {
  HWY_DYNAMIC_DISPATCH(subtract_product_of)(A.data(), y.size(), x, y.data());
}

void padded_transposed_product(std::span<const double> A, std::span<const double> x,
                               std::span<double> y) noexcept {
  HWY_DYNAMIC_DISPATCH(transposed_product_of)(A.data(), x.size(), x.data(), y);
}

void eliminate(PaddedMatrix& M, std::span<double> room) noexcept {
  HWY_DYNAMIC_DISPATCH(eliminate_in)(M.values.data(), M.rows, M.columns, room.data());
}

}  // namespace trochoid::numerics
#endif
