#include <trochoid/run/wall/work.h>

#include <trochoid/run/wall/setting.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::run {

namespace {

/// Each tooth feels what all the others left.
double pairs_of_teeth(const inputs::Case& given) {
  return static_cast<double>(given.setup.cutter.teeth() * given.setup.cutter.teeth());
}

bool is_regenerative(const inputs::Surface& surface) {
  return surface.feedback == surface::Feedback::regenerative;
}

}  // namespace

std::vector<Work> surface_work(const inputs::Case& given) {
  // Measured: of a point of the map, and of the deflection that the chip feels again.
  constexpr double point = 4.5;
  constexpr double point_bytes = 60;
  constexpr double fed_back = 1.7e6;  // times the square of the teeth
  const inputs::Surface table = given.machine.surface.value_or(inputs::Surface{});
  const inputs::Sampling& s = given.sampling;
  const bool listed = !s.angles.empty();
  const double rows = listed ? static_cast<double>(s.angles.size())
                             : std::max(1.0, s.samples_per_rev * s.revolutions);
  const auto heights = static_cast<double>(
      surface::map_heights(map_options(given), given.setup.cut.a_p).size());
  const double passes =
      static_cast<double>(std::max<std::size_t>(given.machine.passes.size(), 1)) *
      (table.also_bends.empty() ? 1 : 2);
  return {{.what = "points of the map of the wall",
           .count = rows * heights,
           .evaluations = passes * rows * heights * point,
           .bytes = rows * heights * point_bytes,
           .key = {.name = listed ? "sampling.angles_deg" : "sampling.samples_per_rev",
                   .value = listed ? rows : static_cast<double>(s.samples_per_rev),
                   .of = listed ? " values" : ""}},
          {.what = "pairs of teeth that feel each other's deflection",
           .count = pairs_of_teeth(given),
           .evaluations =
               is_regenerative(table) ? passes * fed_back * pairs_of_teeth(given) : 0.0,
           .key = {.name = "tool.teeth",
                   .value = static_cast<double>(given.setup.cutter.teeth()),
                   .power = 0}}};
}

std::vector<Work> calibrate_work(const inputs::Case& given) {
  // Measured: many readings are folded, and fitted as some hundred.
  constexpr double fits = 1.7e7;  // times the square of the teeth
  constexpr double byte_evaluations = 2;
  constexpr double byte_bytes = 12;
  constexpr double megabyte = 1e6;
  std::vector<Work> parts;
  const auto& all = given.machine.surface_measurements;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double size = size_of_file(all[i].source.file.path);
    parts.push_back({.what = "bytes of the surface",
                     .count = size,
                     .evaluations = size * byte_evaluations,
                     .bytes = size * byte_bytes,
                     .key = {.name = fmt::format("surface_measurement[{}].file", i + 1),
                             .value = size / megabyte,
                             .of = " MB"}});
  }
  parts.push_back({.what = "pairs of teeth, in every fit",
                   .count = pairs_of_teeth(given),
                   .evaluations = fits * pairs_of_teeth(given),
                   .key = {.name = "tool.teeth",
                           .value = static_cast<double>(given.setup.cutter.teeth()),
                           .power = 0}});
  return parts;
}

}  // namespace trochoid::run
