#include <trochoid/base/error.h>
#include <trochoid/inputs/surface_file.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

namespace {

using trochoid::inputs::SurfaceReading;

void demand(bool condition) {
  if (!condition) std::abort();
}

bool finite(const std::optional<double>& value) {
  return !value || std::isfinite(*value);
}

/// What every surface that is accepted must be.
void use(const std::vector<SurfaceReading>& readings, int teeth) {
  demand(!readings.empty());
  std::size_t line = 0;
  for (const SurfaceReading& r : readings) {
    demand(r.x || r.step);
    demand(finite(r.x) && finite(r.step) && finite(r.feed_offset));
    demand(std::isfinite(r.height) && std::isfinite(r.error));
    demand(r.tooth >= 0 && (teeth == 0 || r.tooth <= teeth));
    demand(r.line > line);
    line = r.line;
  }
  trochoid::inputs::Case given;
  given.setup.cut.a_p = 3e-3;
  given.machine.wall.emplace().length = 0.06;
  trochoid::inputs::check_readings(readings, "wall", given);
}

}  // namespace

/// The first byte is the number of teeth.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const int teeth = data[0] % 65;
  std::istringstream in(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  try {
    use(trochoid::inputs::read_surface(in, "wall", teeth), teeth);
  } catch (const trochoid::base::InputError& error) {
    demand(!error.problems().empty());
  }
  return 0;
}
