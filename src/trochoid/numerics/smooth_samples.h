#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::numerics {

/// @brief Values of a function at many places close together, from fewer of its values
/// where it is smooth.
///
/// A part of the places is answered by the polynomial through seven of them when it meets
/// the function at six places between; else it is halved, and short parts are computed
/// place by place. Where a kink is, parts become short. What happens between two places
/// that are computed is seen only where parts are narrower than it.
template <std::size_t M>
class SmoothSamples {
 public:
  using Value = std::array<double, M>;

  /// @param x        ascending
  /// @param widest   of a part, in units of x
  /// @param allowed  error allowed in each component
  /// @param out      shape (x)
  SmoothSamples(std::span<const double> x, double widest, const Value& allowed,
                std::span<Value> out)
      : x_(x), widest_(widest), allowed_(allowed), out_(out), known_(x.size(), false) {}

  /// @param f  callable as f(x), gives a Value
  template <class Function>
  void fill(const Function& f) {
    if (!x_.empty()) fill(0, x_.size() - 1, f);
  }

 private:
  static constexpr std::size_t nodes = 7;
  static constexpr std::size_t short_part = 24;
  using Places = std::array<std::size_t, nodes>;

  template <class Function>
  const Value& value(std::size_t i, const Function& f) {
    if (!known_[i]) {
      out_[i] = f(x_[i]);
      known_[i] = true;
    }
    return out_[i];
  }

  /// @param last  of the part, itself a place of it
  template <class Function>
  void fill(std::size_t first, std::size_t last, const Function& f) {
    if (last - first < short_part) {
      for (std::size_t i = first; i <= last; ++i) value(i, f);
      return;
    }
    if (x_[last] - x_[first] > widest_ || !fits(first, last, f)) {
      const std::size_t middle = (first + last) / 2;
      fill(first, middle, f);
      fill(middle + 1, last, f);
    }
  }

  /// @return whether the polynomial does, and has filled what was not known
  template <class Function>
  bool fits(std::size_t first, std::size_t last, const Function& f) {
    Places at;
    for (std::size_t k = 0; k < nodes; ++k) {
      constexpr std::array<double, nodes> lobatto = {
          // (1 - cos(pi k / 6)) / 2
          0, 0.066987298107780677, 0.25, 0.5, 0.75, 0.93301270189221932, 1};
      at[k] = first + static_cast<std::size_t>(
                          std::lround(lobatto[k] * static_cast<double>(last - first)));
    }
    for (const std::size_t i : at) value(i, f);
    const std::array<double, nodes> weights = barycentric(at);
    for (std::size_t k = 0; k + 1 < nodes; ++k) {
      const std::size_t i = (at[k] + at[k + 1]) / 2;
      const Value told = between(at, weights, x_[i]);
      const Value& true_value = value(i, f);
      for (std::size_t q = 0; q < M; ++q) {
        if (!(std::abs(told[q] - true_value[q]) <= allowed_[q])) return false;
      }
    }
    for (std::size_t i = first; i <= last; ++i) {
      if (!known_[i]) out_[i] = between(at, weights, x_[i]);
    }
    return true;
  }

  std::array<double, nodes> barycentric(const Places& at) const {
    const double length = x_[at.back()] - x_[at.front()];
    std::array<double, nodes> weights;
    for (std::size_t k = 0; k < nodes; ++k) {
      double product = 1.0;
      for (std::size_t j = 0; j < nodes; ++j) {
        if (j != k) product *= (x_[at[k]] - x_[at[j]]) / length;
      }
      weights[k] = 1 / product;
    }
    return weights;
  }

  /// @pre x is none of the nodes
  Value between(const Places& at, const std::array<double, nodes>& weights,
                double x) const {
    Value sum{};
    double all = 0.0;
    for (std::size_t k = 0; k < nodes; ++k) {
      const double w = weights[k] / (x - x_[at[k]]);
      all += w;
      for (std::size_t q = 0; q < M; ++q) sum[q] += w * out_[at[k]][q];
    }
    for (double& s : sum) s /= all;
    return sum;
  }

  std::span<const double> x_;
  double widest_;
  Value allowed_;
  std::span<Value> out_;
  std::vector<bool> known_;
};

/// @brief The same, place by place where the places do not ascend.
template <std::size_t M, class Function>
void sample_smooth(std::span<const double> x, double widest,
                   const std::array<double, M>& allowed, const Function& f,
                   std::span<std::array<double, M>> out) {
  const auto descends = [](double a, double b) { return !(a < b); };
  if (std::ranges::adjacent_find(x, descends) != x.end()) {
    std::ranges::transform(x, out.begin(), f);
    return;
  }
  SmoothSamples<M>(x, widest, allowed, out).fill(f);
}

}  // namespace trochoid::numerics
