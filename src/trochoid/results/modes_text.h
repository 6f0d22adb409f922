#pragma once

#include <trochoid/results/modes.h>

#include <string>
#include <string_view>

namespace trochoid::results {

/// The axis of a case nearest to a direction, and the angle from it.
struct NearAxis {
  std::string_view axis;
  double angle = 0.0;  ///< [deg]
};

NearAxis near_axis(const ModesResult& r, const structure::FittedMode& mode);

/// @brief The modes as a file that other cases include.
std::string modes_toml(const ModesResult& r);

/// @brief The modes and their fit for a person at a terminal.
std::string short_table(const ModesResult& r);

}  // namespace trochoid::results
