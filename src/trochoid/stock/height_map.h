#pragma once

#include <trochoid/stock/initial.h>
#include <trochoid/stock/path.h>
#include <trochoid/stock/wall.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace trochoid::stock {

/// @brief Heights of what is left over a raster, and which piece of the path left each.
///
/// The pieces that it names near a place are those that bound the stock there: with them
/// cross-sections need no grid.
class HeightMap {
 public:
  /// No piece has been here.
  static constexpr std::uint32_t untouched = std::numeric_limits<std::uint32_t>::max();

  /// @param cell  from point to point [m], about; larger where there would be too many
  HeightMap(const Initial& initial, double cell);

  /// @brief Take away what a piece sweeps: all of it.
  void cut(const Piece& piece, std::uint32_t index, const Wall& wall);

  /// @brief Add the pieces that left the surface within a distance of a place, each once.
  void add_near(double x, double y, double reach,
                std::vector<std::uint32_t>& pieces) const;

  /// @brief Volume taken away so far [m^3].
  /// @param initial  the stock of the start
  [[nodiscard]] double removed(const Initial& initial) const noexcept;

 private:
  struct Range {
    int first = 0;
    int last = -1;
  };
  [[nodiscard]] Range range(double from, double to, std::size_t axis) const noexcept;
  [[nodiscard]] std::size_t at(int row, int column) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_[0]) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] Point center(int row, int column) const noexcept {
    return {origin_[0] + column * cell_[0], origin_[1] + row * cell_[1], 0.0};
  }
  void cut_arc(const Piece& piece, std::uint32_t index, const Wall& wall);

  double bottom_ = 0.0;
  double top_ = 0.0;
  std::array<double, 2> origin_{};  ///< of the first point [m]
  std::array<double, 2> cell_{};    ///< from point to point [m]
  std::array<int, 2> size_{};       ///< columns and rows
  std::vector<float> height_;       ///< [m]
  std::vector<std::uint32_t> piece_;
};

/// @brief Height that a tool leaves over a place as it passes along a straight piece.
/// @eq N-17 H(q) = min over u of z_tip(u) + z_e(|q - p(u)|), z_e the height at which the
///          wall of the tool reaches a radius: stock stands below H
/// @src derived
/// @return [m]; infinite: it does not come there
double height_left(const Piece& piece, const Wall& wall, double x, double y) noexcept;

}  // namespace trochoid::stock
