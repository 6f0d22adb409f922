#include <trochoid/base/error.h>
#include <trochoid/cases/wall_readings.h>

#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>

#include "bytes.h"

namespace {

using trochoid::files::SurfaceFile;
using trochoid::files::SurfaceReading;
using trochoid::fuzz::demand;

bool finite(const std::optional<double>& value) {
  return !value || std::isfinite(*value);
}

/// What every surface that is accepted must be.
void use(const SurfaceFile& surface, int teeth) {
  demand(!surface.readings.empty());
  demand(surface.counts.skipped <= surface.readings.size() + surface.counts.repeats);
  const auto repeatability = surface.counts.repeatability();
  demand(repeatability.has_value() == (surface.counts.repeats > 0));
  std::size_t line = 0;
  for (const SurfaceReading& r : surface.readings) {
    demand(r.x || r.step);
    demand(finite(r.x) && finite(r.step) && finite(r.feed_offset));
    demand(std::isfinite(r.height) && std::isfinite(r.error));
    demand(r.tooth >= 0 && (teeth == 0 || r.tooth <= teeth));
    demand(surface.map ? r.line >= line : r.line > line);
    line = r.line;
  }
  trochoid::cases::Case given;
  given.setup.cut.a_p = 3e-3;
  given.machine.wall.emplace().length = 0.06;
  trochoid::cases::check_readings(surface, "wall", trochoid::cases::wall_of(given));
}

}  // namespace

/// The first byte is the number of teeth, and from 128 on there is a frame.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const int teeth = data[0] % 65;
  trochoid::files::SurfaceSource measurement;
  measurement.file = trochoid::files::file_at("wall");
  if (data[0] >= 128) {
    using trochoid::files::Direction;
    measurement.unit = trochoid::files::LengthUnit::mm;
    measurement.frame = trochoid::files::SurfaceFrame{{0.01, -0.005, 0.04},
                                                      Direction{1, 0, 0},
                                                      Direction{0, -1, 0},
                                                      Direction{0, 0, 1}};
  }
  std::istringstream in(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  try {
    use(trochoid::files::read_surface_file(in, measurement, teeth), teeth);
  } catch (const trochoid::base::InputError& error) {
    demand(!error.problems().empty());
  }
  return 0;
}
