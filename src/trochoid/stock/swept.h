#pragma once

#include <trochoid/geometry/arcs.h>
#include <trochoid/stock/initial.h>
#include <trochoid/stock/path.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace trochoid::stock {

/// @brief What the tools of a program leave of the stock: exact for flat cutters.
///
/// A cross-section at a height is the stock less a capsule or an annular sector for each
/// piece of the path, as far as its tip was below that height.
class Swept {
 public:
  /// @param radius  of each tool where walls stand [m], its longest tooth's, shape (tools);
  ///                0: it cuts nothing
  Swept(Path path, Initial initial, std::vector<double> radius);

  [[nodiscard]] const Path& path() const noexcept { return path_; }
  [[nodiscard]] const Initial& initial() const noexcept { return initial_; }
  [[nodiscard]] double radius(std::int16_t tool) const noexcept {
    return tool < 0 ? 0.0 : radius_[static_cast<std::size_t>(tool)];
  }
  /// Pieces that may come near a cutter whose axis is there, ascending.
  [[nodiscard]] std::span<const std::uint32_t> near(double x, double y) const noexcept;

 private:
  void fill();
  template <class Function>
  void for_each_cell(const Piece& piece, double reach, const Function& f) const;

  Path path_;
  Initial initial_;
  std::vector<double> radius_;
  std::array<double, 2> origin_{};
  double cell_ = 1.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> first_;  ///< shape (cells + 1)
  std::vector<std::uint32_t> pieces_;
};

/// A cutter somewhere on its way.
struct Place {
  Point tip{};                ///< [m]
  double direction = 0.0;     ///< of the feed from +x [rad]
  double turns = 0.0;         ///< what was swept up to then is gone
  std::uint32_t last = 0;     ///< pieces up to this one
  bool without_last = false;  ///< but for it
};

/// @brief What is swept near a cutter up to a moment, in the frame of the cutter.
///
/// Made once for a place, asked at several heights and radii.
class Surroundings {
 public:
  /// @param reach  largest radius that is asked for [m]
  Surroundings(const Swept& swept, const Place& place, double reach);

  /// @brief Heights above the tip at which the stock around may change, ascending, from the
  /// first to the last with stock; nothing: there is none.
  /// @param sublayers  of what a ramp, and of what a turn of a helix, rises
  [[nodiscard]] std::vector<double> heights(std::array<int, 2> sublayers) const;

  /// Heights above the tip of level floors, and of the top and bottom of the stock,
  /// ascending [m].
  [[nodiscard]] std::vector<double> levels() const;

  /// @brief Stock on the circle of a radius about the axis.
  /// @eq N-3  theta is in stock where it is in the stock of the start and farther than R_e
  ///          from every path swept
  /// @src derived
  /// @param height  above the tip [m]
  /// @return arcs of theta, `from` in [-90, 270) deg, ascending; a full circle is one
  [[nodiscard]] std::vector<geometry::EngagedArc> arcs(double height, double r) const;

 private:
  struct Near {
    const Piece* piece;
    double radius;    ///< R_e of its tool [m]
    double until;     ///< fraction swept
    double x0 = 0.0;  ///< start, or centre of an arc, in the frame of the cutter [m]
    double y0 = 0.0;
    double x1 = 0.0;  ///< end
    double y1 = 0.0;
    double start = 0.0;  ///< of an arc, angle of its start in this frame [rad]
  };
  class Search;

  const Swept& swept_;
  Place place_;
  double reach_;
  double cosine_, sine_;
  std::vector<Near> near_;
};

/// @brief Volume that all moves together take from the stock, by scan lines [m^3].
/// @eq N-9  V = sum over heights (Gauss) and y (midpoints) of the length swept along x
/// @src derived
/// @param step  from line to line [m]
double volume_removed(const Swept& swept, double step);

}  // namespace trochoid::stock
