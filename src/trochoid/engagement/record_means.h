#pragma once

#include <trochoid/engagement/record.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace trochoid::engagement {

/// Time from sample to sample, on the average [s].
inline double sample_time(const Recorded& record) noexcept {
  const auto n = static_cast<double>(record.time.size());
  return n > 1 ? (record.time.back() - record.time.front()) / (n - 1) : 0.0;
}

/// Whether two speeds of the spindle take the same power in air.
inline bool is_same_speed(double a, double b) noexcept {
  constexpr double same = 0.005;
  return std::abs(a - b) <= same * a;
}

/// Means of a record over any of its stretches.
class Means {
 public:
  using Value = std::array<double, 3>;
  explicit Means(const Recorded& record) : record_(record) {
    sums_.resize(record.value.size() + 1);
    for (std::size_t i = 0; i < record.value.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        sums_[i + 1][c] = sums_[i][c] + record.value[i][c];
      }
    }
  }

  struct Samples {
    std::size_t from, to;
  };
  [[nodiscard]] Samples within(double from, double to) const noexcept {
    const auto& t = record_.time;
    const auto at = [&](double x) {
      return static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), x) -
                                      t.begin());
    };
    return {at(from), at(to)};
  }

  [[nodiscard]] Reads reads() const noexcept { return record_.reads; }
  [[nodiscard]] std::optional<Value> mean(double from, double to) const noexcept {
    const auto [a, b] = within(from, to);
    if (b <= a) return std::nullopt;
    Value out{};
    for (std::size_t c = 0; c < 3; ++c) {
      out[c] = (sums_[b][c] - sums_[a][c]) / static_cast<double>(b - a);
    }
    return out;
  }

 private:
  const Recorded& record_;
  std::vector<Value> sums_;
};

}  // namespace trochoid::engagement
