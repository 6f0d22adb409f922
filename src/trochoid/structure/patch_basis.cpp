#include <trochoid/structure/patch_basis.h>

#include <algorithm>
#include <utility>

namespace trochoid::structure {

namespace {

/// P_0..P_n at t.
std::vector<double> legendre(std::size_t n, double t) {
  std::vector<double> P(n + 1, 1.0);
  for (std::size_t k = 1; k <= n; ++k) {
    const auto m = static_cast<double>(k);
    P[k] = k == 1 ? t : ((2 * m - 1) * t * P[k - 1] - (m - 1) * P[k - 2]) / m;
  }
  return P;
}

/// Integrals of P_0..P_n from -1 to t.
std::vector<double> legendre_integrals(std::size_t n, double t) {
  const std::vector<double> P = legendre(n + 1, t);
  std::vector<double> Q(n + 1, t + 1);
  for (std::size_t k = 1; k <= n; ++k) {
    Q[k] = (P[k + 1] - P[k - 1]) / (2 * static_cast<double>(k) + 1);
  }
  return Q;
}

}  // namespace

PatchBasis::PatchBasis(std::vector<double> nodes, std::size_t degree, Clamps clamps)
    : nodes_(std::move(nodes)), degree_(degree) {
  const std::size_t last = nodes_.size() - 1;
  for (std::size_t patch = 0; patch < last; ++patch) {
    // Even and odd shapes of a patch do not meet in any product.
    for (const std::size_t parity : {2U, 3U}) {
      for (std::size_t k = parity; k + 2 <= degree; k += 2) {
        functions_.push_back({bubble(patch, k)});
      }
    }
  }
  for (std::size_t node = clamps.start ? 1 : 0; node + (clamps.end ? 1 : 0) <= last;
       ++node) {
    add_node(node);
  }
}

PatchBasis::Piece PatchBasis::bubble(std::size_t patch, std::size_t k) const {
  const double J = 2 / length(patch);
  const double m = 2 * static_cast<double>(k) + 1;
  Piece piece{.patch = patch, .first = k - 2, .c = {}};
  piece.c[2][2] = J * J;
  piece.c[1][3] = J / m;
  piece.c[1][1] = -J / m;
  piece.c[0][4] = 1 / (m * (m + 2));
  piece.c[0][0] = 1 / (m * (m - 2));
  piece.c[0][2] = -(piece.c[0][4] + piece.c[0][0]);
  return piece;
}

PatchBasis::Piece PatchBasis::cubic(std::size_t patch, std::array<double, 4> c) const {
  const double J = 2 / length(patch);
  return {.patch = patch,
          .first = 0,
          .c = {{{c[0], c[1], c[2], c[3], 0},
                 {J * (c[1] + c[3]), J * 3 * c[2], J * 5 * c[3], 0, 0},
                 {J * J * 3 * c[2], J * J * 15 * c[3], 0, 0, 0}}}};
}

void PatchBasis::add_node(std::size_t node) {
  Function value;
  Function slope;
  if (node > 0) {
    const double before = length(node - 1) / 2;
    value.push_back(cubic(node - 1, {0.5, 0.6, 0, -0.1}));
    slope.push_back(
        cubic(node - 1, {-before / 6, -before / 10, before / 6, before / 10}));
  }
  if (node + 1 < nodes_.size()) {
    const double after = length(node) / 2;
    value.push_back(cubic(node, {0.5, -0.6, 0, 0.1}));
    slope.push_back(cubic(node, {after / 6, -after / 10, -after / 6, after / 10}));
  }
  functions_.push_back(std::move(value));
  functions_.push_back(std::move(slope));
}

std::vector<double> PatchBasis::gram(std::size_t p, std::size_t q,
                                     std::span<const double> weights) const {
  const std::size_t n = size();
  const auto product = [&](const Piece& f, const Piece& g) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 5; ++i) {
      const std::size_t k = f.first + i;
      if (k >= g.first && k < g.first + 5) {
        sum += f.c[p][i] * g.c[q][k - g.first] / (2 * static_cast<double>(k) + 1);
      }
    }
    return sum * length(f.patch) * (weights.empty() ? 1.0 : weights[f.patch]);
  };
  std::vector<double> G(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (const Piece& f : functions_[i]) {
        for (const Piece& g : functions_[j]) {
          G[i * n + j] += f.patch == g.patch ? product(f, g) : 0.0;
        }
      }
    }
  }
  return G;
}

std::vector<double> PatchBasis::at(double x, std::size_t derivative) const {
  const auto inner = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, x);
  const auto patch = static_cast<std::size_t>(inner - nodes_.begin()) - 1;
  const double t = std::clamp(2 * (x - nodes_[patch]) / length(patch) - 1, -1.0, 1.0);
  const std::vector<double> P = legendre(degree_ + 1, t);
  std::vector<double> values(size(), 0.0);
  for (std::size_t i = 0; i < size(); ++i) {
    for (const Piece& f : functions_[i]) {
      for (std::size_t k = 0; f.patch == patch && k < 5; ++k) {
        const double c = f.c[derivative][k];
        values[i] += c * (c == 0 ? 0 : P[f.first + k]);
      }
    }
  }
  return values;
}

std::vector<double> PatchBasis::means(double from, double to) const {
  if (!(to > from)) {
    return values(from);
  }
  std::vector<double> means(size(), 0.0);
  for (std::size_t patch = 0; patch + 1 < nodes_.size(); ++patch) {
    const auto local = [&](double x) {
      return std::clamp(2 * (x - nodes_[patch]) / length(patch) - 1, -1.0, 1.0);
    };
    const std::vector<double> low = legendre_integrals(degree_, local(from));
    const std::vector<double> high = legendre_integrals(degree_, local(to));
    const double scale = length(patch) / 2 / (to - from);
    for (std::size_t i = 0; i < size(); ++i) {
      for (const Piece& f : functions_[i]) {
        for (std::size_t k = 0; f.patch == patch && k < 5; ++k) {
          if (f.c[0][k] != 0) {
            means[i] += scale * f.c[0][k] * (high[f.first + k] - low[f.first + k]);
          }
        }
      }
    }
  }
  return means;
}

}  // namespace trochoid::structure
