#pragma once

#include <trochoid/geometry/arcs.h>
#include <trochoid/stock/chains.h>
#include <trochoid/stock/height_map.h>
#include <trochoid/stock/initial.h>
#include <trochoid/stock/path.h>
#include <trochoid/stock/short_parts.h>
#include <trochoid/stock/slice_part.h>
#include <trochoid/stock/wall.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace trochoid::stock {

/// A cutter somewhere on its way.
struct Place {
  Point tip{};                ///< [m]
  double direction = 0.0;     ///< of the feed from +x [rad]
  double turns = 0.0;         ///< what was swept up to then is gone
  std::uint32_t last = 0;     ///< pieces up to this one
  bool without_last = false;  ///< but for it
};

/// What may bound the stock near a place, each ascending.
struct Nearby {
  std::vector<std::uint32_t> pieces;  ///< one by one
  std::vector<std::uint32_t> chains;  ///< whole
};

/// @brief What the tools of a program leave of the stock, without a grid.
///
/// A cross-section at a height is the stock less a capsule or an annular sector for each
/// piece of the path, as far as its tip was below that height. On a slope of a tool that is
/// not flat the disc grows along the capsule.
class Swept {
 public:
  /// @param walls  of each tool, its longest tooth's, shape (tools)
  Swept(Path path, Initial initial, std::vector<Wall> walls);

  [[nodiscard]] const Path& path() const noexcept { return path_; }
  [[nodiscard]] const Initial& initial() const noexcept { return initial_; }
  [[nodiscard]] const Wall& wall(std::int16_t tool) const noexcept {
    return tool < 0 ? nothing_ : walls_[static_cast<std::size_t>(tool)];
  }
  /// Largest radius of a tool where walls stand [m]; 0: it cuts nothing.
  [[nodiscard]] double radius(std::int16_t tool) const noexcept {
    return wall(tool).largest();
  }
  /// @brief What bounds the stock near a cutter, and perhaps more.
  /// @param reach  of the cutter [m]
  [[nodiscard]] Nearby near(const Place& place, double reach) const;
  [[nodiscard]] const std::vector<Chain>& chains() const noexcept { return chains_; }

  /// Whether all tools leave upright walls: then all pieces near a place are looked at.
  [[nodiscard]] bool all_flat() const noexcept { return all_flat_; }

  /// @brief Whether so many pieces pass the same places that looking at all of them is slow.
  [[nodiscard]] bool crowded() const noexcept;

  /// @brief Keep a map of heights: with it `near` names few pieces of a path that passes a
  /// place many times, unless all tools are flat and it is not crowded.
  /// @param cell  of the map [m]
  void keep_map(double cell);
  /// @brief Bring the map, if one is kept, up to a moment.
  ///
  /// What is asked of earlier moments afterwards is answered without it.
  void sweep_to(double turns);
  /// The map, if one is kept.
  [[nodiscard]] const HeightMap* map() const noexcept {
    return map_ ? &*map_ : nullptr;
  }

 private:
  void fill();
  void index_chains(double largest);
  [[nodiscard]] std::span<const std::uint32_t> in_cell(double x,
                                                       double y) const noexcept;
  template <class Function>
  void for_each_cell(const Piece& piece, double reach, const Function& f) const;

  Path path_;
  Initial initial_;
  std::vector<Wall> walls_;
  Wall nothing_;
  bool all_flat_ = true;
  std::array<double, 2> origin_{};
  double cell_ = 1.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> first_;     ///< shape (cells + 1)
  std::vector<std::uint32_t> in_cells_;  ///< chains
  std::size_t indexed_ =
      0;  ///< pieces in all cells together that are not hidden at last
  std::vector<Chain> chains_;
  std::size_t used_ = 0;  ///< cells of the index with a piece
  std::optional<HeightMap> map_;
  std::uint32_t mapped_ = 0;  ///< how many pieces are in the map
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
    const Wall* wall;
    double radius = 0.0;          ///< of the path; 0: straight [m]
    double turn = 0.0;            ///< of an arc [rad]
    double until = 1.0;           ///< fraction swept
    std::array<double, 2> tip{};  ///< at its ends, above that of the cutter [m]
    SlicePoint from{};            ///< start, or centre of an arc [m]
    SlicePoint to{};              ///< end [m]
    double start = 0.0;           ///< of an arc, angle of its start in this frame [rad]
    bool upright = false;

    /// Lowest and highest tip of what is swept.
    [[nodiscard]] std::pair<double, double> tips() const noexcept {
      return std::minmax({tip[0], tip[0] + until * (tip[1] - tip[0])});
    }
  };
  [[nodiscard]] SlicePoint local(double x, double y) const noexcept;
  [[nodiscard]] bool is_far(const Near& near) const noexcept;
  void add_piece(std::uint32_t index);
  void add_chain(std::uint32_t index);
  [[nodiscard]] std::optional<Near> near_of(const Piece& piece, const Wall& wall,
                                            double until) const;
  void add_chords(const Piece& piece, const Wall& wall, double until);
  class Search;

  const Swept& swept_;
  Place place_;
  double reach_;
  double cosine_, sine_;
  std::vector<Near> near_;
  std::vector<NearChain> chains_;
};

/// @brief Volume that all moves together take from the stock, by scan lines [m^3]; with a map
/// of heights what it has lost so far.
/// @eq N-9  V = sum over heights (Gauss) and y (midpoints) of the length swept along x
/// @src derived
/// @param step  from line to line [m]
double volume_removed(const Swept& swept, double step);

}  // namespace trochoid::stock
