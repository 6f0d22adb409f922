#include <trochoid/base/units.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>
#include <trochoid/geometry/meridian.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace trochoid::cases {

namespace {

/// Pitches of a file are rounded; what is missing within this is spread evenly.
constexpr double pitch_slack_deg = 1e-4;

void settle_pitch(ToolTable& tool, Findings& findings) {
  const auto teeth = static_cast<std::size_t>(tool.teeth);
  if (!sound(findings, {"tool.teeth", "tool.pitch_deg"})) {
    tool.pitch.clear();
  }
  if (tool.pitch.empty()) {
    tool.pitch.assign(teeth, 360.0 / tool.teeth * unit::deg);
    return;
  }
  if (tool.pitch.size() != teeth) {
    report(
        findings, "tool.pitch_deg",
        fmt::format("tool.pitch_deg has {} entries for {} teeth; must be one angle for "
                    "each tooth (from it to the next that passes)",
                    tool.pitch.size(), teeth));
    return;
  }
  const double sum_deg =
      std::accumulate(tool.pitch.begin(), tool.pitch.end(), 0.0) / unit::deg;
  const double excess_deg = sum_deg - 360.0;
  if (std::abs(excess_deg) > pitch_slack_deg) {
    report(findings, "tool.pitch_deg",
           fmt::format("tool.pitch_deg: the pitches sum to {:.10g} deg; must sum to "
                       "360 deg (angle from each tooth to the next that passes)",
                       sum_deg));
  } else if (std::abs(excess_deg) > 1e-9) {
    for (double& pitch : tool.pitch) {
      pitch = as_written(pitch - excess_deg * unit::deg / tool.teeth, unit::deg);
    }
  }
}

geometry::Profile profile_of(const ToolTable& tool, Findings& findings) {
  const double R = tool.corner_radius.value_or(0.0);
  switch (tool.shape) {
    case Shape::cylinder:
      return geometry::cylinder(tool.diameter);
    case Shape::ball:
      return geometry::ball(tool.diameter);
    case Shape::bull_nose:
      if (!tool.corner_radius && sound(findings, {"tool.corner_radius_mm"})) {
        report(findings, "tool.corner_radius_mm",
               "tool.corner_radius_mm is missing for shape = \"bull_nose\"; must be a "
               "number from 0 to half the diameter in mm (corner radius R)");
      } else if (2 * R > tool.diameter) {
        report(
            findings, "tool.corner_radius_mm",
            fmt::format("tool.corner_radius_mm = {} mm: more than half of diameter_mm "
                        "= {} mm; must be a number from 0 to {} mm (corner radius R)",
                        mm(R), mm(tool.diameter), mm(tool.diameter / 2)));
      }
      return geometry::bull_nose(tool.diameter, R);
    case Shape::taper:
      return geometry::taper(tool.diameter, tool.taper.value_or(0.0), R);
    case Shape::apt:
      break;
  }
  return {.D = tool.diameter,
          .R = R,
          .Rr = tool.corner_center_radius.value_or(0.0),
          .Rz = tool.corner_center_height.value_or(0.0),
          .alpha = tool.bottom_angle.value_or(0.0),
          .beta = tool.taper.value_or(0.0)};
}

void check_profile(const geometry::Profile& profile, Findings& findings) {
  if (!sound(findings, {"tool.shape", "tool.diameter_mm", "tool.corner_radius_mm",
                        "tool.corner_center_radius_mm", "tool.corner_center_height_mm",
                        "tool.bottom_angle_deg", "tool.taper_deg"})) {
    return;
  }
  try {
    static_cast<void>(geometry::meridian(profile));
  } catch (const std::invalid_argument& error) {
    report(findings, "tool.shape",
           fmt::format("tool: these lengths and angles make no cutter, {}; must be a "
                       "profile that runs from the axis along the bottom, around the "
                       "corner and up the flank",
                       error.what()));
  }
}

/// A list with an entry for each tooth.
bool one_for_each_tooth(const std::vector<double>& list, const std::string& key,
                        const ToolTable& tool, Findings& findings) {
  if (!sound(findings, {"tool.teeth", key})) {
    return false;
  }
  if (list.size() == static_cast<std::size_t>(tool.teeth)) {
    return true;
  }
  report(
      findings, key,
      fmt::format("{} has {} entries for {} teeth; must be one number for each tooth",
                  key, list.size(), tool.teeth));
  return false;
}

}  // namespace

