#pragma once

#include <trochoid/numerics/lagrange.h>
#include <trochoid/surface/bodies.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::surface {

/// What a few neighbouring nodes count for at a height.
struct HeightShare {
  std::size_t first = 0;  ///< node
  std::size_t count = 1;  ///< of nodes from there on, at most 4
  std::array<double, 4> weights = {1.0, 0.0, 0.0, 0.0};
};

/// @brief Heights at which a model is computed, and what lies between them.
///
/// Few heights are nodes themselves. Where a scan has as many heights as readings, the
/// nodes are spread evenly, and a cubic through the nearest four leads from them to
/// any height.
///
/// @eq E-18 e(h) = sum over four nodes of e(h_k) prod over l != k of
///          (h - h_l)/(h_k - h_l)
/// @src derived: Lagrange's formula; between nodes w apart a kink where the slope jumps
///      by s is met to s w/10
class HeightGrid {
 public:
  /// @param heights  above the tip, in any order, not empty [m]
  explicit HeightGrid(std::span<const double> heights);

  /// Ascending [m].
  [[nodiscard]] const std::vector<double>& nodes() const noexcept { return nodes_; }
  /// Are the nodes all heights there are?
  [[nodiscard]] bool exact() const noexcept { return exact_; }

  /// @param height  one of those given, or between them [m]
  [[nodiscard]] HeightShare at(double height) const noexcept;

 private:
  std::vector<double> nodes_;
  bool exact_ = true;
};

/// @brief Just below a height, there, and just above it: for slopes over the height.
std::array<double, 3> heights_around(double height, double a_p);

/// How the wall is loaded, and how closely it is looked at.
struct LoadedWall {
  double a_p = 0.0;  ///< axial depth [m]
  Load load = Load::distributed;
  std::size_t most_stations = 12;  ///< along a stretch
};

/// Which of heights_around.
enum class Level : std::size_t { below = 0, there = 1, above = 2 };

/// @brief The compliance at some heights, anywhere along a stretch of the wall.
///
/// A wall is solved where the readings are; where these are many,
/// at Chebyshev points along the stretch, more on a longer one,
/// and what follows is interpolated between them. The same holds of the heights.
class Stations {
 public:
  /// @param x        where the cutter comes along the wall [m], not empty
  /// @param heights  above the tip, in any order [m]
  Stations(const BodiesAt& bodies, std::span<const double> x,
           std::span<const double> heights, const LoadedWall& loaded);

  /// Moments of the force refer to these points.
  [[nodiscard]] const numerics::LagrangeBasis& basis() const noexcept {
    return compliances_.front().basis();
  }
  [[nodiscard]] std::size_t count() const noexcept { return x_.size(); }
  [[nodiscard]] const HeightGrid& grid() const noexcept { return grid_; }
  /// Height of a node of the grid, or just below or above it [m].
  [[nodiscard]] double height(std::size_t node, Level level) const noexcept {
    return heights_[node * levels + static_cast<std::size_t>(level)];
  }
  [[nodiscard]] const Compliance& compliance(std::size_t station) const {
    return compliances_[station];
  }
  /// @brief G_q at a node of the grid at a station [m/N], shape (basis points).
  [[nodiscard]] std::span<const double> row(std::size_t station, std::size_t node,
                                            Level level = Level::there) const {
    const std::size_t points = basis().size();
    const std::size_t height = node * levels + static_cast<std::size_t>(level);
    return std::span(rows_[station]).subspan(height * points, points);
  }
  /// Largest size of G_q anywhere [m/N], shape (basis points).
  [[nodiscard]] std::span<const double> largest() const noexcept { return largest_; }
  /// @brief What the stations count for at x; mostly zeros where they are few.
  /// @param[out] out  shape (count())
  void weights(double x, std::span<double> out) const noexcept;
  [[nodiscard]] std::vector<double> weights(double x) const {
    std::vector<double> out(count());
    weights(x, out);
    return out;
  }

 private:
  static constexpr std::size_t levels = 3;

  std::vector<double> x_;
  bool interpolated_ = false;
  HeightGrid grid_;
  std::vector<double> heights_;  ///< around the nodes [m], shape (nodes, levels)
  numerics::LagrangeBasis along_;
  std::vector<Compliance> compliances_;
  std::vector<double> largest_;
  std::vector<std::vector<double>> rows_;  ///< shape (stations)(nodes, levels, points)
};

}  // namespace trochoid::surface
