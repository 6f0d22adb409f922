#include <trochoid/run/identify/work.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::run {

namespace {

bool in_closed_form(const inputs::Case& given) {
  return force::keeps_radius(given.setup) && !force::form(given.law).power;
}

}  // namespace

std::vector<Work> identify_work(const inputs::Case& given) {
  // Measured, with text: a byte becomes five, and is read, turned and folded once.
  constexpr double byte_evaluations = 0.2;
  constexpr double byte_bytes = 5.5;
  // A fit asks for so many turns of the force, at so many angles.
  constexpr double turns_fitted = 400;
  constexpr double angles = 720;
  std::vector<Work> parts;
  for (std::size_t i = 0; i < given.measurements.size(); ++i) {
    constexpr double megabyte = 1e6;
    const double size = size_of_file(given.measurements[i].source.file.path);
    parts.push_back({.what = "bytes of records",
                     .count = size,
                     .evaluations = size * byte_evaluations,
                     .bytes = size * byte_bytes,
                     .key = {.name = fmt::format("measurement[{}].file", i + 1),
                             .value = size / megabyte,
                             .of = " MB"}});
  }
  if (!in_closed_form(given)) {
    const double runs =
        static_cast<double>(std::max<std::size_t>(given.measurements.size(), 1));
    parts.push_back({.what = "turns of a force that is summed along the edges",
                     .count = runs * turns_fitted,
                     .evaluations = runs * turns_fitted * angles *
                                    evaluations_per_angle(given.setup, given.law),
                     .key = {.name = "tool.teeth",
                             .value = static_cast<double>(given.setup.cutter.teeth()),
                             .power = 0}});
  }
  return parts;
}

std::vector<Work> plan_work(const inputs::Case& given) {
  constexpr double derivatives = 10;
  constexpr double in_closed = 3;  // of an angle
  const inputs::Plan& plan = given.plan;
  std::size_t engagements = 0;
  for (const inputs::PlannedEngagement kind : plan.engagements) {
    const bool slot = kind == inputs::PlannedEngagement::slot;
    engagements += slot ? 1 : plan.radial_depths.size();
  }
  const auto cuts =
      static_cast<double>(engagements * plan.feeds.size() * plan.axial_depths.size());
  const double angle =
      in_closed_form(given)
          ? in_closed
          : derivatives * evaluations_per_angle(given.setup, given.law);
  std::vector<Work> parts =
      given.measurements.empty() ? std::vector<Work>{} : identify_work(given);
  parts.push_back({.what = "cuts to choose from",
                   .count = cuts,
                   .evaluations = cuts * plan.samples_per_rev * angle,
                   .key = {.name = "plan.samples_per_rev",
                           .value = static_cast<double>(plan.samples_per_rev)}});
  return parts;
}

}  // namespace trochoid::run
