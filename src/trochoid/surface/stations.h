#pragma once

#include <trochoid/numerics/lagrange.h>
#include <trochoid/surface/bodies.h>

#include <array>
#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief Just below a height, there, and just above it: for slopes over the height.
std::array<double, 3> heights_around(double height, double a_p);

/// @brief The compliance at some heights, anywhere along a stretch of the wall.
///
/// A wall is solved where the readings are; where these are many,
/// at Chebyshev points along the stretch, more on a longer one,
/// and what follows is interpolated between them.
class Stations {
 public:
  /// @param x        where the cutter comes along the wall [m], not empty
  /// @param heights  above the tip, in any order [m]
  Stations(const BodiesAt& bodies, std::span<const double> x,
           std::span<const double> heights, double a_p, Load load);

  /// Moments of the force refer to these points.
  [[nodiscard]] const numerics::LagrangeBasis& basis() const noexcept {
    return compliances_.front().basis();
  }
  [[nodiscard]] std::size_t count() const noexcept { return x_.size(); }
  /// @brief Number of a height that was asked for at the start.
  /// @throws std::out_of_range for any other
  [[nodiscard]] std::size_t height_index(double height) const;
  [[nodiscard]] const Compliance& compliance(std::size_t station) const {
    return compliances_[station];
  }
  /// @brief G_q of a height, by its number, at a station [m/N], shape (basis points).
  [[nodiscard]] std::span<const double> row(std::size_t station,
                                            std::size_t height) const {
    const std::size_t points = basis().size();
    return std::span(rows_[station]).subspan(height * points, points);
  }
  /// @brief What the stations count for at x, shape (count()); mostly zeros where few.
  [[nodiscard]] std::vector<double> weights(double x) const;

 private:
  std::vector<double> x_;
  bool interpolated_ = false;
  std::vector<double> heights_;  ///< ascending [m]
  numerics::LagrangeBasis along_;
  std::vector<Compliance> compliances_;
  std::vector<std::vector<double>> rows_;  ///< shape (stations)(heights, points)
};

}  // namespace trochoid::surface
