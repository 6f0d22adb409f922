#pragma once

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

}  // namespace trochoid::surface
