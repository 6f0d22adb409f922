#pragma once

#include <math.h>
#include <stdint.h>

struct TrochoidController;  // of controller.h, which includes nothing of this

/// What the parts of the controller share; not for hosts.
namespace trochoid::correction {

/// False for NaN.
inline bool within(double value, double low, double high) {
  return value >= low && value <= high;
}

inline double clamped(double value, double low, double high) {
  return value > low ? (value < high ? value : high) : low;
}

/// Of turns, into [0, 1).
inline double fraction(double turns) {
  const double rest = turns - floor(turns);
  return rest < 1.0 ? rest : 0.0;
}

// Inputs that no machine gives, and what a count may reach.
constexpr int32_t most_counted = 1000000;
constexpr double largest_gap = 0.1;  // [rev] between samples
constexpr double backwards = 0.02;   // [rev] that quantisation may take back
constexpr double most_turns = 1e9;   // [rev]: beyond, the fraction is lost
constexpr double most_force = 1e9;   // [N]

/// @brief Whether settings and state are still what a controller may have; the table is
/// looked at where it is used.
///
/// A state that is not is set back to rest: what is known of the place of the actuator is
/// kept. Settings that are not leave the controller not ready.
bool repair_memory(TrochoidController& c);

}  // namespace trochoid::correction
