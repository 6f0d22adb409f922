#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/files/file_ref.h>
#include <trochoid/files/surface_frame.h>

#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::files {

/// Which measured surface is meant, and what its file need not say.
struct SurfaceSource {
  FileRef file;
  std::optional<LengthUnit> unit = {};  ///< of columns that name none
  std::optional<double> height = {};  ///< above the tip, of a trace along the feed [m]
  std::optional<SurfaceFrame> frame = {};  ///< of coordinates X, Y, Z, or of a map
};

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
SurfaceFile read_surface_file(const SurfaceSource& source, int teeth = 0);

/// @brief The same from an open stream, which can be set back.
/// @param source  its `file` names the stream in messages
SurfaceFile read_surface_file(std::istream& in, const SurfaceSource& source,
                              int teeth = 0);

/// @brief Only the readings of read_surface_file.
std::vector<SurfaceReading> read_surface(const SurfaceSource& source, int teeth = 0);

/// @brief The same from an open stream.
/// @param name  of the file, for messages
std::vector<SurfaceReading> read_surface(std::istream& in, const std::string& name,
                                         int teeth = 0);

}  // namespace trochoid::files
