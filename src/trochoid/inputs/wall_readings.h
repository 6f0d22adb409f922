#pragma once

#include <trochoid/inputs/case.h>

#include <string>
#include <vector>

/// Readings of a wall against the cut of their case.
namespace trochoid::inputs {

/// @brief A measurement of a case, with all that is wrong with it there (see
/// check_readings); of a map the points inside the cut.
/// @throws base::InputError
SurfaceFile read_surface_of(const Case& given, const SurfaceMeasurement& measurement);

/// @brief What is wrong with readings at the places where they were taken: heights
/// outside the cut, and, unless the surface is quasi_static, x outside the wall.
/// @return finished lines `file:line:col: ...`
std::vector<std::string> check_readings(const std::vector<SurfaceReading>& readings,
                                        const std::string& file, const Case& given);

/// @brief The same; names the unit in which all of them would fit, if there is one.
std::vector<std::string> check_readings(const SurfaceFile& surface,
                                        const std::string& file, const Case& given);

}  // namespace trochoid::inputs
