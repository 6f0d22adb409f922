#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/dynamics/point_response.h>
#include <trochoid/dynamics/system.h>
#include <trochoid/inputs/case.h>

#include <string>
#include <vector>

namespace trochoid::run {

/// What [[measured_frf]] says: the response itself, and modes fitted to it.
struct ToolPoint {
  dynamics::PointResponse response;
  /// How much the lines scatter [m/N], of each part of the response.
  std::vector<double> noise;
  dynamics::System
      modes;             ///< of the direct responses; empty where none were looked for
  std::string no_modes;  ///< why none were found; empty: they were
};

/// @brief Reads the responses, and fits modes to them where the case has none.
///
/// A cross response that is given in one of its two directions serves for both.
/// @param[out] warnings  what a reader of the answer should know of the measurement
/// @throws base::InputError for files that cannot be read, too few lines, and a sensor
///         that points against the force
ToolPoint tool_point(const inputs::Case& given, std::vector<base::Warning>& warnings);

/// @brief What a measured response cannot say about a chatter frequency.
/// @param chatter  [rad/s]
/// @param step     from one harmonic to the next [rad/s]
void warn_of_response(const ToolPoint& point, double chatter, double step,
                      std::vector<base::Warning>& warnings);

}  // namespace trochoid::run
