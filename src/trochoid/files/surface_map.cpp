#include <trochoid/files/surface_map.h>

#include <trochoid/base/error.h>
#include <trochoid/files/numeric_table.h>
#include <trochoid/files/surface_place.h>

#include <fmt/core.h>

#include <cmath>

namespace trochoid::files {

namespace {

constexpr Direction along_x{1.0, 0.0, 0.0};
constexpr Direction along_y{0.0, 1.0, 0.0};
constexpr Direction along_z{0.0, 0.0, 1.0};

}  // namespace

std::string wrong_size(double columns, double rows) {
  if (!(columns >= 1 && rows >= 1) || columns != std::floor(columns) ||
      rows != std::floor(rows)) {
    return fmt::format(
        "the file states a map of {:g} x {:g} points: at least one each "
        "way is needed",
        columns, rows);
  }
  if (columns * rows > static_cast<double>(most_points)) {
    return fmt::format(
        "the map has {:.0f} x {:.0f} points: at most {} are read; export "
        "the part with the wall, or every second point",
        columns, rows, most_points);
  }
  return {};
}

SurfaceFile readings_of(const SurfaceMap& map, const SurfaceSource& source) {
  const SurfaceFrame frame =
      source.frame.value_or(SurfaceFrame{{0, 0, 0}, along_x, along_z, along_y});
  if (source.height && map.rows > 1) {
    refuse(
        source.file.path,
        "height_mm of the [[surface_measurement]]: a map has heights of its own; leave "
        "it out");
  }
  SurfaceFile surface;
  surface.map = true;
  surface.readings.reserve(map.z.size());
  for (std::size_t k = 0; k < map.z.size(); ++k) {
    const std::size_t row = k / map.columns;
    const auto i = static_cast<double>(k % map.columns);
    const Direction point{map.offset[0] + i * map.step[0],
                          map.offset[1] + static_cast<double>(row) * map.step[1],
                          map.z[k]};
    SurfaceReading reading;
    place_in_frame(frame, point, {}, reading);
    if (source.height) reading.height = *source.height;
    if (!std::isfinite(*reading.x + reading.height + reading.error)) {
      ++surface.counts.skipped;
      continue;
    }
    reading.line = row + 1;
    surface.readings.push_back(reading);
  }
  const std::size_t gaps = surface.counts.skipped;
  if (gaps > surface.readings.size()) {
    refuse(source.file.path,
           fmt::format("{} of {} points of the map were not measured: at most half may",
                       gaps, map.z.size()));
  }
  if (gaps > 0) {
    surface.notes.push_back(
        {"readings_skipped",
         fmt::format("{} of {} points of the map were left out because they were not "
                     "measured.",
                     gaps, map.z.size())});
  }
  return surface;
}

}  // namespace trochoid::files
