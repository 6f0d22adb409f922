#include <trochoid/base/rounded.h>
#include <trochoid/base/units.h>
#include <trochoid/results/simulate.h>

#include <fmt/core.h>

#include <algorithm>
#include <vector>

namespace trochoid::results {

namespace {

bool warned(const SimulateResult& r, std::string_view code) {
  return std::any_of(r.heading.warnings.begin(), r.heading.warnings.end(),
                     [&](const base::Warning& w) { return w.code == code; });
}

/// ` Tooth 3 cuts nothing.`; empty where all teeth cut.
std::string idle_teeth(const SimulateResult& r) {
  std::vector<std::size_t> idle;
  for (std::size_t j = 0; j < r.engagement.teeth.size(); ++j) {
    if (r.engagement.teeth[j].arcs.empty()) {
      idle.push_back(j + 1);
    }
  }
  if (idle.empty()) {
    return {};
  }
  const std::string where =
      r.engagement.height == 0
          ? "at the tip"
          : fmt::format("{:g} mm above the tip", r.engagement.height / unit::mm);
  return idle.size() == 1
             ? fmt::format(" Tooth {} cuts nothing {}.", idle.front(), where)
             : fmt::format(" {} of {} teeth cut nothing {}.", idle.size(),
                           r.engagement.teeth.size(), where);
}

/// How far the force is from what was measured, and that nothing was.
std::string measured_beside(const SimulateResult& r) {
  if (r.comparison.empty()) {
    return " It is not compared with a measurement: it is as good as the coefficients "
           "and the runout of the case.";
  }
  std::string text;
  for (const Comparison& c : r.comparison) {
    text += c.match.measured_rms > 0
                ? fmt::format(
                      " From the force measured in {} it differs by {:.2g} % of that "
                      "(rms, noise and offsets of the record included).",
                      c.file, 100 * c.match.rms / c.match.measured_rms)
                : fmt::format(" The record {} shows no force.", c.file);
  }
  return text;
}

}  // namespace

std::string simulation_sentence(const SimulateResult& r) {
  if (warned(r, "no_cut") || warned(r, "zero_feed")) {
    return "No tooth cuts anything: see the warnings.";
  }
  const force::Vector3& mean = r.force.mean;
  std::string text = fmt::format(
      "The force in the plane of the table is {:.3g} N at most, the mean force {:.3g}, "
      "{:.3g}, {:.3g} N in x, y, z; the torque is {:.3g} N m on average and {:.3g} N m "
      "at most.",
      r.force.peak_xy, mean[0], mean[1], mean[2], r.moments.mean_torque,
      r.moments.peak_torque);
  text += idle_teeth(r);
  if (warned(r, "volume")) {
    text += " Take it with care: the chips do not add up to the material there is.";
  }
  return text + measured_beside(r);
}

}  // namespace trochoid::results
