#include <trochoid/base/rounded.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/results/coefficient_words.h>
#include <trochoid/results/identify.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace trochoid::results {

namespace {

using identification::Fit;

/// `K_tc = 2596 +- 76 MPa and K_rc = ...`: the two that make most of the force.
std::string coefficients_of(const Fit& fit) {
  const auto names = force::coefficient_quantities(fit.law);
  std::vector<std::string> parts;
  for (std::size_t q = 0; q < std::min<std::size_t>(2, names.size()); ++q) {
    const auto& e = fit.coefficients[q];
    parts.push_back(
        e ? coefficient_words(names[q].key, base::with_error(e->value / names[q].unit,
                                                             0.5 * (e->high - e->low) /
                                                                 names[q].unit))
          : fmt::format("{} is not identifiable",
                        names[q].key.substr(0, names[q].key.rfind("_MPa"))));
  }
  const bool grouped = fit.groups.size() > 1;
  const std::string& group = grouped ? fit.groups.front().name : std::string();
  return fmt::format("{} (95 %{})", fmt::join(parts, " and "),
                     grouped
                         ? fmt::format(", {}", group.empty() ? "records without a group"
                                                             : "group " + group)
                         : "");
}

/// Of a tool with two teeth by how much one is shorter, of others the largest difference.
std::string offsets_of(const Fit& fit) {
  const auto& r = fit.runout.radial_offsets;
  if (r.size() < 2 || !fit.radial_offsets_se[1]) {
    return {};
  }
  if (r.size() == 2) {
    return fmt::format(
        "tooth 2 is {} um {} than tooth 1",
        base::with_error(std::abs(r[1]) / unit::um,
                         fit.interval_factor * *fit.radial_offsets_se[1] / unit::um),
        r[1] < 0 ? "shorter" : "longer");
  }
  const auto [low, high] = std::minmax_element(r.begin(), r.end());
  return fmt::format(
      "the radii of the teeth differ by up to {:.3g} um: tooth {} is the longest, tooth {} "
      "the shortest",
      (*high - *low) / unit::um, high - r.begin() + 1, low - r.begin() + 1);
}

std::string eccentricity_of(const Fit& fit) {
  if (!fit.eccentricity_se) {
    return {};
  }
  return fmt::format(
      "the tool turns {} um off its centre",
      base::with_error(fit.runout.eccentricity / unit::um,
                       fit.interval_factor * *fit.eccentricity_se / unit::um));
}

/// The teeth that cut nothing, as they were warned of.
std::string idle_of(const IdentifyResult& r) {
  const bool warned = std::ranges::any_of(
      r.heading.warnings,
      [](const base::Warning& w) { return w.code == "idle_tooth"; });
  if (!warned) return {};
  const auto& idle = r.idle_teeth;
  if (idle.size() == 1) return fmt::format("; tooth {} cuts nothing", idle.front() + 1);
  std::vector<std::size_t> numbers;
  numbers.reserve(idle.size());
  for (const std::size_t tooth : idle) numbers.push_back(tooth + 1);
  return fmt::format("; teeth {} cut nothing", fmt::join(numbers, ", "));
}

std::string runout_of(const IdentifyResult& r) {
  const Fit& fit = r.fits[*r.chosen];
  if (!chip::feels_runout(fit.chip.model)) {
    return {};
  }
  if (std::string idle = idle_of(r); !idle.empty()) return idle;
  std::string text;
  for (const std::string& part : {offsets_of(fit), eccentricity_of(fit)}) {
    if (!part.empty()) text += "; " + part;
  }
  return text;
}

/// What the fit leaves of the force, and of how much data.
std::string unexplained_of(const IdentifyResult& r) {
  const Fit& fit = r.fits[*r.chosen];
  std::size_t samples = 0;
  for (const RecordSummary& record : r.records) {
    samples += record.samples;
  }
  if (r.sensor) {
    return fmt::format(
        "Unexplained stays {} of what the channels read (rms, each by its weight), by the {} "
        "chip model and {} measurement{}.",
        base::percent(fit.unexplained.in_band), chip::name_of(fit.chip.model),
        r.sensor->data.size(), r.sensor->data.size() == 1 ? "" : "s");
  }
  const int harmonics = fit.options.band_harmonics;
  return fmt::format(
      "Unexplained stays {} of the force{} (rms), {:.3g} N, by the {} chip model and {} "
      "samples of {} record{}.",
      base::percent(fit.unexplained.in_band),
      harmonics > 0 ? fmt::format(" within its mean and first {} harmonics", harmonics)
                    : "",
      fit.rms, chip::name_of(fit.chip.model), samples, r.records.size(),
      r.records.size() == 1 ? "" : "s");
}

}  // namespace

std::string identification_verdict(const IdentifyResult& r) {
  if (!r.reasons_against.empty()) {
    return identification::do_not_use(r.reasons_against);
  }
  return r.reasons_for_care.empty() ? std::string("Usable.")
                                    : fmt::format("Usable with care: {}.",
                                                  fmt::join(r.reasons_for_care, "; "));
}

std::string identification_sentence(const IdentifyResult& r) {
  const std::string verdict = identification_verdict(r);
  if (!r.reasons_against.empty()) {  // numbers in a sentence would be used
    return fmt::format("{} {}", verdict, unexplained_of(r));
  }
  const Fit& fit = r.fits[*r.chosen];
  return fmt::format("{} {}{}. {}", verdict, coefficients_of(fit), runout_of(r),
                     unexplained_of(r));
}

}  // namespace trochoid::results
