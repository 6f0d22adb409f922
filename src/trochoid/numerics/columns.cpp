#include <trochoid/numerics/columns.h>

#include <algorithm>
#include <array>

// Highway compiles this file once for each kind of vectors, and picks one when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trochoid/numerics/columns.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trochoid::numerics {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Tag>;

constexpr Tag tag;
/// Rows of which all columns stay in the nearest cache.
constexpr std::size_t stretch = 256;

/// Sums over rows of two columns times two: each number read serves twice.
HWY_INLINE void two_by_two(std::array<const double*, 2> a,
                           std::array<const double*, 2> b, std::size_t rows,
                           double* sums) noexcept {
  const std::size_t lanes = hn::Lanes(tag);
  Vector s00 = hn::Zero(tag);
  Vector s01 = s00;
  Vector s10 = s00;
  Vector s11 = s00;
  std::size_t i = 0;
  for (; i + lanes <= rows; i += lanes) {
    const Vector a0 = hn::LoadU(tag, a[0] + i);
    const Vector a1 = hn::LoadU(tag, a[1] + i);
    const Vector b0 = hn::LoadU(tag, b[0] + i);
    const Vector b1 = hn::LoadU(tag, b[1] + i);
    s00 = hn::MulAdd(a0, b0, s00);
    s01 = hn::MulAdd(a0, b1, s01);
    s10 = hn::MulAdd(a1, b0, s10);
    s11 = hn::MulAdd(a1, b1, s11);
  }
  sums[0] = hn::GetLane(hn::SumOfLanes(tag, s00));
  sums[1] = hn::GetLane(hn::SumOfLanes(tag, s01));
  sums[2] = hn::GetLane(hn::SumOfLanes(tag, s10));
  sums[3] = hn::GetLane(hn::SumOfLanes(tag, s11));
  for (; i < rows; ++i) {
    sums[0] += a[0][i] * b[0][i];
    sums[1] += a[0][i] * b[1][i];
    sums[2] += a[1][i] * b[0][i];
    sums[3] += a[1][i] * b[1][i];
  }
}

HWY_INLINE double one_by_one(const double* a, const double* b,
                             std::size_t rows) noexcept {
  const std::size_t lanes = hn::Lanes(tag);
  Vector s = hn::Zero(tag);
  std::size_t i = 0;
  for (; i + lanes <= rows; i += lanes) {
    s = hn::MulAdd(hn::LoadU(tag, a + i), hn::LoadU(tag, b + i), s);
  }
  double sum = hn::GetLane(hn::SumOfLanes(tag, s));
  for (; i < rows; ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

/// Add the products over some rows; of the same columns, those on and above the diagonal.
void add_products(const Columns& A, const Columns& B, std::size_t from,
                  std::size_t rows, std::span<double> out) noexcept {
  const bool same = A.values.data() == B.values.data() && A.count() == B.count();
  const std::size_t n = A.count();
  const std::size_t k = B.count();
  for (std::size_t i = 0; i < n; i += 2) {
    for (std::size_t j = same ? i : 0; j < k; j += 2) {
      const double* const a = &A.values[i * A.stride + from];
      const double* const b = &B.values[j * B.stride + from];
      if (i + 2 <= n && j + 2 <= k) {
        double sums[4];
        two_by_two({a, a + A.stride}, {b, b + B.stride}, rows, sums);
        out[i * k + j] += sums[0];
        out[i * k + j + 1] += sums[1];
        out[(i + 1) * k + j] += sums[2];
        out[(i + 1) * k + j + 1] += sums[3];
        continue;
      }
      for (std::size_t p = i; p < std::min(i + 2, n); ++p) {
        for (std::size_t q = j; q < std::min(j + 2, k); ++q) {
          out[p * k + q] += one_by_one(&A.values[p * A.stride + from],
                                       &B.values[q * B.stride + from], rows);
        }
      }
    }
  }
  if (!same || from + rows < A.rows) return;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) out[i * k + j] = out[j * k + i];
  }
}

// Highway's table takes no noexcept functions.
void all_products(const Columns& A, const Columns& B, std::span<double> out) {
  std::fill(out.begin(), out.end(), 0.0);
  for (std::size_t from = 0; from < A.rows; from += stretch) {
    add_products(A, B, from, std::min(stretch, A.rows - from), out);
  }
}

/// out += three columns at once.
HWY_INLINE void add_three(const double* a, std::size_t stride, const double* x,
                          double factor, std::span<double> out) noexcept {
  const std::size_t lanes = hn::Lanes(tag);
  const Vector x0 = hn::Set(tag, factor * x[0]);
  const Vector x1 = hn::Set(tag, factor * x[1]);
  const Vector x2 = hn::Set(tag, factor * x[2]);
  std::size_t i = 0;
  for (; i + lanes <= out.size(); i += lanes) {
    Vector sum = hn::LoadU(tag, &out[i]);
    sum = hn::MulAdd(x0, hn::LoadU(tag, a + i), sum);
    sum = hn::MulAdd(x1, hn::LoadU(tag, a + stride + i), sum);
    sum = hn::MulAdd(x2, hn::LoadU(tag, a + 2 * stride + i), sum);
    hn::StoreU(sum, tag, &out[i]);
  }
  for (; i < out.size(); ++i) {
    out[i] += factor * (x[0] * a[i] + x[1] * a[stride + i] + x[2] * a[2 * stride + i]);
  }
}

void combine(const Columns& A, std::span<const double> x, double factor,
             std::span<double> out) {
  std::size_t c = 0;
  for (; c + 3 <= A.count(); c += 3) {
    add_three(A[c].data(), A.stride, &x[c], factor, out);
  }
  for (; c < A.count(); ++c) {
    const double f = factor * x[c];
    const double* const a = A[c].data();
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += f * a[i];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace trochoid::numerics
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trochoid::numerics {

HWY_EXPORT(all_products);
HWY_EXPORT(combine);

void inner_products(const Columns& A, const Columns& B,
                    std::span<double> out) noexcept {
  HWY_DYNAMIC_DISPATCH(all_products)(A, B, out);
}

void add_combination(const Columns& A, std::span<const double> x, double factor,
                     std::span<double> out) noexcept {
  HWY_DYNAMIC_DISPATCH(combine)(A, x, factor, out);
}

std::vector<double> by_rows(std::span<const double> columns, std::size_t rows) {
  const std::size_t count = rows == 0 ? 0 : columns.size() / rows;
  std::vector<double> out(columns.size());
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t k = 0; k < count; ++k) out[i * count + k] = columns[k * rows + i];
  }
  return out;
}

std::vector<double> gram_of(const Columns& A) {
  std::vector<double> out(A.count() * A.count());
  inner_products(A, A, out);
  return out;
}

}  // namespace trochoid::numerics
#endif
