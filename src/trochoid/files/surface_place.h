#pragma once

#include <trochoid/files/surface_file.h>

#include <optional>
#include <string>

/// From coordinates and deviations to a place on the wall and an error.
namespace trochoid::files {

/// What a row says of its error [m].
struct SurfaceValues {
  std::optional<double> error, actual, nominal;
};

/// @brief The deviation, else measured less nominal; none: neither is there.
std::optional<double> error_of(const SurfaceValues& values);

/// @brief Set x, height and error by coordinates.
///
/// The error is that of the values, if they tell it; else the coordinate along the normal,
/// from the nominal value if there is one, from the origin of the frame if not.
/// @param frame  checked: unit vectors at right angles
/// @param point  in the coordinates of the file [m]
void place_in_frame(const SurfaceFrame& frame, const Direction& point,
                    const SurfaceValues& values, SurfaceReading& reading);

/// @brief A length for a message.
std::string in_mm(double length);

}  // namespace trochoid::files
