#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/inputs/case.h>
#include <trochoid/results/surface.h>
#include <trochoid/surface/calibrate.h>
#include <trochoid/surface/error_map.h>

#include <span>
#include <vector>

namespace trochoid::run {

/// @brief Warnings about what bends: a wall that bends by more than half its thickness,
/// and a chip that the deflection would change.
/// @param largest  error of the wall [m]
/// @param a_e      radial depth of the cut [m]
void add_bending_warnings(const inputs::Case& given, double largest, double a_e,
                          std::vector<base::Warning>& warnings);

/// @brief What an engineer should know before trusting a computed wall.
void add_surface_warnings(const inputs::Case& given, const results::SurfaceResult& r,
                          std::vector<base::Warning>& warnings);

/// @brief What an engineer should know before trusting a calibration.
void add_calibration_warnings(const inputs::Case& given,
                              std::span<const surface::Reading> readings,
                              const surface::Calibration& calibration,
                              std::vector<base::Warning>& warnings);

}  // namespace trochoid::run
