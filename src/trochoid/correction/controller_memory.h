#pragma once

#include <trochoid/correction/controller.h>

/// What the parts of the controller share; not for hosts.
namespace trochoid::correction {

/// False for NaN.
inline bool within(double value, double low, double high) {
  return value >= low && value <= high;
}

/// @brief Whether settings and state are still what a controller may have; the table is
/// looked at where it is used.
///
/// A state that is not is set back to rest: what is known of the place of the actuator is
/// kept. Settings that are not leave the controller not ready.
bool repair_memory(TrochoidController& c);

}  // namespace trochoid::correction
