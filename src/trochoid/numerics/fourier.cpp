#include <trochoid/numerics/fourier.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

// Highway compiles this file once for each kind of vectors, and picks one when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trochoid/numerics/fourier.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trochoid::numerics {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using FourierTag = hn::CappedTag<double, 4>;

constexpr FourierTag fourier_tag;

/// (a, b) to (a + turn b, a - turn b).
HWY_INLINE void butterfly(double* a, double* b, std::size_t lanes, double c,
                          double s) noexcept {
  const auto cosine = hn::Set(fourier_tag, c);
  const auto sine = hn::Set(fourier_tag, s);
  for (std::size_t i = 0; i < lanes; i += hn::Lanes(fourier_tag)) {
    const auto br = hn::LoadU(fourier_tag, b + i);
    const auto bi = hn::LoadU(fourier_tag, b + lanes + i);
    const auto tr = hn::NegMulAdd(sine, bi, hn::Mul(cosine, br));
    const auto ti = hn::MulAdd(sine, br, hn::Mul(cosine, bi));
    const auto ar = hn::LoadU(fourier_tag, a + i);
    const auto ai = hn::LoadU(fourier_tag, a + lanes + i);
    hn::StoreU(hn::Sub(ar, tr), fourier_tag, b + i);
    hn::StoreU(hn::Sub(ai, ti), fourier_tag, b + lanes + i);
    hn::StoreU(hn::Add(ar, tr), fourier_tag, a + i);
    hn::StoreU(hn::Add(ai, ti), fourier_tag, a + lanes + i);
  }
}

/// The first two rounds, whose turns are quarters.
HWY_INLINE void first_rounds(std::span<double> z, std::size_t lanes) noexcept {
  for (std::size_t from = 0; from < z.size(); from += 8 * lanes) {
    double* const p = &z[from];
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(fourier_tag)) {
      const auto at = [&](std::size_t k) {
        return hn::LoadU(fourier_tag, p + k * lanes + i);
      };
      const auto put = [&](std::size_t k, auto v) {
        hn::StoreU(v, fourier_tag, p + k * lanes + i);
      };
      const auto r01 = hn::Add(at(0), at(2));
      const auto i01 = hn::Add(at(1), at(3));
      const auto r0_1 = hn::Sub(at(0), at(2));
      const auto i0_1 = hn::Sub(at(1), at(3));
      const auto r23 = hn::Add(at(4), at(6));
      const auto i23 = hn::Add(at(5), at(7));
      const auto r2_3 = hn::Sub(at(4), at(6));
      const auto i2_3 = hn::Sub(at(5), at(7));
      put(0, hn::Add(r01, r23));
      put(1, hn::Add(i01, i23));
      put(4, hn::Sub(r01, r23));
      put(5, hn::Sub(i01, i23));
      put(2, hn::Add(r0_1, i2_3));
      put(3, hn::Sub(i0_1, r2_3));
      put(6, hn::Sub(r0_1, i2_3));
      put(7, hn::Add(i0_1, r2_3));
    }
  }
}

