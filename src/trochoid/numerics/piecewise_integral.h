#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::numerics {

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

/// @brief Antiderivative of M functions that are smooth between break points and zero
/// elsewhere, as polynomials on panels; the functions repeat with a period.
template <std::size_t M>
class PiecewiseIntegral {
 public:
  using Values = std::array<double, M>;

  /// @param start   where the period starts
  explicit PiecewiseIntegral(double start = 0.0, double period = 1.0)
      : start_(start), period_(period) {}

  /// @brief Append an interval; intervals come ascending and do not overlap.
  /// @param f        Values f(double x), smooth on [from, to]
  /// @param longest  longest panel
  /// @param allowed  error allowed in each component of the integral over a panel
  template <class Function>
  void append(double from, double to, const Function& f, double longest,
              const Values& allowed) {
    add_air(from);
    const auto count = static_cast<int>(std::ceil((to - from) / longest * (1 - 1e-12)));
    const double step = (to - from) / std::max(count, 1);
    for (int i = 0; i < count; ++i) {
      const double a = from + i * step;
      add_panel(a, i + 1 == count ? to : a + step, f, allowed, 0);
    }
  }

  /// Close the period after the last interval.
  void finish() {
    add_air(start_ + period_);
    buckets_.resize(4 * panels_.size() + 1);
    per_bucket_ = static_cast<double>(buckets_.size()) / period_;
    std::size_t panel = 0;
    for (std::size_t i = 0; i < buckets_.size(); ++i) {
      const double x = start_ + static_cast<double>(i) / per_bucket_;
      while (panel + 1 < panels_.size() && panels_[panel].to <= x) {
        ++panel;
      }
      buckets_[i] = panel;
    }
  }

  /// Integral over one period.
  [[nodiscard]] const Values& total() const noexcept { return sum_; }

  /// @brief Add factor times the integral from the start of the first period to x.
  void add_to(Values& out, double x, double factor) const noexcept {
    const double turns = std::floor((x - start_) / period_);
    const double u = x - turns * period_;
    for (std::size_t q = 0; q < M; ++q) {
      out[q] += factor * turns * sum_[q];
    }
    add_up_to(panel_at(u), u, factor, out);
  }

  /// @brief Add the integral between two places of the first period, of the first Q
  /// functions.
  template <std::size_t Q>
  void add_between(double from, double to, std::array<double, Q>& out) const noexcept {
    static_assert(Q <= M);
    const std::size_t a = panel_at(from);
    const std::size_t b = panel_at(to);
    if (a == b && panels_[a].count == 0) return;
    add_up_to(b, to, 1.0, out);
    add_up_to(a, from, -1.0, out);
  }

  /// @brief The same for linear combinations of the functions.
  /// @param weights  shape (Q, M)
  template <std::size_t Q>
  [[nodiscard]] PiecewiseIntegral<Q> combined(
      const std::array<std::array<double, M>, Q>& weights) const {
    const auto apply = [&](const Values& v) {
      std::array<double, Q> out{};
      for (std::size_t r = 0; r < Q; ++r) {
        for (std::size_t q = 0; q < M; ++q) {
          out[r] += weights[r][q] * v[q];
        }
      }
      return out;
    };
    PiecewiseIntegral<Q> result(start_, period_);
    result.sum_ = apply(sum_);
    result.buckets_ = buckets_;
    result.per_bucket_ = per_bucket_;
    result.panels_.reserve(panels_.size());
    for (const Panel& p : panels_) {
      result.panels_.push_back(
          {p.to, p.middle, p.per_half, p.first, p.count, apply(p.base)});
    }
    result.coefficients_.reserve(coefficients_.size());
    for (const Values& c : coefficients_) {
      result.coefficients_.push_back(apply(c));
    }
    return result;
  }

 private:
  template <std::size_t>
  friend class PiecewiseIntegral;

  struct Panel {
    double to;
    double middle;
    double per_half;    ///< 2 / length
    std::size_t first;  ///< of its coefficients
    std::size_t count;  ///< of its coefficients; 0: nothing is integrated here
    Values base;        ///< integral up to its start
  };

  /// The panel of a place of the first period.
  [[nodiscard]] std::size_t panel_at(double u) const noexcept {
    const double place = std::max(0.0, (u - start_) * per_bucket_);
    std::size_t i =
        buckets_[std::min(static_cast<std::size_t>(place), buckets_.size() - 1)];
    while (i + 1 < panels_.size() && panels_[i].to <= u) {
      ++i;
    }
    return i;
  }

  /// Add factor times the integral from the start of the first period to u in a panel.
  template <std::size_t Q>
  void add_up_to(std::size_t i, double u, double factor,
                 std::array<double, Q>& out) const noexcept {
    const Panel& panel = panels_[i];
    if (panel.count == 0) {
      for (std::size_t q = 0; q < Q; ++q) {
        out[q] += factor * panel.base[q];
      }
      return;
    }
    const double t = (u - panel.middle) * panel.per_half;
    std::array<double, Q> value;
    std::copy_n(coefficients_[panel.first + panel_nodes].begin(), Q, value.begin());
    for (std::size_t k = panel_nodes; k-- > 0;) {
      const Values& c = coefficients_[panel.first + k];
      for (std::size_t q = 0; q < Q; ++q) {
        value[q] = value[q] * t + c[q];
      }
    }
    for (std::size_t q = 0; q < Q; ++q) {
      out[q] += factor * value[q];
    }
  }

  void add_air(double to) {
    const double from = panels_.empty() ? start_ : panels_.back().to;
    if (to > from) {
      panels_.push_back({to, from, 0.0, 0, 0, sum_});
    }
  }

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
    const std::size_t first = coefficients_.size();
    coefficients_.resize(first + panel_nodes + 1, Values{});
    for (std::size_t k = 0; k <= panel_nodes; ++k) {
      Values& c = coefficients_[first + k];
      for (std::size_t i = 0; i < panel_nodes; ++i) {
        for (std::size_t q = 0; q < M; ++q) {
          c[q] += half * rule.antiderivative[k][i] * y[i][q];
        }
      }
    }
    panels_.push_back({to, middle, 1 / half, first, panel_nodes + 1, sum_});
    Values end{};
    for (std::size_t k = 0; k <= panel_nodes; ++k) {
      for (std::size_t q = 0; q < M; ++q) {
        end[q] += coefficients_[first + k][q];  // at t = 1
      }
    }
    for (std::size_t q = 0; q < M; ++q) {
      coefficients_[first][q] += sum_[q];
      sum_[q] += end[q];
    }
  }

  static bool resolved(const std::array<Values, panel_nodes>& y, double half,
                       const Values& allowed) {
    const PanelRule& rule = panel_rule();
    for (std::size_t q = 0; q < M; ++q) {
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

  double start_;
  double period_;
  double per_bucket_ = 0.0;
  Values sum_{};
  std::vector<Panel> panels_;
  std::vector<Values> coefficients_;
  std::vector<std::size_t> buckets_;
};

}  // namespace trochoid::numerics
