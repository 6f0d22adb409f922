#include <trochoid/numerics/fourier.h>

#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>

namespace trochoid::numerics {
namespace {

using Complex = std::complex<double>;

/// (a, b) to (a + turn b, a - turn b), without the checks of a complex product.
void butterfly(Complex& a, Complex& b, const Complex& turn) noexcept {
  const Complex t(turn.real() * b.real() - turn.imag() * b.imag(),
                  turn.real() * b.imag() + turn.imag() * b.real());
  b = a - t;
  a += t;
}

/// sum over k of z_k e^(-2 pi i m k/n), in place; n = z.size() a power of two.
void transform(std::vector<Complex>& z, std::span<const Complex> roots) noexcept {
  const std::size_t n = z.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1;
    for (; (j & bit) != 0; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(z[i], z[j]);
  }
  for (std::size_t half = 1; half < n; half *= 2) {
    const std::size_t stride = n / (2 * half);
    for (std::size_t from = 0; from < n; from += 2 * half) {
      for (std::size_t k = 0; k < half; ++k) {
        butterfly(z[from + k], z[from + k + half], roots[k * stride]);
      }
    }
  }
}

std::vector<Complex> unit_roots(std::size_t n) {
  std::vector<Complex> out(n / 2);
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] = std::polar(
        1.0, -2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
  }
  return out;
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
  const std::vector<Complex> roots = unit_roots(n);
  const auto top = static_cast<std::size_t>(highest);
  std::vector<double> out((2 * top + 1) * width);
  std::vector<Complex> z(n);
  const double scale = 1.0 / static_cast<double>(n);
  // Two real functions are one complex one.
  for (std::size_t c = 0; c < width; c += 2) {
    const bool pair = c + 1 < width;
    for (std::size_t k = 0; k < n; ++k) {
      z[k] = {values[k * width + c], pair ? values[k * width + c + 1] : 0.0};
    }
    transform(z, roots);
    for (std::size_t m = 0; m <= top; ++m) {
      const Complex up = z[m];
      const Complex down = std::conj(z[(n - m) % n]);
      const Complex first = 0.5 * (up + down);
      const Complex difference = up - down;
      const Complex second(0.5 * difference.imag(), -0.5 * difference.real());
      const std::size_t row = m == 0 ? 0 : 2 * m - 1;
      const double twice = m == 0 ? scale : 2.0 * scale;
      out[row * width + c] = twice * first.real();
      if (m > 0) out[(row + 1) * width + c] = -twice * first.imag();
      if (!pair) continue;
      out[row * width + c + 1] = twice * second.real();
      if (m > 0) out[(row + 1) * width + c + 1] = -twice * second.imag();
    }
  }
  return out;
}

}  // namespace trochoid::numerics
