#pragma once

#include <trochoid/inputs/case.h>

#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::inputs {

/// One reading of a measuring machine, in SI.
struct SurfaceReading {
  std::optional<double> x;            ///< along the feed [m]
  std::optional<double> step;         ///< number of the reading along the feed
  std::optional<double> feed_offset;  ///< along the feed from x [m]
  double height = 0.0;                ///< above the tip [m]
  double error = 0.0;                 ///< positive: material left [m]
  int tooth = 0;                      ///< from 1; 0: not known
  std::size_t line = 0;               ///< of the file
};

/// @brief Read a measured surface (CSV) into SI.
///
/// Separators, decimals and comments are those of a force record. The columns are found
/// by name, with their unit in it or in a row below: `x` or `position`, or `step` or
/// `k`; `height` or `z`; `error` or `deviation`; perhaps `feed_offset` and `tooth`.
/// @param teeth  of the cutter; 0: a tooth may have any number
/// @throws base::InputError with every problem of the file; reading stops after 1000
std::vector<SurfaceReading> read_surface(const SurfaceMeasurement& measurement,
                                         int teeth = 0);

/// @brief The same from an open stream.
/// @param name  of the file, for messages
std::vector<SurfaceReading> read_surface(std::istream& in, const std::string& name,
                                         int teeth = 0);

/// @brief What is wrong with readings at the places where they were taken: heights
/// outside the cut, and, unless the surface is quasi_static, x outside the wall.
/// @return finished lines `file:line:col: ...`
std::vector<std::string> check_readings(const std::vector<SurfaceReading>& readings,
                                        const std::string& file, const Case& given);

}  // namespace trochoid::inputs
