#include <trochoid/base/units.h>
#include <trochoid/cases/rules.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace trochoid::cases {

namespace {

double dot(const files::Direction& a, const files::Direction& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

files::Direction cross(const files::Direction& a, const files::Direction& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

files::Direction scaled(const files::Direction& a, double by) {
  return {a[0] * by, a[1] * by, a[2] * by};
}

files::Direction unit_vector(const files::Direction& a) {
  const double length = std::hypot(a[0], a[1], a[2]);
  return dot(a, a) == 1.0 ? a : scaled(a, 1.0 / length);
}

/// Numbers with three digits are perpendicular up to this; it is taken out afterwards.
constexpr double roundoff = 2e-3;

struct FrameAxis {
  std::string_view name;
  const std::optional<files::Direction>& direction;
};

void check_perpendicular(const std::string& path, const FrameAxis& a,
                         const FrameAxis& b, Findings& findings) {
  const std::string key = fmt::format("{}.{}", path, b.name);
  if (!a.direction || !b.direction ||
      !sound(findings, {fmt::format("{}.{}", path, a.name), key})) {
    return;
  }
  const double cosine = dot(*a.direction, *b.direction);
  if (std::abs(cosine) <= roundoff) return;
  report(findings, key,
         fmt::format("{}: {} and {} of the frame are at {:.1f} deg to each other; must "
                     "be perpendicular",
                     key, a.name, b.name,
                     std::acos(std::clamp(cosine, -1.0, 1.0)) / unit::deg));
}

}  // namespace

void settle_frame(files::SurfaceFrame& frame, std::size_t number, Findings& findings) {
  const std::string path = fmt::format("surface_measurement[{}].frame", number);
  const std::size_t before = findings.problems.size();
  for (auto* direction : {&frame.feed, &frame.normal, &frame.up}) {
    if (*direction) **direction = unit_vector(**direction);
  }
  check_perpendicular(path, {"feed", frame.feed}, {"normal", frame.normal}, findings);
  check_perpendicular(path, {"feed", frame.feed}, {"up", frame.up}, findings);
  check_perpendicular(path, {"normal", frame.normal}, {"up", frame.up}, findings);
  if (!frame.feed || !frame.normal || findings.problems.size() > before) return;
  // The normal stands: an error is smaller by far than the way along the wall.
  files::Direction up = unit_vector(cross(*frame.feed, *frame.normal));
  if (frame.up && dot(up, *frame.up) < 0.0) up = scaled(up, -1.0);
  const files::Direction feed = unit_vector(cross(*frame.normal, up));
  frame.feed = dot(feed, *frame.feed) < 0.0 ? scaled(feed, -1.0) : feed;
  frame.up = up;
}

}  // namespace trochoid::cases
