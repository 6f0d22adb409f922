#pragma once

#include <trochoid/dynamics/directional.h>

#include <cstddef>
#include <vector>

/// Where a period of cutting is cut up, so that all is smooth in each part.
namespace trochoid::dynamics {

/// A part of a period.
struct PeriodPart {
  double from = 0.0;      ///< spindle angle [rad]
  double to = 0.0;        ///< [rad]
  std::size_t whole = 0;  ///< the directional element that holds it
};

/// @brief One period in parts, ascending without gaps.
///
/// A switch of the forces leaves a kink in the motion, which comes back one delay later.
/// Where all delays are multiples of one pitch, every pitch can be cut up alike, wherever
/// any of them has a switch: kinks then come back at ends only, and nodes at nodes.
/// Where that makes too many parts, only long ones are cut where kinks come back.
struct PeriodParts {
  std::vector<PeriodPart> all;
  std::size_t pitches = 0;  ///< that are cut up alike; 0: they are not
};

/// @brief Degree of the polynomials of a part.
/// @param length  of the part [rad]
/// @param cycle   of the fastest mode [rad]
/// @param factor  of the number of nodes
int part_degree(double length, double cycle, double factor) noexcept;

/// @param cycle  of the fastest mode [rad]
PeriodParts period_parts(const Directional& directional, double cycle);

}  // namespace trochoid::dynamics
