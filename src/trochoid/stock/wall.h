#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace trochoid::stock {

/// @brief The wall that a tool leaves: its radius over the height above its tip.
///
/// It never narrows upwards: what stands above a part of the tool that has passed is gone.
/// A radius of 0 cuts nothing.
class Wall {
 public:
  Wall() = default;
  /// @brief Of a flat cutter: the same radius at all heights.
  /// @param radius  [m]
  static Wall upright(double radius);

  /// @brief Of any cutter.
  /// @param ends    heights between which the radius is smooth but for a root at the lower
  ///                end, ascending [m], at least 2; above the last one it stays
  /// @param radius  at a height [m]
  Wall(std::span<const double> ends, const std::function<double(double)>& radius);

  [[nodiscard]] bool is_upright() const noexcept { return pieces_.empty(); }
  [[nodiscard]] double largest() const noexcept { return largest_; }  ///< [m]
  /// Height above the tip at which it begins [m].
  [[nodiscard]] double lowest() const noexcept { return lowest_; }
  /// Height from which on it has its largest radius [m].
  [[nodiscard]] double highest() const noexcept { return highest_; }

  /// Radius and its slope dr/dz at a height.
  struct At {
    double radius = 0.0;  ///< [m]; 0 below the lowest height
    double slope = 0.0;
  };
  [[nodiscard]] At at(double height) const noexcept;
  [[nodiscard]] double radius(double height) const noexcept {
    return at(height).radius;
  }
  /// @brief Lowest height at which it reaches a radius [m]; infinite: it never does.
  [[nodiscard]] double height_at(double radius) const noexcept;

 private:
  [[nodiscard]] double find_height(double radius) const noexcept;
  /// The radius over t = sqrt of the part of a piece below a height, at equal steps of t.
  struct Piece {
    double from = 0.0;
    double to = 0.0;
    std::size_t first = 0;  ///< of its values
  };
  std::vector<Piece> pieces_;
  std::vector<double> values_;
  /// The height over the angle s at equal steps, radius = largest sin(s): smooth for balls.
  std::vector<double> heights_;
  double lowest_ = 0.0;
  double highest_ = 0.0;
  double largest_ = 0.0;
};

}  // namespace trochoid::stock
