#include <trochoid/dynamics/nodes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>

namespace trochoid::dynamics {

namespace {

using std::numbers::pi;

/// Positive Gauss-Legendre nodes of eight and their weights.
constexpr std::array<double, 4> legendre_t = {0.1834346424956498, 0.5255324099163290,
                                              0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> legendre_w = {0.3626837833783620, 0.3137066458778873,
                                              0.2223810344533745, 0.1012285362903763};

ElementNodes make_nodes(int n) {
  ElementNodes nodes;
  const auto count = static_cast<std::size_t>(n) + 1;
  for (int i = 0; i <= n; ++i) {
    // sin keeps the nodes exactly symmetric
    nodes.t.push_back(std::sin(pi * (2 * i - n) / (2 * n)));
    nodes.weights.push_back((i % 2 == 0 ? 1.0 : -1.0) * (i == 0 || i == n ? 0.5 : 1.0));
  }
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double half = 0.5 * (nodes.t[i + 1] - nodes.t[i]);
    const double middle = 0.5 * (nodes.t[i + 1] + nodes.t[i]);
    for (std::size_t g = 0; g < gauss_count; ++g) {
      const std::size_t k = g < 4 ? 3 - g : g - 4;
      nodes.gauss_t.push_back(middle + (g < 4 ? -1.0 : 1.0) * half * legendre_t[k]);
      nodes.gauss_w.push_back(half * legendre_w[k]);
    }
  }
  nodes.at_gauss.resize(nodes.gauss_t.size() * count);
  for (std::size_t g = 0; g < nodes.gauss_t.size(); ++g) {
    lagrange_row(nodes, nodes.gauss_t[g],
                 std::span(nodes.at_gauss).subspan(g * count, count));
  }
  return nodes;
}

}  // namespace

const ElementNodes& element_nodes(int n) {
  static std::array<std::once_flag, largest_degree + 1> made;
  static std::array<std::unique_ptr<const ElementNodes>, largest_degree + 1> all;
  const auto i = static_cast<std::size_t>(std::clamp(n, 1, largest_degree));
  std::call_once(made[i], [&] {
    all[i] = std::make_unique<const ElementNodes>(make_nodes(static_cast<int>(i)));
  });
  return *all[i];
}

void lagrange_row(const ElementNodes& nodes, double t, std::span<double> row) noexcept {
  constexpr double same = 1e-14;
  double sum = 0.0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double away = t - nodes.t[i];
    if (std::abs(away) < same) {
      std::fill(row.begin(), row.end(), 0.0);
      row[i] = 1.0;
      return;
    }
    row[i] = nodes.weights[i] / away;
    sum += row[i];
  }
  for (double& value : row) {
    value /= sum;
  }
}

std::vector<double> slopes_at_nodes(const ElementNodes& nodes) {
  const std::size_t count = nodes.t.size();
  const double step = pi / static_cast<double>(2 * (count - 1));
  std::vector<double> E(count * count);
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < count; ++j) {
      if (j != i) {
        // t_i - t_j as a product: a difference loses digits where nodes are dense.
        const auto both = static_cast<double>(i + j);
        const double apart = static_cast<double>(i) - static_cast<double>(j);
        const double away = 2 * std::sin(both * step) * std::sin(apart * step);
        E[i * count + j] = nodes.weights[j] / (nodes.weights[i] * away);
        sum += E[i * count + j];
      }
    }
    E[i * count + i] = -sum;  // D-32
  }
  return E;
}

double chebyshev_tail(std::span<const double> values) noexcept {
  // The barycentric weights are the last Chebyshev polynomial at the nodes, halved at
  // the ends; times t they are the one before it.
  const ElementNodes& nodes = element_nodes(static_cast<int>(values.size()) - 1);
  double last = 0.0;
  double before = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double weighted = nodes.weights[i] * values[i];
    last += weighted;
    before += weighted * nodes.t[i];
  }
  return std::max(std::abs(last), 2 * std::abs(before)) /
         static_cast<double>(values.size() - 1);
}

}  // namespace trochoid::dynamics
