#pragma once

#include <trochoid/cases/case.h>

#include <optional>
#include <string>
#include <vector>

/// Readings of a wall against the cut of their case.
namespace trochoid::cases {

/// Where readings of the wall of a case may lie.
struct WallLimits {
  double height = 0.0;             ///< from 0 to this [m]
  std::optional<double> length{};  ///< x from 0 to this [m]; none: anywhere
  int teeth = 0;                   ///< of the cutter
};

WallLimits wall_of(const Case& given);

/// @brief A measured surface, with all that is wrong with it there (see check_readings);
/// of a map the points inside the cut.
/// @throws base::InputError
files::SurfaceFile read_wall(const files::SurfaceSource& source,
                             const WallLimits& limits);

/// @brief What is wrong with readings at the places where they were taken: heights
/// outside the cut, and, unless the surface is quasi_static, x outside the wall; names the
/// unit in which all of them would fit, if there is one.
/// @return finished lines `file:line:col: ...`
std::vector<std::string> check_readings(const files::SurfaceFile& surface,
                                        const std::string& file,
                                        const WallLimits& limits);

}  // namespace trochoid::cases
