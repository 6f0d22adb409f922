#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::numerics {

/// @brief Polynomials in t = (x - middle) per_half, side by side.
struct Polynomials {
  std::span<const double> coefficients;  ///< of t^0, t^1 ..., row-major, (., stride)
  std::size_t stride = 0;
  double middle = 0.0;
  double per_half = 0.0;
};

/// @brief Rows of results, one for each polynomial, pitch from one another.
struct PlacesOut {
  std::span<double>
      values;  ///< from the first of the first row to the last of the last
  std::size_t pitch = 1;
};

/// @brief Add factor times the first polynomials at places, on as wide vectors as the
/// machine has: so many as there are rows.
/// @param x  shape (n), n at most out.pitch
void add_polynomials(const Polynomials& of, std::span<const double> x, double factor,
                     const PlacesOut& out) noexcept;

/// Nodes of a panel; the antiderivative has degree panel_nodes.
inline constexpr std::size_t panel_nodes = 10;

/// @brief Constant matrices of a panel on t in [-1, 1].
struct PanelRule {
  std::array<double, panel_nodes> t;  ///< Chebyshev nodes of the first kind
  /// From node values to the power-basis coefficients t^1 ... t^n of the antiderivative
  /// that vanishes at t = -1 (its constant follows from the others).
  std::array<std::array<double, panel_nodes>, panel_nodes + 1> antiderivative;
  /// From node values to the last two Chebyshev coefficients: the error estimate.
  std::array<std::array<double, panel_nodes>, 2> tail;
};
const PanelRule& panel_rule();

/// @brief The antiderivative of M functions as polynomials on panels that follow one
/// another, with air between them.
template <std::size_t M>
struct Panels {
  using Values = std::array<double, M>;
  struct Panel {
    double to;
    double middle;
    double per_half;    ///< 2 / length
    std::size_t first;  ///< of its coefficients
    std::size_t count;  ///< of its coefficients; 0: nothing is integrated here
    Values base;        ///< integral up to its start
  };

  double from = 0.0;     ///< where the first one starts
  std::size_t used = M;  ///< functions that are not zero everywhere: the first of them
  std::vector<Panel> list;
  std::vector<Values> coefficients;
  Values sum{};  ///< of all panels

  /// Up to where panels are.
  [[nodiscard]] double end() const noexcept {
    return list.empty() ? from : list.back().to;
  }

  /// Nothing is integrated up to a place.
  void add_air(double to) {
    if (const double at = end(); to > at) list.push_back({to, at, 0.0, 0, 0, sum});
  }

  /// A panel, or several where f is not resolved.
  template <class Function>
  void add_panel(double from, double to, const Function& f, const Values& allowed,
                 int depth) {
    const PanelRule& rule = panel_rule();
    const double half = 0.5 * (to - from);
    const double middle = 0.5 * (to + from);
    std::array<Values, panel_nodes> y;
    for (std::size_t i = 0; i < panel_nodes; ++i) {
      y[i] = f(middle + half * rule.t[i]);
    }
    if (depth < 40 && !resolved(y, half, allowed)) {
      add_panel(from, middle, f, allowed, depth + 1);
      add_panel(middle, to, f, allowed, depth + 1);
      return;
    }
    const std::size_t first = coefficients.size();
    coefficients.resize(first + panel_nodes + 1, Values{});
    for (std::size_t k = 0; k <= panel_nodes; ++k) {
      Values& c = coefficients[first + k];
      for (std::size_t i = 0; i < panel_nodes; ++i) {
        const double weight = half * rule.antiderivative[k][i];
        for (std::size_t q = 0; q < used; ++q) {
          c[q] += weight * y[i][q];
        }
      }
    }
    list.push_back({to, middle, 1 / half, first, panel_nodes + 1, sum});
    Values last{};
    for (std::size_t k = 0; k <= panel_nodes; ++k) {
      for (std::size_t q = 0; q < M; ++q) {
        last[q] += coefficients[first + k][q];  // at t = 1
      }
    }
    for (std::size_t q = 0; q < M; ++q) {
      coefficients[first][q] += sum[q];
      sum[q] += last[q];
    }
  }

  [[nodiscard]] bool resolved(const std::array<Values, panel_nodes>& y, double half,
                              const Values& allowed) const {
    const PanelRule& rule = panel_rule();
    for (std::size_t q = 0; q < used; ++q) {
      double last = 0.0;
      for (const auto& row : rule.tail) {
        double c = 0.0;
        for (std::size_t i = 0; i < panel_nodes; ++i) {
          c += row[i] * y[i][q];
        }
        last = std::max(last, std::abs(c));
      }
      if (last * half > allowed[q]) {
        return false;
      }
    }
    return true;
  }

  /// A part of a panel of another one.
  void add_copy(const Panels& other, std::size_t i, double from, double to) {
    const Panel& panel = other.list[i];
    Values before{};
    Values after{};
    other.add_up_to(i, from, 1.0, before);
    other.add_up_to(i, to, 1.0, after);
    const std::size_t first = coefficients.size();
    const auto c =
        other.coefficients.begin() + static_cast<std::ptrdiff_t>(panel.first);
    coefficients.insert(coefficients.end(), c,
                        c + static_cast<std::ptrdiff_t>(panel.count));
    list.push_back({to, panel.middle, panel.per_half, first, panel.count, sum});
    for (std::size_t q = 0; q < M; ++q) {
      coefficients[first][q] += sum[q] - before[q];
      sum[q] += after[q] - before[q];
    }
  }

  /// Add factor times the integral from the start of the first period to u in a panel.
  template <std::size_t Q>
  void add_up_to(std::size_t i, double u, double factor,
                 std::array<double, Q>& out) const noexcept {
    const Panel& panel = list[i];
    if (panel.count == 0) {
      for (std::size_t q = 0; q < Q; ++q) {
        out[q] += factor * panel.base[q];
      }
      return;
    }
    const double t = (u - panel.middle) * panel.per_half;
    std::array<double, Q> value;
    std::copy_n(coefficients[panel.first + panel_nodes].begin(), Q, value.begin());
    for (std::size_t k = panel_nodes; k-- > 0;) {
      const Values& c = coefficients[panel.first + k];
      for (std::size_t q = 0; q < Q; ++q) {
        value[q] = value[q] * t + c[q];
      }
    }
    for (std::size_t q = 0; q < Q; ++q) {
      out[q] += factor * value[q];
    }
  }

  [[nodiscard]] Polynomials polynomials(const Panel& panel) const noexcept {
    const std::span<const Values> c =
        std::span(coefficients).subspan(panel.first, panel.count);
    return {{c.front().data(), c.size() * M}, M, panel.middle, panel.per_half};
  }
};

}  // namespace trochoid::numerics
