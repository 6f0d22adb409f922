#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/measured_wall.h>
#include <trochoid/surface/find_runout.h>

#include <vector>

namespace trochoid::run {

/// @brief What an engineer should know before trusting a calibration.
void add_calibration_warnings(const inputs::Case& given, const MeasuredWall& wall,
                              const surface::ModelFits& calibration,
                              const surface::RunoutFit& runout,
                              std::vector<base::Warning>& warnings);

}  // namespace trochoid::run
