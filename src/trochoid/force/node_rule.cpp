#include "node_rule.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::force {

namespace {

/// Below this tolerance eight nodes would need many panels.
constexpr double fine_tolerance = 1e-7;

/// Factors of the powers in Lagrange's i-th polynomial.
std::array<long double, node_room> lagrange(const NodeRule& rule, std::size_t i) {
  std::array<long double, node_room> p{1.0L};
  std::size_t degree = 0;
  for (std::size_t j = 0; j < rule.nodes; ++j) {
    if (j == i) {
      continue;
    }
    const long double scale = 1.0L / (rule.t[i] - static_cast<long double>(rule.t[j]));
    for (std::size_t k = ++degree; k > 0; --k) {
      p[k] = scale * (p[k - 1] - rule.t[j] * p[k]);
    }
    p[0] *= -scale * rule.t[j];
  }
  return p;
}

NodeRule make_rule(std::size_t nodes) {
  NodeRule rule{.nodes = nodes, .width = (nodes + 7) / 8 * 8};
  const double last = static_cast<double>(nodes - 1);
  for (std::size_t i = 0; i < nodes; ++i) {
    rule.t[i] = -std::cos(std::numbers::pi * static_cast<double>(i) / last);
  }
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto p = lagrange(rule, i);
    for (std::size_t k = 0; k < nodes; ++k) {
      const auto factor = static_cast<double>(p[k]);
      rule.l[k][i] = factor;
      rule.power[i][k] = factor;
      rule.area[k + 1][i] = factor / static_cast<double>(k + 1);
    }
    // Discrete cosine transform on the closed nodes.
    const bool end = i == 0 || i + 1 == nodes;
    for (std::size_t back = 0; back < 2; ++back) {
      const std::size_t k = nodes - 1 - back;
      const double angle =
          std::numbers::pi * static_cast<double>(k * (nodes - 1 - i)) / last;
      rule.tail[back][i] =
          (end ? 1.0 : 2.0) / last * std::cos(angle) * (back == 0 ? 0.5 : 1.0);
    }
  }
  const NodeRow to = area_at(rule, 1.0);
  const NodeRow from = area_at(rule, -1.0);
  for (std::size_t i = 0; i < nodes; ++i) {
    rule.whole[i] = to[i] - from[i];
  }
  return rule;
}

struct ValueAndSlope {
  double value;
  double slope;
};

ValueAndSlope with_slope(const NodeRule& rule, const NodeRow& powers,
                         double t) noexcept {
  ValueAndSlope p{0.0, 0.0};
  for (std::size_t k = rule.nodes; k-- > 0;) {
    p.slope = p.slope * t + p.value;
    p.value = p.value * t + powers[k];
  }
  return p;
}

/// A stretch at whose ends a function has values of different signs.
struct Bracket {
  double from;
  double to;
  double value_from;
  double value_to;
};

double root_in(const NodeRule& rule, const NodeRow& powers, Bracket b) noexcept {
  const bool rises = b.value_to > b.value_from;
  double t = b.from + (b.to - b.from) * b.value_from / (b.value_from - b.value_to);
  for (int i = 0; i < 60; ++i) {
    const auto [value, slope] = with_slope(rule, powers, t);
    ((value < 0) == rises ? b.from : b.to) = t;
    double next = t - value / slope;
    if (!(next > b.from && next < b.to)) {
      if (std::abs(next - t) < 1e-13) {
        return t;
      }
      next = 0.5 * (b.from + b.to);
    }
    const double step = std::abs(next - t);
    t = next;
    if (step < 1e-8) {  // Newton's next step is below rounding
      const auto last = with_slope(rule, powers, t);
      const double better = t - last.value / last.slope;
      return std::abs(better - t) < 1e-8 ? better : t;
    }
  }
  return t;
}

/// Where the function comes nearest to zero between two nodes of one sign; `from` where
/// it does so at an end.
double nearest_to_zero(const NodeRule& rule, const NodeRow& powers,
                       const Bracket& b) noexcept {
  const double sign = b.value_from < 0 ? -1.0 : 1.0;
  double lo = b.from;
  double hi = b.to;
  if (sign * with_slope(rule, powers, lo).slope >= 0 ||
      sign * with_slope(rule, powers, hi).slope <= 0) {
    return b.from;
  }
  for (int i = 0; i < 30; ++i) {
    const double t = 0.5 * (lo + hi);
    (sign * with_slope(rule, powers, t).slope < 0 ? lo : hi) = t;
  }
  return 0.5 * (lo + hi);
}

}  // namespace

const NodeRule& node_rule(double tolerance) {
  static const NodeRule coarse = make_rule(8);
  static const NodeRule fine = make_rule(12);
  return tolerance < fine_tolerance ? fine : coarse;
}

NodeRow powers_of(const NodeRule& rule, const double* values) noexcept {
  NodeRow powers{};
  for (std::size_t i = 0; i < rule.nodes; ++i) {
    for (std::size_t k = 0; k < rule.width; ++k) {
      powers[k] += rule.power[i][k] * values[i];
    }
  }
  return powers;
}

double value_at(const NodeRule& rule, const NodeRow& powers, double t) noexcept {
  return with_slope(rule, powers, t).value;
}

NodeRow basis_at(const NodeRule& rule, double t) noexcept {
  NodeRow values{};
  for (std::size_t k = rule.nodes; k-- > 0;) {
    for (std::size_t i = 0; i < rule.width; ++i) {
      values[i] = values[i] * t + rule.l[k][i];
    }
  }
  return values;
}

NodeRow area_at(const NodeRule& rule, double t) noexcept {
  NodeRow values{};
  for (std::size_t k = rule.nodes + 1; k-- > 0;) {
    for (std::size_t i = 0; i < rule.width; ++i) {
      values[i] = values[i] * t + rule.area[k][i];
    }
  }
  return values;
}

NodeRoots roots_of(const NodeRule& rule, const double* values, double slack) noexcept {
  NodeRoots roots;
  NodeRow powers;
  bool known = false;
  for (std::size_t i = 0; i + 1 < rule.nodes; ++i) {
    const Bracket b{rule.t[i], rule.t[i + 1], values[i], values[i + 1]};
    const bool crosses = (b.value_from < 0) != (b.value_to < 0);
    if (!crosses && std::min(std::abs(b.value_from), std::abs(b.value_to)) > slack) {
      continue;
    }
    if (!known) {
      powers = powers_of(rule, values);
      known = true;
    }
    if (crosses) {
      roots.t[roots.count++] = root_in(rule, powers, b);
      continue;
    }
    const double t = nearest_to_zero(rule, powers, b);
    const double value = value_at(rule, powers, t);
    if (t > b.from && (value < 0) != (b.value_from < 0)) {
      roots.t[roots.count++] = root_in(rule, powers, {b.from, t, b.value_from, value});
      roots.t[roots.count++] = root_in(rule, powers, {t, b.to, value, b.value_to});
    }
  }
  return roots;
}

}  // namespace trochoid::force
