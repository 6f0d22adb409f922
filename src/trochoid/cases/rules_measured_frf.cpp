#include <trochoid/cases/rules.h>

#include <fmt/core.h>

#include <algorithm>
#include <string>

namespace trochoid::cases {

namespace {

Axis force_axis(const MeasuredFrf& frf) {
  return frf.force_axis.value_or(frf.axis);
}

bool is_cross(const MeasuredFrf& frf) {
  return force_axis(frf) != frf.axis;
}

/// What the chip feels of one response, and the lines of it that are used.
void check_measured_frf(const MeasuredFrf& frf, const std::string& path,
                        Findings& findings) {
  const std::string axis = path + ".axis";
  if ((frf.axis == Axis::z || force_axis(frf) == Axis::z) &&
      sound(findings, {axis, path + ".force_axis"})) {
    report(findings, axis,
           fmt::format("{}: along z, which the chip does not feel; must be along x or "
                       "y, force and motion",
                       path));
  }
  const std::string band = path + ".band_Hz";
  if (frf.band.size() == 2 && sound(findings, {band}) && frf.band[0] >= frf.band[1]) {
    report(findings, band,
           fmt::format("{} = [{}, {}]: not in order; must be the lowest, then the "
                       "highest frequency",
                       band, frf.band[0], frf.band[1]));
  }
}

void check_twice(const std::vector<MeasuredFrf>& all, Findings& findings) {
  for (std::size_t i = 1; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (all[i].body == all[k].body && all[i].axis == all[k].axis &&
          force_axis(all[i]) == force_axis(all[k])) {
        const std::string path = fmt::format("measured_frf[{}]", i + 1);
        report(findings, path,
               fmt::format("{}: the same body and directions as measured_frf[{}]; each "
                           "response may be given once",
                           path, k + 1));
        break;
      }
    }
  }
}

/// Without a cross response nobody knows on which side of the axes a mode lies.
void check_joined(const std::vector<MeasuredFrf>& all, Findings& findings) {
  const bool crossed = std::any_of(all.begin(), all.end(), is_cross);
  const bool both = std::any_of(all.begin(), all.end(), [&](const MeasuredFrf& frf) {
    return frf.axis != all.front().axis;
  });
  if (both && !crossed && sound(findings, {"measured_frf[1].axis"})) {
    report(
        findings, "measured_frf[1]",
        "measured_frf: along x and along y, and no cross response between them; must "
        "have one with axis = \"x\" and force_axis = \"y\", or the other way round: "
        "without it nobody knows how the modes lie between the axes. Or fit each "
        "alone, as [frf] file");
  }
}

}  // namespace

void check_measured_frfs(const std::vector<MeasuredFrf>& all, Findings& findings) {
  if (!all.empty() && std::all_of(all.begin(), all.end(), is_cross) &&
      sound(findings, {"measured_frf[1].axis", "measured_frf[1].force_axis"})) {
    report(findings, "measured_frf[1]",
           "measured_frf: all of them are cross responses; must have a direct one "
           "along x or y, measured where the force acts and along it");
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    check_measured_frf(all[i], fmt::format("measured_frf[{}]", i + 1), findings);
  }
  check_twice(all, findings);
}

void check_shared_modes(const MachineTables& machine, Findings& findings) {
  const std::vector<MeasuredFrf>& all = machine.measured_frfs;
  const bool file = machine.frf && !machine.frf->source.file.name.empty();
  if (file || !sound(findings, {"frf", "frf.file", "measured_frf"})) {
    return;
  }
  if (all.empty()) {
    if (machine.frf) {
      report(
          findings, "frf",
          "frf.file is missing; must be text (the measured frequency response, relative "
          "to the file that names it), or several [[measured_frf]] must be given");
    } else {
      report(findings, "frf",
             "[frf] is missing (a measured frequency response), and so is "
             "[[measured_frf]]; modes needs one of the two");
    }
    return;
  }
  check_measured_frfs(all, findings);
  bool one_body = true;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].body != all.front().body) {
      one_body = false;
      const std::string path = fmt::format("measured_frf[{}]", i + 1);
      report(
          findings, path + ".body",
          fmt::format("{}: of the {}, and measured_frf[1] of the {}: modes are shared "
                      "by responses of one structure; must have one body, or the "
                      "bodies cases of their own",
                      path, name_of(all[i].body), name_of(all.front().body)));
    }
  }
  if (one_body) {
    check_joined(all, findings);
  }
}

}  // namespace trochoid::cases