geometry::Cutter cutter_of(ToolTable& tool, Findings& findings) {
  settle_pitch(tool, findings);
  if (!tool.lag_diameter && sound(findings, {"tool.lag_diameter_mm"})) {
    tool.lag_diameter = tool.diameter;
  }
  const bool corner = tool.shape == Shape::taper || tool.shape == Shape::apt;
  if (corner && !tool.corner_radius && sound(findings, {"tool.corner_radius_mm"})) {
    tool.corner_radius = 0.0;
  }
  const geometry::Profile profile = profile_of(tool, findings);
  check_profile(profile, findings);
  geometry::Cutter cutter{
      .profile = profile,
      .pitch = tool.pitch,
      .helix = tool.helix.values.empty() ? 0.0 : tool.helix.values.front(),
      .lag_law = tool.lag,
      .lag_diameter = tool.lag_diameter.value_or(tool.diameter)};
  if (tool.helix.listed &&
      one_for_each_tooth(tool.helix.values, "tool.helix_deg", tool, findings)) {
    cutter.helices = tool.helix.values;
  }
  if (tool.serration &&
      (tool.serration->shift.empty() ||
       one_for_each_tooth(tool.serration->shift, "tool.serration.shift_mm", tool,
                          findings))) {
    cutter.serration = tool.serration;
  }
  return cutter;
}

void check_runout(geometry::Runout& runout, const ToolTable& tool, Findings& findings) {
  if (!runout.axial_offsets.empty() &&
      !one_for_each_tooth(runout.axial_offsets, "runout.axial_offsets_mm", tool,
                          findings)) {
    runout.axial_offsets.clear();
  }
  if (!sound(findings, {"tool.teeth", "runout.radial_offsets_mm"})) {
    return;
  }
  auto& offsets = runout.radial_offsets;
  const auto teeth = static_cast<std::size_t>(tool.teeth);
  if (offsets.empty()) {
    offsets.assign(teeth, 0.0);
  }
  if (offsets.size() != teeth) {
    report(findings, "runout.radial_offsets_mm",
           fmt::format("runout.radial_offsets_mm has {} entries for {} teeth; must be "
                       "one number for each tooth (by how much it stands out)",
                       offsets.size(), teeth));
    return;
  }
  if (!sound(findings, {"tool.shape", "tool.diameter_mm", "runout.eccentricity_mm"})) {
    return;
  }
  const double radius = tool.diameter / 2;
  for (std::size_t k = 0; k < teeth; ++k) {
    if (std::abs(offsets[k]) >= radius) {
      report(findings, "runout.radial_offsets_mm",
             fmt::format("runout.radial_offsets_mm entry {} = {} mm: not smaller than "
                         "the radius, {} mm (by how much a tooth stands out)",
                         k + 1, mm(offsets[k]), mm(radius)));
    }
  }
  const double deepest = *std::min_element(offsets.begin(), offsets.end());
  if (runout.eccentricity >= radius) {
    report(findings, "runout.eccentricity_mm",
           fmt::format("runout.eccentricity_mm = {} mm: not smaller than the radius, "
                       "{} mm (distance of the centres)",
                       mm(runout.eccentricity), mm(radius)));
  } else if (sound(findings, {"runout.radial_offsets_mm"}) &&
             radius + deepest - runout.eccentricity <= 0) {
    report(
        findings, "runout.eccentricity_mm",
        fmt::format("runout.eccentricity_mm = {} mm: together with an offset of {} mm "
                    "not smaller than the radius, {} mm",
                    mm(runout.eccentricity), mm(deepest), mm(radius)));
  }
}

}  // namespace trochoid::cases
