#pragma once

#include <trochoid/base/warning.h>
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
  std::size_t line = 0;               ///< of the file; of a map the row
};

/// What became of the rows of a file, or of the points of a map.
struct SurfaceCounts {
  std::size_t skipped = 0;  ///< without a value, or outside the cut on a map
  std::size_t repeats = 0;  ///< further readings of a place, averaged with its first
  double squares = 0.0;  ///< sum of squares of repeated readings about their mean [m^2]

  /// Standard deviation of one reading by its repeats [m]; none: nothing was repeated.
  [[nodiscard]] std::optional<double> repeatability() const;
  /// Count the rows of another file as well.
  void add(const SurfaceCounts& other);
};

/// A measured surface as it was read.
struct SurfaceFile {
  std::vector<SurfaceReading> readings;  ///< one a place
  SurfaceCounts counts;
  std::vector<base::Warning> notes;  ///< what was skipped, and what was averaged
  bool map = false;                  ///< x3p or sdf
  bool framed = false;               ///< placed by the frame of the case
  std::string x_unit;                ///< as its column was read; empty: not known
  std::string height_unit;
};

/// @brief Read a measured surface into SI.
///
/// Text: a table after any other lines, its columns found by name, with their unit in it,
/// in a row below or in the case; coordinates are turned by the frame of the case. Rows
/// without a value are left out, repeated ones averaged; the notes say so. Binary: a map
/// in X3P or SDF. docs/formats/surface.md says what is understood.
/// @param teeth  of the cutter; 0: a tooth may have any number
/// @throws base::InputError with every problem of the file; reading stops after 1000
SurfaceFile read_surface_file(const SurfaceMeasurement& measurement, int teeth = 0);

/// @brief The same from an open stream, which can be set back.
/// @param measurement  its `file` names the stream in messages
SurfaceFile read_surface_file(std::istream& in, const SurfaceMeasurement& measurement,
                              int teeth = 0);

/// @brief Only the readings of read_surface_file.
std::vector<SurfaceReading> read_surface(const SurfaceMeasurement& measurement,
                                         int teeth = 0);

/// @brief The same from an open stream.
/// @param name  of the file, for messages
std::vector<SurfaceReading> read_surface(std::istream& in, const std::string& name,
                                         int teeth = 0);

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
