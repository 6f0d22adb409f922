#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/inputs/case.h>
#include <trochoid/inputs/surface_file.h>
#include <trochoid/surface/datum.h>
#include <trochoid/surface/readings.h>

#include <vector>

namespace trochoid::run {

/// All [[surface_measurement]] of a case, as the room surface takes them.
struct MeasuredWall {
  std::vector<surface::Reading> readings;
  std::vector<surface::Datum> datum;  ///< of each file
  inputs::SurfaceCounts counts;       ///< of all files
  std::vector<base::Warning> notes;   ///< what was left out or averaged, by file
};

/// @throws base::InputError with the problems of all files
MeasuredWall measured_wall(const inputs::Case& given);

}  // namespace trochoid::run
