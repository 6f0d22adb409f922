#include <trochoid/cases/wall_readings.h>

#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/files/csv.h>
#include <trochoid/files/numeric_table.h>
#include <trochoid/files/surface_place.h>

#include <fmt/core.h>

#include <algorithm>
#include <limits>

namespace trochoid::cases {

namespace {

/// Numbers in um and in mm differ in the last bit.
bool beyond(double value, double most) {
  constexpr double slack = 1e-9;
  return value < -slack * most || value > most * (1 + slack);
}

bool misses_height(const WallLimits& limits, const files::SurfaceReading& r) {
  return beyond(r.height, limits.height);
}

bool misses_length(const WallLimits& limits, const files::SurfaceReading& r) {
  return limits.length && r.x && beyond(*r.x, *limits.length);
}

/// Smallest and largest of a length over all readings.
struct Extent {
  double low = 0.0;
  double high = 0.0;
};

/// What would bring all values of a column inside, in words; empty: nothing would.
/// @param unit  of its column; none: they were placed by a frame
std::string likely_cause(const Extent& extent, double most,
                         const std::optional<std::string>& unit) {
  const auto fits = [&](double factor) {
    const double low = std::min(extent.low * factor, extent.high * factor);
    const double high = std::max(extent.low * factor, extent.high * factor);
    return !beyond(low, most) && !beyond(high, most) && high >= 0.02 * most;
  };
  if (extent.high <= 0.0 && fits(-1.0)) {
    return "; with the other sign all readings would lie inside";
  }
  if (!unit) return "; frame in the case says how the wall lies";
  if (extent.high < 3.0 * most) return {};  // a reading or two too far
  const std::string said = unit->empty() ? "mm" : *unit;
  const auto known =
      base::named<files::LengthUnit>(said).value_or(files::LengthUnit::mm);
  for (const auto other :
       {files::LengthUnit::um, files::LengthUnit::mm, files::LengthUnit::m,
        files::LengthUnit::in, files::LengthUnit::thou}) {
    if (other != known && fits(files::factor_of(other) / files::factor_of(known))) {
      return fmt::format("; in {} instead of {} all readings would lie inside",
                         name_of(other), said);
    }
  }
  return {};
}

template <class Value>
Extent extent_of(const std::vector<files::SurfaceReading>& readings,
                 const Value& value) {
  Extent extent{std::numeric_limits<double>::infinity(),
                -std::numeric_limits<double>::infinity()};
  for (const files::SurfaceReading& reading : readings) {
    extent.low = std::min(extent.low, value(reading));
    extent.high = std::max(extent.high, value(reading));
  }
  return extent;
}

/// Leave out what a map shows beside the wall.
void keep_inside(files::SurfaceFile& surface, const WallLimits& limits,
                 const std::string& file) {
  const std::size_t before = surface.readings.size();
  std::erase_if(surface.readings, [&](const files::SurfaceReading& reading) {
    return misses_height(limits, reading) || misses_length(limits, reading);
  });
  const std::size_t outside = before - surface.readings.size();
  if (surface.readings.empty()) {
    files::refuse(
        file,
        "no point of the map lies inside the cut: x from 0 to the length of the "
        "wall, height from 0 to the axial depth; frame = { origin_mm = [...], "
        "feed = ..., normal = ..., up = ... } says how it lies");
  }
  if (outside > 0) {
    surface.counts.skipped += outside;
    surface.notes.push_back(
        {"points_outside",
         fmt::format(
             "{} of {} points of the map were left out because they lie outside "
             "the cut.",
             outside, before)});
  }
}

}  // namespace

WallLimits wall_of(const Case& given) {
  const auto& wall = given.machine.wall;
  const bool along_wall = wall && given.machine.surface.value_or(Surface{}).model !=
                                      surface::Model::quasi_static;
  WallLimits limits{.height = given.setup.cut.a_p, .teeth = given.setup.cutter.teeth()};
  if (along_wall) limits.length = wall->length;
  return limits;
}

files::SurfaceFile read_wall(const files::SurfaceSource& source,
                             const WallLimits& limits) {
  files::SurfaceFile surface = files::read_surface_file(source, limits.teeth);
  if (surface.map) keep_inside(surface, limits, source.file.path);
  auto misplaced = check_readings(surface, source.file.path, limits);
  if (!misplaced.empty()) throw base::InputError(std::move(misplaced));
  return surface;
}

std::vector<std::string> check_readings(const files::SurfaceFile& surface,
                                        const std::string& file,
                                        const WallLimits& limits) {
  const auto& readings = surface.readings;
  files::Problems problems{file, {}};
  const auto hint = [&](const Extent& extent, double most, const std::string& unit) {
    return likely_cause(extent, most,
                        surface.framed ? std::nullopt : std::optional(unit));
  };
  const std::string height_hint =
      hint(extent_of(readings, [](const files::SurfaceReading& r) { return r.height; }),
           limits.height, surface.height_unit);
  const auto x_of = [](const files::SurfaceReading& r) { return r.x.value_or(0.0); };
  const std::string x_hint =
      limits.length ? hint(extent_of(readings, x_of), *limits.length, surface.x_unit)
                    : std::string();
  for (const files::SurfaceReading& reading : readings) {
    if (problems.full()) break;
    if (misses_height(limits, reading)) {
      problems.add(
          reading.line, 1,
          fmt::format("the height of {} mm is outside the cut: must be from 0 "
                      "to axial_depth_mm = {} mm, above the tip of the cutter{}",
                      files::in_mm(reading.height), files::in_mm(limits.height),
                      height_hint));
    }
    if (misses_length(limits, reading)) {
      problems.add(
          reading.line, 1,
          fmt::format("x = {} mm is outside the wall: must be from 0 to "
                      "length_mm = {} mm{}",
                      files::in_mm(*reading.x), files::in_mm(*limits.length), x_hint));
    }
  }
  return problems.lines;
}

}  // namespace trochoid::cases
