#pragma once

#include <span>
#include <vector>

namespace trochoid::numerics {

/// @brief Interpolation in Chebyshev points of the first kind on an interval.
class LagrangeBasis {
 public:
  /// @param count  points, at least 1
  LagrangeBasis(double from, double to, int count);

  /// Where the values are taken, ascending, shape (count).
  [[nodiscard]] const std::vector<double>& points() const noexcept { return points_; }
  [[nodiscard]] std::size_t size() const noexcept { return points_.size(); }

  /// @brief The values at x of the polynomials that are 1 in one point and 0 in the
  /// others; also a little outside of the interval.
  /// @param[out] out  shape (count)
  void weights(double x, std::span<double> out) const noexcept;

  /// @brief The polynomial through the values.
  /// @param values  at the points, shape (count)
  [[nodiscard]] double value(std::span<const double> values, double x) const noexcept;

  /// @brief The same as a Chebyshev series, which is faster to evaluate.
  /// @param[out] out  shape (count)
  void series(std::span<const double> values, std::span<double> out) const noexcept;
  /// @brief Value of a series at x.
  [[nodiscard]] double series_value(std::span<const double> series,
                                    double x) const noexcept {
    const double t = (x - middle_) * per_half_;
    double next = 0.0;
    double after = 0.0;
    for (std::size_t k = series.size(); k-- > 1;) {
      const double b = series[k] + 2 * t * next - after;
      after = next;
      next = b;
    }
    return series[0] + t * next - after;
  }

 private:
  std::vector<double> to_series_;  ///< shape (count, count)
  double middle_ = 0.0;
  double per_half_ = 0.0;
  std::vector<double> points_;
  std::vector<double> barycentric_;
};

}  // namespace trochoid::numerics
