#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/surface/datum.h>
#include <trochoid/surface/readings.h>

#include <vector>

namespace trochoid::run {

/// All [[surface_measurement]] of a case, as the room surface takes them.
struct MeasuredWall {
  std::vector<surface::Reading> readings;
  std::vector<surface::Datum> datum;  ///< of each file
};

/// @throws base::InputError with the problems of all files
MeasuredWall measured_wall(const inputs::Case& given);

}  // namespace trochoid::run
