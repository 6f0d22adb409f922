#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/chip/teeth_at_height.h>
#include <trochoid/chip/volume.h>
#include <trochoid/force/setup.h>

#include <memory>
#include <span>
#include <vector>

namespace trochoid::force {

/// @brief The teeth of a setup at one height, ready for the chip.
class Slice {
 public:
  /// @param height  above the tool tip [m]
  Slice(const Setup& setup, double height);

  /// Uncut chip thickness [m] at a nominal theta; 0 where not in cut.
  [[nodiscard]] double chip_thickness(std::size_t tooth, double theta) const noexcept;
  /// @brief Which mark reaches farthest out there: m teeth before; 0 where not in cut.
  [[nodiscard]] int mark(std::size_t tooth, double theta) const noexcept;
  [[nodiscard]] std::vector<chip::Arc> engaged_arcs(std::size_t tooth) const;
  [[nodiscard]] std::vector<chip::ChipPiece> engaged_pieces(std::size_t tooth) const;
  [[nodiscard]] chip::Removal removal() const;
  [[nodiscard]] std::size_t teeth() const noexcept { return own_->teeth.teeth(); }
  [[nodiscard]] const geometry::EdgeAt& edge(std::size_t tooth) const noexcept {
    return own_->teeth.edge(tooth);
  }

 private:
  /// Each tooth with its own edge; a slice of alike teeth has them for marks only.
  struct Own {
    geometry::ToothEdges edges;
    chip::TeethAtHeight teeth;
    Own(const Setup& setup, const chip::Passage& passage, double height);
  };
  [[nodiscard]] chip::Slice alike() const noexcept {
    chip::Slice slice{r_, teeth_};
    slice.arcs = arcs_;
    return slice;
  }

  bool alike_ = true;
  chip::Passage passage_;
  double r_ = 0.0;
  std::vector<geometry::EdgePosition> teeth_;
  std::vector<geometry::EngagedArc> arcs_;
  std::shared_ptr<const Own> own_;
};

/// What one tooth does in a turn, at one height.
struct ToothEngagement {
  std::vector<chip::Arc> arcs;  ///< entry and exit angles, nominal theta [rad]
  double peak_chip = 0.0;       ///< [m]
};

/// What all of them do.
struct Engagement {
  double height = 0.0;  ///< above the tool tip [m]
  std::vector<ToothEngagement> teeth;
  chip::Removal removal;
};

/// @param height  above the tool tip [m]
Engagement engagement_at(const Setup& setup, double height);

/// Height at which a slice is worth looking at when nobody named one: the tip, or the
/// axial depth where the edge reaches the axis [m].
double representative_height(const Setup& setup);

/// Chips over nominal theta at one height.
struct ChipCurve {
  std::vector<double> theta;           ///< [rad]
  std::vector<std::vector<double>> h;  ///< [m], shape (teeth, angles)
};

/// @brief Teeth that cut less than a fiftieth of the thickest chip, from 0; none where no tooth
/// cuts.
std::vector<std::size_t> idle_teeth(const ChipCurve& curve);

/// @brief From a little before to a little after the front of the tool, in half degrees.
ChipCurve chip_curve(const Setup& setup, double height);

/// Chips of every tooth at given angles and heights.
struct ChipGrid {
  std::vector<double> theta;   ///< nominal [rad]
  std::vector<double> height;  ///< [m]
  std::vector<double> h;       ///< [m], shape (teeth, angles, heights)
  std::vector<int> mark;       ///< as of Slice, shape (teeth, angles, heights)
};

ChipGrid chip_grid(const Setup& setup, std::span<const double> theta,
                   std::span<const double> heights);

/// @brief Where the edges of all teeth are at given heights.
struct EdgeGrid {
  std::vector<double> height;           ///< [m]
  std::vector<geometry::EdgeAt> edges;  ///< shape (heights, teeth)
  std::vector<double> lowest;           ///< where each edge begins [m], shape (teeth)
};

/// @brief As the chip model has them: one that feels no runout has none.
EdgeGrid edge_grid(const Setup& setup, std::span<const double> heights);

}  // namespace trochoid::force
