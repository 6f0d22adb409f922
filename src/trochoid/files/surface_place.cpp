#include <trochoid/files/surface_place.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

namespace trochoid::files {

std::optional<double> error_of(const SurfaceValues& values) {
  if (values.error) return values.error;
  if (values.actual && values.nominal) return *values.actual - *values.nominal;
  return std::nullopt;
}

void place_in_frame(const SurfaceFrame& frame, const Direction& point,
                    const SurfaceValues& values, SurfaceReading& reading) {
  const auto along = [&](const Direction& direction) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      sum += direction[i] * (point[i] - frame.origin[i]);
    }
    return sum;
  };
  reading.x = along(*frame.feed);
  reading.height = along(*frame.up);
  if (const auto error = error_of(values)) {
    reading.error = *error;
    return;
  }
  reading.error = along(*frame.normal);
  if (!values.nominal) return;
  double nominal = 0.0;  // along the normal, which is an axis here
  for (std::size_t i = 0; i < 3; ++i) {
    const double at = (*frame.normal)[i];
    if (at != 0.0) nominal = at * (*values.nominal - frame.origin[i]);
  }
  reading.error -= nominal;
}

std::string in_mm(double length) {
  return fmt::format("{:.10g}", length / unit::mm);
}

}  // namespace trochoid::files
