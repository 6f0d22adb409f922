#include <trochoid/numerics/dense.h>
#include <trochoid/numerics/dominant_eigenvalue.h>
#include <trochoid/numerics/padded.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::numerics {

namespace {

constexpr std::size_t first_check = 9;
/// Steps less than expected that may be enough.
constexpr int fewer = 2;

/// @param v  padded
double length(std::span<const double> v) {
  double square = 0.0;
  padded_transposed_product(v, v, {&square, 1});
  return std::sqrt(square);
}

void divide(std::span<double> v, double by) {
  for (double& value : v) value /= by;
}

/// A start that no symmetry of a map makes special, the same each time.
std::vector<double> start_vector(std::size_t n) {
  std::vector<double> v(padded(n));
  double x = 0.37;
  for (std::size_t i = 0; i < n; ++i) {
    x = std::fmod(x + 0.6180339887498949, 1.0);
    v[i] = x - 0.3;
  }
  divide(v, length(v));
  return v;
}

/// What of a vector lies along others.
struct Projection {
  std::vector<double> along;
  double left = 0.0;   ///< length of the rest
  bool ended = false;  ///< nothing is left
};

/// @param[in]     V  orthonormal padded columns, shape (w.size(), count)
/// @param[in,out] w  padded; then the rest, of length one unless nothing is left
Projection orthogonalize(std::span<const double> V, std::size_t count,
                         std::span<double> w) {
  const double before = length(w);
  Projection p{std::vector<double>(count), 0.0, false};
  padded_transposed_product(V, w, p.along);
  subtract_padded_product(V, p.along, w);
  p.left = length(w);
  if (p.left < 0.7 * before) {  // twice is enough, and needed only here
    std::vector<double> more(count);
    padded_transposed_product(V, w, more);
    subtract_padded_product(V, more, w);
    for (std::size_t i = 0; i < count; ++i) p.along[i] += more[i];
    p.left = length(w);
  }
  p.ended = p.left <= 1e-14 * before;
  if (!p.ended) {
    divide(w, p.left);
  }
  return p;
}

/// The largest eigenpair of H_k, whose columns these are.
Eigenpair ritz(const std::vector<Projection>& columns) {
  const std::size_t k = columns.size();
  Matrix H = zeros(k, k);
  for (std::size_t j = 0; j < k; ++j) {
    const auto& along = columns[j].along;
    std::copy(along.begin(), along.end(), &H(0, j));
    if (j + 1 < k) H(j + 1, j) = columns[j].left;
  }
  return largest_hessenberg_pair(H);
}

/// V times complex coordinates.
/// @param V  padded columns of n numbers
std::vector<std::complex<double>> combined(
    std::span<const double> V, const std::vector<std::complex<double>>& coordinates,
    std::size_t n) {
  const std::size_t k = coordinates.size();
  std::vector<double> x(k);
  std::vector<double> y(k);
  for (std::size_t i = 0; i < k; ++i) {
    x[i] = coordinates[i].real();
    y[i] = coordinates[i].imag();
  }
  std::vector<double> real(padded(n));
  std::vector<double> imaginary(padded(n));
  padded_product(V, x, real);
  padded_product(V, y, imaginary);
  std::vector<std::complex<double>> out(n);
  for (std::size_t i = 0; i < n; ++i) out[i] = {real[i], imaginary[i]};
  return out;
}

}  // namespace

DominantEigenvalue dominant_eigenvalue(const LinearMap& map, std::size_t size,
                                       double tolerance, int expected) {
  const std::size_t n = size;
  const std::size_t room = padded(n);
  std::vector<double> V = start_vector(n);  // padded columns, k + 1 of them
  std::vector<Projection> H;                // its columns
  // A check costs as much as some steps: none long before it can succeed.
  const std::size_t first =
      expected > 0 ? static_cast<std::size_t>(std::max(expected - fewer, 4))
                   : first_check;
  std::size_t check = std::min(n, first);
  Eigenpair found;
  double residual = 0.0;
  for (std::size_t k = 1; k <= n; ++k) {
    V.resize((k + 1) * room);
    const std::span<const double> before(V.data(), k * room);
    const std::span<double> next(V.data() + k * room, room);
    map(before.last(room).first(n), next.first(n));
    H.push_back(orthogonalize(before, k, next));
    const bool ended = k == n || H.back().ended;
    if (k < check && !ended) {
      continue;
    }
    const Eigenpair last = std::exchange(found, ritz(H));
    residual = ended ? 0.0 : H.back().left * std::abs(found.vector.back());
    const double scale = std::abs(found.value);
    if (ended || residual <= tolerance * scale ||
        (residual <= 1e-2 * scale && k > first &&
         std::abs(found.value - last.value) <= 0.1 * tolerance * scale)) {
      break;
    }
    check = k + std::max<std::size_t>(3, k / 4);
  }
  return {.value = found.value,
          .vector = combined(V, found.vector, n),
          .residual = residual,
          .steps = static_cast<int>(found.vector.size())};
}

}  // namespace trochoid::numerics
