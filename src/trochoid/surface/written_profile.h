#pragma once

#include <trochoid/surface/roughness.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace trochoid::surface {

/// @brief A pass of a tooth along a profile: one of the curves of which the lowest counts.
struct ProfilePass {
  int tooth = 0;  ///< 0-based
  int turn = 0;   ///< of the spindle
  bool rear = false;
};

/// Where a pass is at a place.
struct PassPoint {
  double height = 0.0;  ///< [m]; infinite where it does not reach
  int part = 0;         ///< of the edge that writes: smooth while it stays the same
};

/// @brief The lowest of all passes over one period.
///
/// The first look takes even steps. Between two places that different passes, or parts of
/// an edge, have written, the change is found by halving, and whoever is lowest between them.
/// @param at  where a pass is at x
PeriodicProfile written_profile(
    double period, std::vector<ProfilePass> passes,
    const std::function<PassPoint(const ProfilePass&, double x)>& at);

}  // namespace trochoid::surface
