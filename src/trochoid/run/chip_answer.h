#pragma once

#include <trochoid/base/table.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/chip/volume.h>
#include <trochoid/force/setup.h>

#include <span>
#include <vector>

namespace trochoid::run {

/// What one tooth does in a turn, at one height.
struct ToothEngagement {
  std::vector<chip::Arc> arcs;  ///< nominal theta [rad]
  double peak_chip = 0.0;       ///< [m]
};

/// The cutter as one slice of it cuts.
struct SliceAnswer {
  std::vector<ToothEngagement> teeth;
  chip::Removal removal;
};

/// @param height  above the tool tip [m]
SliceAnswer slice_answer(const force::Setup& setup, double height);

/// @brief chip.csv: h of every tooth at the angles and heights.
base::Table chip_table(const force::Setup& setup, std::span<const double> edge_angles,
                       std::span<const double> heights);

/// @brief chip_curve.csv: h of every tooth over nominal theta, at one height.
base::Table chip_curve(const force::Setup& setup, double height);

/// Height at which a slice is worth looking at when nobody named one: the tip, or the
/// axial depth where the edge reaches the axis.
double default_height(const force::Setup& setup);

}  // namespace trochoid::run
