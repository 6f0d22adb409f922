#include <trochoid/signal/axes.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trochoid::signal {

namespace {

Matrix3 product(const Matrix3& A, const Matrix3& B) {
  Matrix3 C{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) C[i][j] += A[i][k] * B[k][j];
    }
  }
  return C;
}

/// By cofactors: exact where the entries are 0 and +-1. Not finite if there is none.
Matrix3 inverted(const Matrix3& A) {
  const auto cofactor = [&](std::size_t i, std::size_t j) {
    const std::size_t k = (i + 1) % 3;
    const std::size_t l = (i + 2) % 3;
    const std::size_t m = (j + 1) % 3;
    const std::size_t n = (j + 2) % 3;
    return A[k][m] * A[l][n] - A[k][n] * A[l][m];
  };
  const double determinant =
      A[0][0] * cofactor(0, 0) + A[0][1] * cofactor(0, 1) + A[0][2] * cofactor(0, 2);
  Matrix3 out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out[j][i] = cofactor(i, j) / determinant;
  }
  return out;
}

/// Root of the sum of the squared entries.
double norm(const Matrix3& A) {
  double sum = 0.0;
  for (const auto& row : A) {
    for (const double value : row) sum += value * value;
  }
  return std::sqrt(sum);
}

constexpr Matrix3 identity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Matrix3 mirror = {{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}};
/// By 90 degrees about z, from x to y: takes t to r, and r to -t.
constexpr Matrix3 quarter = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};

}  // namespace

std::vector<Matrix3> axes_candidates() {
  std::vector<Matrix3> all;
  std::array<std::size_t, 3> order = {0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3 Q{};
      for (std::size_t c = 0; c < 3; ++c) {
        Q[c][order[c]] = ((signs >> c) & 1) != 0 ? -1.0 : 1.0;
      }
      all.push_back(Q);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return all;
}

std::array<std::string, 3> axes_names(const Matrix3& Q) {
  std::array<std::string, 3> names;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t q = 0; q < 3; ++q) {
      if (Q[c][q] == 0.0) continue;
      names[c] = std::string(Q[c][q] < 0.0 ? "-" : "") + "xyz"[q];
    }
  }
  return names;
}

std::optional<Matrix3> axes_matrix(std::span<const std::string> names) {
  if (names.size() != 3) return std::nullopt;
  for (const auto& Q : axes_candidates()) {
    const auto own = axes_names(Q);
    if (std::equal(own.begin(), own.end(), names.begin())) return Q;
  }
  return std::nullopt;
}

std::array<AxesClass, 6> axes_classes() {
  // One reading a class: which channel reads z, and the other two either way round.
  constexpr std::array<Matrix3, 6> first = {{
      {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}},
      {{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
      {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}},
      {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}},
      {{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}},
  }};
  std::array<AxesClass, 6> classes{};
  for (std::size_t k = 0; k < 6; ++k) {
    // Q T^-1 reads T F as Q reads F. With T = quarter, T (K_t t + K_r r) = K_t r - K_r
    // t: the coefficients turn by the same matrix.
    Matrix3 T = identity;
    for (std::size_t i = 0; i < 4; ++i) {
      for (const bool down : {false, true}) {
        const Matrix3 whole = down ? product(mirror, T) : T;
        Matrix3 inverse{};
        for (std::size_t a = 0; a < 3; ++a) {
          for (std::size_t b = 0; b < 3; ++b) inverse[a][b] = whole[b][a];
        }
        classes[k].readings[2 * i + (down ? 1 : 0)] = {product(first[k], inverse),
                                                       whole};
      }
      T = product(quarter, T);
    }
  }
  return classes;
}

std::optional<std::vector<std::array<double, 3>>> force_on_tool(
    const std::array<std::vector<double>, 3>& channels, const Matrix3& M) {
  const auto n = channels[0].size();
  if (channels[1].size() != n || channels[2].size() != n) {
    throw std::invalid_argument("force_on_tool: the channels differ in length");
  }
  const Matrix3 back = inverted(M);
  const double condition = norm(M) * norm(back);
  if (!(condition <= 1e8)) {  // nor without an inverse
    return std::nullopt;
  }
  std::vector<std::array<double, 3>> force(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      force[i][a] = back[a][0] * channels[0][i] + back[a][1] * channels[1][i] +
                    back[a][2] * channels[2][i];
    }
  }
  return force;
}

}  // namespace trochoid::signal
