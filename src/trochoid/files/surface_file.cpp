#include <trochoid/files/surface_file.h>

#include <trochoid/files/numeric_table.h>
#include <trochoid/files/surface_columns.h>
#include <trochoid/files/surface_map.h>
#include <trochoid/files/surface_repeats.h>
#include <trochoid/files/surface_table.h>

#include <cmath>
#include <stdexcept>

namespace trochoid::files {

namespace {

SurfaceFile read_map(std::istream& in, const SurfaceSource& source, bool archive) {
  const SurfaceMap map =
      archive ? read_x3p(in, source.file.path) : read_sdf(in, source.file.path);
  if (source.unit) {
    refuse(
        source.file.path,
        "unit of the [[surface_measurement]]: X3P and SDF files are in metres; leave "
        "it out");
  }
  return readings_of(map, source);
}

}  // namespace

std::optional<double> SurfaceCounts::repeatability() const {
  if (repeats == 0) return std::nullopt;
  return std::sqrt(squares / static_cast<double>(repeats));
}

void SurfaceCounts::add(const SurfaceCounts& other) {
  skipped += other.skipped;
  repeats += other.repeats;
  squares += other.squares;
}

SurfaceFile read_surface_file(std::istream& in, const SurfaceSource& source,
                              int teeth) {
  const auto& frame = source.frame;
  if (frame &&
      (frame->origin.size() != 3 || !frame->feed || !frame->normal || !frame->up)) {
    throw std::invalid_argument("read_surface: the frame lacks a direction");
  }
  const std::string head = first_bytes(in, 16);
  if (is_archive(head) || is_sdf(head)) {
    return read_map(in, source, is_archive(head));
  }
  SurfaceFile surface = read_surface_table(in, source, teeth);
  average_repeats(surface);
  surface.framed = frame.has_value();
  return surface;
}

SurfaceFile read_surface_file(const SurfaceSource& source, int teeth) {
  return read_surface_file(*open_table(source.file, surface_kind), source, teeth);
}

std::vector<SurfaceReading> read_surface(std::istream& in, const std::string& name,
                                         int teeth) {
  const SurfaceSource source{.file = file_at(name)};
  return read_surface_file(in, source, teeth).readings;
}

std::vector<SurfaceReading> read_surface(const SurfaceSource& source, int teeth) {
  return read_surface_file(source, teeth).readings;
}

}  // namespace trochoid::files
