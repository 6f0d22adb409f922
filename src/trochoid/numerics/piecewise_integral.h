#pragma once

#include <trochoid/numerics/panels.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::numerics {

/// @brief Antiderivative of M functions that are smooth between break points and zero
/// elsewhere, as polynomials on panels; the functions repeat with a period.
template <std::size_t M>
class PiecewiseIntegral {
 public:
  using Values = std::array<double, M>;

  /// @param start   where the period starts
  explicit PiecewiseIntegral(double start = 0.0, double period = 1.0)
      : start_(start), period_(period) {
    panels_.from = start;
  }
  /// Only the first functions are not zero everywhere: saves their work.
  void use_first(std::size_t count) noexcept { panels_.used = count; }

  /// @brief Append an interval; intervals come ascending and do not overlap.
  /// @param f        Values f(double x), smooth on [from, to]
  /// @param longest  longest panel
  /// @param allowed  error allowed in each component of the integral over a panel
  template <class Function>
  void append(double from, double to, const Function& f, double longest,
              const Values& allowed) {
    panels_.add_air(from);
    const auto count = static_cast<int>(std::ceil((to - from) / longest * (1 - 1e-12)));
    const double step = (to - from) / std::max(count, 1);
    for (int i = 0; i < count; ++i) {
      const double a = from + i * step;
      panels_.add_panel(a, i + 1 == count ? to : a + step, f, allowed, 0);
    }
  }

  /// @brief Append what another one has between two places.
  ///
  /// Both have the same period; what comes before ends at `from` or earlier.
  void append(const PiecewiseIntegral& other, double from, double to) {
    panels_.add_air(from);
    std::size_t i = other.panel_at(from);
    for (double at = from; at < to; ++i) {
      const auto& panel = other.panels_.list[i];
      const bool last = i + 1 == other.panels_.list.size() || panel.to >= to;
      const double end = last ? to : panel.to;
      if (panel.count == 0) {
        panels_.add_air(end);
      } else {
        panels_.add_copy(other.panels_, i, at, end);
      }
      at = end;
    }
  }

  /// Close the period after the last interval.
  void finish() {
    panels_.add_air(start_ + period_);
    buckets_.resize(4 * panels_.list.size() + 1);
    per_bucket_ = static_cast<double>(buckets_.size()) / period_;
    std::size_t panel = 0;
    for (std::size_t i = 0; i < buckets_.size(); ++i) {
      const double x = start_ + static_cast<double>(i) / per_bucket_;
      while (panel + 1 < panels_.list.size() && panels_.list[panel].to <= x) {
        ++panel;
      }
      buckets_[i] = panel;
    }
  }

  /// Integral over one period.
  [[nodiscard]] const Values& total() const noexcept { return panels_.sum; }

  /// @brief Add factor times the integral from the start of the first period to x.
  void add_to(Values& out, double x, double factor) const noexcept {
    const double turns = std::floor((x - start_) / period_);
    const double u = x - turns * period_;
    for (std::size_t q = 0; q < M; ++q) {
      out[q] += factor * turns * panels_.sum[q];
    }
    panels_.add_up_to(panel_at(u), u, factor, out);
  }

  /// @brief Add the integral between two places of the first period, of the first Q
  /// functions.
  template <std::size_t Q>
  void add_between(double from, double to, std::array<double, Q>& out) const noexcept {
    static_assert(Q <= M);
    const std::size_t a = panel_at(from);
    const std::size_t b = panel_at(to);
    if (a == b && panels_.list[a].count == 0) return;
    panels_.add_up_to(b, to, 1.0, out);
    panels_.add_up_to(a, from, -1.0, out);
  }

  /// @brief Add, for many x, the integrals of the first functions from x + from to x + to;
  /// what lies outside of the first period adds nothing.
  /// @param x    ascending, shape (n)
  /// @param out  shape (rows, n)
  void add_between(std::span<const double> x, double from, double to,
                   std::span<double> out) const noexcept {
    add_up_to(x, to, 1.0, out);
    add_up_to(x, from, -1.0, out);
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
    result.panels_.sum = apply(panels_.sum);
    result.buckets_ = buckets_;
    result.per_bucket_ = per_bucket_;
    result.panels_.list.reserve(panels_.list.size());
    for (const auto& p : panels_.list) {
      result.panels_.list.push_back(
          {p.to, p.middle, p.per_half, p.first, p.count, apply(p.base)});
    }
    result.panels_.coefficients.reserve(panels_.coefficients.size());
    for (const Values& c : panels_.coefficients) {
      result.panels_.coefficients.push_back(apply(c));
    }
    return result;
  }

 private:
  template <std::size_t>
  friend class PiecewiseIntegral;

  /// The panel of a place of the first period.
  [[nodiscard]] std::size_t panel_at(double u) const noexcept {
    const double place = std::max(0.0, (u - start_) * per_bucket_);
    std::size_t i =
        buckets_[std::min(static_cast<std::size_t>(place), buckets_.size() - 1)];
    while (i + 1 < panels_.list.size() && panels_.list[i].to <= u) {
      ++i;
    }
    return i;
  }

  /// Add factor times the integrals up to x + shift, in the first period.
  void add_up_to(std::span<const double> x, double shift, double factor,
                 std::span<double> out) const noexcept {
    const std::size_t n = x.size();
    const std::size_t rows = n > 0 ? out.size() / n : 0;
    const auto first_from = [&](double place, std::size_t i) {
      return static_cast<std::size_t>(
          std::lower_bound(x.begin() + static_cast<std::ptrdiff_t>(i), x.end(),
                           place - shift) -
          x.begin());
    };
    const auto add_all = [&](const Values& value, std::size_t i, std::size_t end) {
      for (std::size_t q = 0; q < rows; ++q) {
        const double all = factor * value[q];
        for (std::size_t k = i; k < end; ++k) out[q * n + k] += all;
      }
    };
    std::size_t i = first_from(start_, 0);
    if (i == n) return;
    for (std::size_t p = panel_at(x[i] + shift); p < panels_.list.size() && i < n;
         ++p) {
      const auto& panel = panels_.list[p];
      const std::size_t end = first_from(panel.to, i);
      if (panel.count == 0) {
        add_all(panel.base, i, end);
      } else if (end > i) {
        Polynomials of = panels_.polynomials(panel);
        of.middle -= shift;
        add_polynomials(of, x.subspan(i, end - i), factor, {out.subspan(i), n});
      }
      i = end;
    }
    add_all(panels_.sum, i, n);
  }

  double start_;
  double period_;
  double per_bucket_ = 0.0;
  Panels<M> panels_;
  std::vector<std::size_t> buckets_;
};

}  // namespace trochoid::numerics
