#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/chip/volume.h>
#include <trochoid/force/setup.h>

#include <span>
#include <vector>

namespace trochoid::force {

/// @brief The teeth of a setup at one height, ready for the chip.
class Slice {
 public:
  /// @param height  above the tool tip [m]
  Slice(const Setup& setup, double height);

  [[nodiscard]] chip::Slice teeth() const noexcept {
    chip::Slice slice{r_, teeth_};
    slice.arcs = arcs_;
    return slice;
  }
  [[nodiscard]] const chip::Passage& passage() const noexcept { return passage_; }
  /// Uncut chip thickness [m] at a nominal theta; 0 where not in cut.
  [[nodiscard]] double chip_thickness(std::size_t tooth, double theta) const noexcept;

 private:
  chip::Passage passage_;
  double r_ = 0.0;
  std::vector<geometry::EdgePosition> teeth_;
  std::vector<geometry::EngagedArc> arcs_;
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

/// @brief From a little before to a little after the front of the tool, in half degrees.
ChipCurve chip_curve(const Setup& setup, double height);

/// Chips of every tooth at given angles and heights.
struct ChipGrid {
  std::vector<double> theta;   ///< nominal [rad]
  std::vector<double> height;  ///< [m]
  std::vector<double> h;       ///< [m], shape (teeth, angles, heights)
};

ChipGrid chip_grid(const Setup& setup, std::span<const double> theta,
                   std::span<const double> heights);

}  // namespace trochoid::force
