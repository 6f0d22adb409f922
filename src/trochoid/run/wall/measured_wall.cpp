#include <trochoid/run/wall/measured_wall.h>

#include <trochoid/base/error.h>
#include <trochoid/run/wall/setting.h>

#include <string>

namespace trochoid::run {

namespace {

/// Where the reading lies along the wall, and how far the tool has fed since the phase.
void set_place(const inputs::Case& given, const inputs::SurfaceReading& read,
               surface::Reading& reading) {
  const double step =
      given.setup.cutter.teeth() * given.setup.cut.f_z / given.sampling.samples_per_rev;
  const double along = read.x ? *read.x : read.step.value_or(0.0) * step;
  const bool pulse = given.machine.surface->model == surface::Model::quasi_static;
  reading.x = pulse || !read.x ? wall_position(given) : along;
  reading.travel = along + read.feed_offset.value_or(0.0);
}

/// What is estimated of a file beside the coefficients.
surface::Datum datum_of(const inputs::Case& given,
                        const inputs::SurfaceMeasurement& m) {
  const bool pulse = given.machine.surface->model == surface::Model::quasi_static;
  surface::Datum datum{.decide = !m.form && !pulse};
  if (m.form) {
    datum = surface::datum_of(*m.form);
  }
  datum.offset = datum.offset || m.datum_offset;
  datum.tilt = datum.tilt || m.datum_tilt;
  return datum;
}

}  // namespace

MeasuredWall measured_wall(const inputs::Case& given) {
  MeasuredWall wall;
  std::vector<std::string> problems;
  for (const inputs::SurfaceMeasurement& m : given.machine.surface_measurements) {
    const inputs::SurfaceFile* read_file = nullptr;
    try {
      read_file = &m.surface.get();
    } catch (const base::InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
      continue;
    }
    const inputs::SurfaceFile& file = *read_file;
    for (const base::Warning& note : file.notes) {
      wall.notes.push_back({note.code, m.source.file.path + ": " + note.message});
    }
    wall.counts.add(file.counts);
    for (const inputs::SurfaceReading& read : file.readings) {
      surface::Reading reading{.height = read.height,
                               .error = read.error,
                               .tooth = read.tooth - 1,
                               .set = wall.datum.size()};
      set_place(given, read, reading);
      wall.readings.push_back(reading);
    }
    wall.datum.push_back(datum_of(given, m));
  }
  if (!problems.empty()) {
    throw base::InputError(problems);
  }
  return wall;
}

}  // namespace trochoid::run