/// @brief Sums over n rows of z_k e^(-2 pi i m k/n) for m up to `top` and from n - top on.
/// @param[in,out] z  n >= 4 rows in the order of reversed bits: the real parts of several
///                   functions, then their imaginary parts, each in whole vectors
/// @param roots      cos, sin of -2 pi k/n by turns, k < n/2
// Highway's table takes no noexcept functions.
void transform(std::span<double> z, std::size_t n, std::span<const double> roots,
               std::size_t top) {
  const std::size_t lanes = z.size() / (2 * n);
  first_rounds(z, lanes);
  for (std::size_t half = 4; half < n; half *= 2) {
    const std::size_t stride = n / (2 * half);
    // Of the sums of this round only those are needed that the last ones are made of.
    const std::size_t low = std::min(half, top + 1);
    const std::size_t high = std::max(low, half - std::min(half, top));
    for (std::size_t from = 0; from < n; from += 2 * half) {
      const auto pair = [&](std::size_t k) {
        double* const a = &z[2 * lanes * (from + k)];
        butterfly(a, a + 2 * lanes * half, lanes, roots[2 * k * stride],
                  roots[2 * k * stride + 1]);
      };
      for (std::size_t k = 0; k < low; ++k) pair(k);
      for (std::size_t k = high; k < half; ++k) pair(k);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace trochoid::numerics
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trochoid::numerics {

HWY_EXPORT(transform);

namespace {

/// Rows of functions two by two, as `transform` has them.
struct Rows {
  std::unique_ptr<double[]> values;
  std::size_t count = 0;  ///< rows, a power of two
  std::size_t lanes = 0;  ///< numbers of a part: whole vectors of any machine

  [[nodiscard]] double* row(std::size_t k) noexcept { return &values[2 * lanes * k]; }
};

/// From an eighth of the circle.
std::vector<double> unit_roots(std::size_t n) {
  std::vector<double> out(n);
  const auto set = [&](std::size_t k, double c, double s) {
    out[2 * k] = c;
    out[2 * k + 1] = -s;
  };
  for (std::size_t k = 0; k <= n / 8; ++k) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    set(k, c, s);
    if (n < 4) continue;
    set(n / 4 - k, s, c);
    if (k > 0) set(n / 2 - k, -c, s);
    if (n / 4 + k < n / 2) set(n / 4 + k, -s, c);
  }
  return out;
}

/// Two real functions are one complex one, the first half the real parts and the others the
/// imaginary ones; rows in the order of reversed bits.
Rows paired(std::span<const double> values, std::size_t width, std::size_t n) {
  Rows z;
  z.count = n;
  constexpr std::size_t vector = 4;
  const std::size_t pairs = (width + 1) / 2;
  z.lanes = (pairs + vector - 1) / vector * vector;
  z.values = std::make_unique_for_overwrite<double[]>(2 * z.lanes * n);
  for (std::size_t k = 0, j = 0; k < n; ++k) {
    const double* const from = &values[k * width];
    double* const to = z.row(j);
    std::fill(std::copy(from, from + pairs, to), to + z.lanes, 0.0);
    std::fill(std::copy(from + pairs, from + width, to + z.lanes), to + 2 * z.lanes,
              0.0);
    std::size_t bit = n >> 1U;
    for (; (j & bit) != 0; bit >>= 1U) j ^= bit;
    j ^= bit;
  }
  return z;
}

/// The coefficients of a harmonic m, from the rows of it and of its negative.
void take(Rows& z, std::size_t m, std::span<double> a, std::span<double> b) {
  const double* const up = z.row(m);
  const double* const down = z.row((z.count - m) % z.count);
  const std::size_t lanes = z.lanes;
  const double scale = (m == 0 ? 0.5 : 1.0) / static_cast<double>(z.count);
  const std::size_t pairs = (a.size() + 1) / 2;
  const std::size_t rest = a.size() - pairs;
  for (std::size_t i = 0; i < pairs; ++i) a[i] = scale * (up[i] + down[i]);
  for (std::size_t i = 0; i < rest; ++i) {
    a[pairs + i] = scale * (up[lanes + i] + down[lanes + i]);
  }
  if (b.empty()) return;
  for (std::size_t i = 0; i < pairs; ++i) {
    b[i] = scale * (down[lanes + i] - up[lanes + i]);
  }
  for (std::size_t i = 0; i < rest; ++i) b[pairs + i] = scale * (up[i] - down[i]);
}

/// Of fewer rows than two rounds take.
void transform_few(Rows& z) {
  for (std::size_t i = 0; z.count == 2 && i < 2 * z.lanes; ++i) {
    const double a = z.row(0)[i];
    const double b = z.row(1)[i];
    z.row(0)[i] = a + b;
    z.row(1)[i] = a - b;
  }
}

}  // namespace

std::vector<double> fourier_coefficients(std::span<const double> values,
                                         std::size_t width, int highest) {
  const std::size_t n = width == 0 ? 0 : values.size() / width;
  if (n * width != values.size() || !std::has_single_bit(n) || highest < 0 ||
      2 * static_cast<std::size_t>(highest) >= n) {
    throw std::invalid_argument("fourier coefficients: harmonics up to " +
                                std::to_string(highest) + " of " + std::to_string(n) +
                                " values, which must be a power of two and more than "
                                "twice as many");
  }
  const auto top = static_cast<std::size_t>(highest);
  Rows z = paired(values, width, n);
  if (n < 4) {
    transform_few(z);
  } else {
    HWY_DYNAMIC_DISPATCH(transform)
    ({z.values.get(), 2 * z.lanes * n}, n, unit_roots(n), top);
  }
  std::vector<double> out((2 * top + 1) * width);
  const std::span<double> all = out;
  take(z, 0, all.first(width), {});
  for (std::size_t m = 1; m <= top; ++m) {
    take(z, m, all.subspan((2 * m - 1) * width, width),
         all.subspan(2 * m * width, width));
  }
  return out;
}

}  // namespace trochoid::numerics
#endif
