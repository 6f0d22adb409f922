#include <trochoid/numerics/panels.h>

#include <numbers>

namespace trochoid::numerics {

namespace {

constexpr std::size_t n = panel_nodes;
using Power = std::array<double, n + 2>;  // coefficients of t^0 ... t^(n+1)

/// Power-basis coefficients of the Chebyshev polynomials T_0 ... T_n.
std::array<Power, n + 1> chebyshev_polynomials() {
  std::array<Power, n + 1> T{};
  T[0][0] = 1;
  T[1][1] = 1;
  for (std::size_t k = 2; k <= n; ++k) {
    for (std::size_t i = 0; i <= k; ++i) {
      T[k][i] = (i > 0 ? 2 * T[k - 1][i - 1] : 0.0) - T[k - 2][i];
    }
  }
  return T;
}

PanelRule make_panel_rule() {
  PanelRule rule{};
  std::array<std::array<double, n>, n> to_chebyshev{};  // from node values
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) + 0.5) / n;
    rule.t[i] = -std::cos(angle);
    for (std::size_t k = 0; k < n; ++k) {
      const double parity = k % 2 == 0 ? 1.0 : -1.0;
      to_chebyshev[k][i] =
          (k == 0 ? 1.0 : 2.0) / n * parity * std::cos(static_cast<double>(k) * angle);
    }
  }
  const auto T = chebyshev_polynomials();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t p = 0; p <= k; ++p) {
        rule.antiderivative[p + 1][i] +=
            to_chebyshev[k][i] * T[k][p] / static_cast<double>(p + 1);
      }
    }
    double at_start = 0.0;
    for (std::size_t p = 1; p <= n; ++p) {
      at_start += (p % 2 == 0 ? 1.0 : -1.0) * rule.antiderivative[p][i];
    }
    rule.antiderivative[0][i] = -at_start;
    rule.tail[0][i] = to_chebyshev[n - 2][i];
    rule.tail[1][i] = to_chebyshev[n - 1][i];
  }
  return rule;
}

}  // namespace

const PanelRule& panel_rule() {
  static const PanelRule rule = make_panel_rule();
  return rule;
}

}  // namespace trochoid::numerics
