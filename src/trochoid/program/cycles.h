#pragma once

#include <trochoid/program/codes.h>
#include <trochoid/program/move.h>

#include <array>
#include <vector>

namespace trochoid::program {

/// @brief A hole that a drilling cycle makes.
struct Hole {
  Action kind = Action::drill;  ///< drill, drill_dwell, peck, chip_break
  std::array<double, 2> at{};   ///< [m]
  double r_level = 0.0;         ///< from where it is fed [m]
  double bottom = 0.0;          ///< [m]
  double clear = 0.0;           ///< where it ends [m]
  double peck = 0.0;            ///< depth of the first one [m]
  double less = 0.0;            ///< by which each next one is smaller [m]
  double least = 0.0;           ///< depth of the smallest [m]
  double dwell = 0.0;           ///< at the bottom [s]
};

/// A part of a cycle.
struct Leg {
  MoveKind kind = MoveKind::rapid;  ///< rapid, line, dwell
  std::array<double, 3> end{};      ///< [m]
  double time = 0.0;                ///< of a dwell [s]
};

/// @brief Pecks of a hole; 1 where it has none.
double pecks_of(const Hole& hole) noexcept;

/// @brief The moves of a hole, as LinuxCNC makes them.
///
/// From below the R level one rapid goes to (X, Y, R). After each peck the tool goes back to
/// the R level (G83) or by 0.254 mm (G73), and comes to within 0.254 mm of the last depth.
/// @param place  where the tool is [m]
/// @param legs   behind those there are
void drill(const Hole& hole, std::array<double, 3> place, std::vector<Leg>& legs);

}  // namespace trochoid::program
