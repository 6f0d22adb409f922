#include "turn_stock_edge.h"

#include <algorithm>
#include <cmath>

namespace trochoid::force {

namespace {

using numerics::panel_nodes;
constexpr std::size_t wide = std::tuple_size_v<Triple>;
/// What the last terms of a panel may be, of the largest value.
constexpr double smallest_tail = 1e-10;
constexpr int most_halvings = 30;
/// Of a chip that is a difference of radii, of the radius.
constexpr double rounding = 1e-15;

struct Stretch {
  const TurnTeeth& teeth;
  const TurnWeights& weights;
  std::size_t tooth;

  [[nodiscard]] Triple at(double theta) const noexcept {
    const double nominal = theta - teeth.teeth[tooth].epsilon;
    const double h =
        chip::chip_at(teeth.passage, teeth.slice(), static_cast<int>(tooth), nominal).h;
    const double s = std::sin(theta);
    const double c = std::cos(theta);
    const TurnWeights& w = weights;
    Triple g{};
    for (std::size_t q = 0; q < wide; ++q) {
      g[q] = h * (w.h_cos[q] * c + w.h_sin[q] * s + w.h_one[q]) +
             teeth.edge_factor * (w.e_cos[q] * c + w.e_sin[q] * s + w.e_one[q]);
    }
    return g;
  }
};

using NodeValues = std::array<Triple, panel_nodes>;

/// What rounding makes of the values.
double noise_of(const Stretch& stretch) noexcept {
  const TurnWeights& w = stretch.weights;
  double most = 0.0;
  for (std::size_t q = 0; q < wide; ++q) {
    most = std::max(most,
                    std::abs(w.h_cos[q]) + std::abs(w.h_sin[q]) + std::abs(w.h_one[q]));
  }
  return rounding * stretch.teeth.r * most;
}

bool resolved(const NodeValues& y, double noise) noexcept {
  double largest = 0.0;
  double last = 0.0;
  for (std::size_t q = 0; q < wide; ++q) {
    for (const Triple& value : y) {
      largest = std::max(largest, std::abs(value[q]));
    }
    for (const auto& row : numerics::panel_rule().tail) {
      double c = 0.0;
      for (std::size_t i = 0; i < panel_nodes; ++i) {
        c += row[i] * y[i][q];
      }
      last = std::max(last, std::abs(c));
    }
  }
  return last <= std::max(smallest_tail * largest, noise);
}

void add(const Stretch& stretch, double from, double to, int halvings,
         std::vector<StockEdge>& out) {
  const numerics::PanelRule& rule = numerics::panel_rule();
  StockEdge edge{from, to};
  const double middle = 0.5 * (from + to);
  NodeValues y;
  for (std::size_t i = 0; i < panel_nodes; ++i) {
    y[i] = stretch.at(middle + edge.half() * rule.t[i]);
  }
  if (halvings < most_halvings && to - from > 1e-9 && !resolved(y, noise_of(stretch))) {
    add(stretch, from, middle, halvings + 1, out);
    add(stretch, middle, to, halvings + 1, out);
    return;
  }
  for (std::size_t k = 0; k <= panel_nodes; ++k) {
    for (std::size_t i = 0; i < panel_nodes; ++i) {
      for (std::size_t q = 0; q < wide; ++q) {
        edge.integral[k][q] += edge.half() * rule.antiderivative[k][i] * y[i][q];
      }
    }
  }
  out.push_back(edge);
}

}  // namespace

void add_stock_edges(const TurnTeeth& teeth, const TurnWeights& weights,
                     std::size_t tooth, const chip::HarmonicPiece& piece,
                     std::vector<StockEdge>& out) {
  add({teeth, weights, tooth}, piece.from, piece.to, 0, out);
}

Triple total(const StockEdge& edge) noexcept {
  Triple sum{};
  for (const Triple& power : edge.integral) {
    for (std::size_t q = 0; q < wide; ++q) {
      sum[q] += power[q];
    }
  }
  return sum;
}

std::array<Triple, panel_nodes + 1> integrand(const StockEdge& edge) noexcept {
  std::array<Triple, panel_nodes + 1> out{};
  for (std::size_t k = 1; k <= panel_nodes; ++k) {
    for (std::size_t q = 0; q < wide; ++q) {
      out[k - 1][q] = static_cast<double>(k) * edge.integral[k][q] / edge.half();
    }
  }
  return out;
}

}  // namespace trochoid::force
