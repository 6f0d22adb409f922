#include <trochoid/numerics/dense.h>
#include <trochoid/numerics/dominant_eigenvalue.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::numerics {

namespace {

constexpr std::size_t first_check = 9;

double length(std::span<const double> v) {
  double sum = 0.0;
  for (const double value : v) sum += value * value;
  return std::sqrt(sum);
}

/// A start that no symmetry of a map makes special, the same each time.
std::vector<double> start_vector(std::size_t n) {
  std::vector<double> v(n);
  double x = 0.37;
  for (double& value : v) {
    x = std::fmod(x + 0.6180339887498949, 1.0);
    value = x - 0.3;
  }
  const double norm = length(v);
  for (double& value : v) value /= norm;
  return v;
}

/// What of a vector lies along others.
struct Projection {
  std::vector<double> along;
  double left = 0.0;   ///< length of the rest
  bool ended = false;  ///< nothing is left
};

/// @param[in]     V  orthonormal columns, shape (w.size(), count)
/// @param[in,out] w  then the rest, of length one unless nothing is left
Projection orthogonalize(std::span<const double> V, std::size_t count,
                         std::span<double> w) {
  const double before = length(w);
  Projection p{std::vector<double>(count), 0.0, false};
  transposed_product(V, w, p.along);
  add_product(-1.0, V, p.along, w);
  p.left = length(w);
  if (p.left < 0.7 * before) {  // twice is enough, and needed only here
    std::vector<double> more(count);
    transposed_product(V, w, more);
    add_product(-1.0, V, more, w);
    for (std::size_t i = 0; i < count; ++i) p.along[i] += more[i];
    p.left = length(w);
  }
  p.ended = p.left <= 1e-14 * before;
  if (!p.ended) {
    for (double& value : w) value /= p.left;
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
std::vector<std::complex<double>> combined(
    std::span<const double> V, const std::vector<std::complex<double>>& coordinates) {
  const std::size_t k = coordinates.size();
  std::vector<double> x(k);
  std::vector<double> y(k);
  for (std::size_t i = 0; i < k; ++i) {
    x[i] = coordinates[i].real();
    y[i] = coordinates[i].imag();
  }
  std::vector<double> real(V.size() / k);
  std::vector<double> imaginary(V.size() / k);
  add_product(1.0, V, x, real);
  add_product(1.0, V, y, imaginary);
  std::vector<std::complex<double>> out(real.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {real[i], imaginary[i]};
  return out;
}

}  // namespace

DominantEigenvalue dominant_eigenvalue(const LinearMap& map, std::size_t size,
                                       double tolerance) {
  const std::size_t n = size;
  std::vector<double> V = start_vector(n);  // column-major, shape (n, k + 1)
  std::vector<Projection> H;                // its columns
  std::size_t check = std::min(n, first_check);
  Eigenpair found;
  double residual = 0.0;
  for (std::size_t k = 1; k <= n; ++k) {
    V.resize((k + 1) * n);
    const std::span<const double> before(V.data(), k * n);
    const std::span<double> next(V.data() + k * n, n);
    map(before.last(n), next);
    H.push_back(orthogonalize(before, k, next));
    const bool ended = k == n || H.back().ended;
    if (k < check && !ended) {
      continue;
    }
    const Eigenpair last = std::exchange(found, ritz(H));
    residual = ended ? 0.0 : H.back().left * std::abs(found.vector.back());
    const double scale = std::abs(found.value);
    if (ended || residual <= tolerance * scale ||
        (residual <= 1e-2 * scale && k > first_check &&
         std::abs(found.value - last.value) <= 0.1 * tolerance * scale)) {
      break;
    }
    check = k + std::max<std::size_t>(3, k / 4);
  }
  const std::span<const double> basis(V.data(), found.vector.size() * n);
  return {.value = found.value,
          .vector = combined(basis, found.vector),
          .residual = residual,
          .steps = static_cast<int>(found.vector.size())};
}

}  // namespace trochoid::numerics
