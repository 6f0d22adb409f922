#include <trochoid/run/identify.h>

#include <trochoid/base/rounded.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/fit.h>
#include <trochoid/identification/reliability.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace trochoid::run {

namespace {

using identification::Fit;
using identification::Group;
using Warnings = std::vector<base::Warning>;

/// Cutting coefficients of real materials, from plastics to hardened steel [N/m^2].
constexpr double softest = 100 * unit::MPa;
constexpr double hardest = 20000 * unit::MPa;
/// Part of the force (rms) that may stay unexplained, or outside of the band, unsaid.
constexpr double much_ringing = 0.2;

/// Warnings that cast a doubt on the numbers, and how to say it in a few words.
constexpr auto care = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"clipped_channel", "a channel was driven beyond its range"},
    {"dead_channel", "a channel is dead"},
    {"cut_fits_better", "another cut than the stated one fits better"},
    {"dropouts", "a channel drops out"},
    {"axes_fit_better", "another reading of the channels fits better"},
    {"axes_signs", "the signs of the channels are not certain"},
    {"axes_by_signs",
     "another reading of the channels leaves less, with signs of no cut"},
    {"offsets_left_in", "offsets of the channels may be in the forces"},
    {"changes_within", "the force changes within a record"},
    {"axes_close", "another reading of the channels fits nearly as well"},
    {"axial_sign", "z may be reversed"},
    {"negative_coefficient", "a coefficient is negative"},
    {"implausible", "K_tc is not one of a material"},
    {"poor_fit", "much of the force is not explained"},
    {"outside_the_band", "much of the force lies outside of the band"},
    {"other_model_fits_better", "a simpler chip model fits better"},
    {"no_exact_fit", "a more exact chip model has no fit"},
    {"runout_form", "another form of runout explains more"},
    {"few_equations", "hardly more equations than unknowns"},
    {"runout_above_feed", "the teeth differ by more than the feed"},
    {"large_runout", "the runout is larger than tools have"},
    {"spindle_speed_unknown", "the spindle speed could not be found"},
    {"channel_gain", "the gain of a channel does not fit the others"},
    {"channel_delay", "the channels do not read at the same time"},
    {"cross_talk", "a channel reads part of another force"},
    {"response_scaled", "the given response does not fit the record"},
});

void warn_correlation(const Fit& chosen, Warnings& warnings) {
  const double r = chosen.residual_correlation;
  if (r > identification::noise_correlation && chosen.widening > 1.05) {
    warnings.push_back(
        {"correlated_residuals",
         fmt::format(
             "What the fit leaves is not noise: neighbouring samples agree "
             "(correlation {:.2f}). The intervals are {:.1f} times wider for it.",
             r, chosen.widening)});
  }
}

void warn_unidentifiable(const Fit& chosen, Warnings& warnings) {
  for (const auto& [what, why] : chosen.unidentifiable) {
    warnings.push_back({"not_identifiable", fmt::format("{}: {}", what, why)});
  }
}

void warn_signs(const Fit& chosen, const Group& group, Warnings& warnings) {
  const auto names = force::coefficient_quantities(group.law);
  const std::string whose = identification::of_group(chosen, group);
  std::vector<std::string> negative;
  for (std::size_t q = 0; q < group.coefficients.size(); ++q) {
    const auto& K = group.coefficients[q];
    const bool along_the_axis = q % 3 == 2;  // may pull either way
    if (K && K->high < 0 && !along_the_axis) {
      negative.push_back(std::string(names[q].key) + whose);
    }
  }
  if (!negative.empty()) {
    warnings.push_back(
        {"negative_coefficient",
         fmt::format("{} came out negative, which no cut does: check the axes of the "
                     "dynamometer and the sense of rotation.",
                     fmt::join(negative, ", "))});
  } else if (const auto& K_a = group.coefficients[2]; K_a && K_a->high < 0) {
    // On a cylinder a reversed z changes nothing else.
    warnings.push_back(
        {"axial_sign",
         fmt::format(
             "{} came out negative: the cut would push the tool into its holder, "
             "as a left-hand helix does. If the tool has none, z of the "
             "dynamometer has the other sign.",
             std::string(names[2].key) + whose)});
  }
}

void warn_size(const Fit& chosen, const Group& group, Warnings& warnings) {
  const auto& K_tc = group.coefficients.front();
  if (!K_tc || force::form(group.law).power ||
      (K_tc->value >= softest && K_tc->value <= hardest)) {
    return;
  }
  const auto ordinary = [](double K) { return K >= 2 * softest && K <= hardest / 2; };
  const std::string_view unit_hint =
      ordinary(K_tc->value * 1000) ? " Forces in kN read as N would do that."
      : ordinary(K_tc->value / 1000)
          ? " Forces in N read as kN, or mN as N, would do that."
          : "";
  warnings.push_back(
      {"implausible",
       fmt::format(
           "K_tc_MPa{} = {:.4g} is outside of what materials have ({:g} to {:g} "
           "MPa): check the unit of the forces, the feed and the axial depth.{}",
           identification::of_group(chosen, group), K_tc->value / unit::MPa,
           softest / unit::MPa, hardest / unit::MPa, unit_hint)});
}

/// What the fit does not explain and has not looked at.
void warn_ringing(const cases::Case& given, const Fit& chosen, Warnings& warnings) {
  const identification::Unexplained& u = chosen.unexplained;
  if (u.outside > much_ringing) {
    warnings.push_back(
        {"outside_the_band",
         fmt::format("{} of the force (rms) lies outside the mean and the first {} "
                     "harmonics, where the fit does not look: a ringing dynamometer, "
                     "chatter or noise.",
                     base::percent(u.outside), chosen.options.band_harmonics)});
  }
  const bool banded = chosen.options.band_harmonics > 0;
  const bool noise =
      !banded && chosen.residual_correlation <= identification::noise_correlation;
  if (u.in_band > much_ringing && !noise &&
      identification::reasons_against(chosen).empty()) {
    const std::string hint =
        banded ? "Look at the residuals."
               : fmt::format(
                     "If the dynamometer rings, compare band_harmonics = {} in "
                     "[identify], or give its response: frf in [dynamometer].",
                     given.setup.cutter.teeth());
    warnings.push_back(
        {"poor_fit",
         fmt::format("{} of the force (rms{}) is not explained. {}",
                     base::percent(u.in_band), banded ? ", in the band" : "", hint)});
  }
}

/// Resonances that are in the model.
void warn_resonance(const Fit& chosen, Warnings& warnings) {
  std::vector<std::string> found;
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t q = 0; q < 3; ++q) {
    if (const auto& one = chosen.resonances[q]) {
      found.push_back(fmt::format("{:.0f} Hz in {}", one->omega / unit::turn, axes[q]));
    }
  }
  if (!found.empty()) {
    warnings.push_back(
        {"dynamometer_resonance",
         fmt::format(
             "The dynamometer rings at {} of the tool, or its amplifier filters "
             "there. This is in the model and fitted with the rest, to the "
             "mean and the first {} harmonics.",
             fmt::join(found, ", "), chosen.options.band_harmonics)});
  }
}

/// A given response whose resonances the record has elsewhere.
void warn_response(const Fit& chosen, Warnings& warnings) {
  constexpr double clear = 3.0;  // standard errors
  constexpr double small = 0.003;
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t q = 0; q < 3; ++q) {
    const auto& given = chosen.options.resonances[q];
    const auto& found = chosen.resonances[q];
    if (!given || !found || !found->omega_se) continue;
    const double off = found->omega / given->omega - 1.0;
    const double se = *found->omega_se / given->omega;
    if (std::abs(off) < std::max(small, clear * se)) continue;
    warnings.push_back(
        {"response_scaled",
         fmt::format(
             "The resonance in {} of the tool, {:.1f} Hz by the given response, "
             "comes out at {:.1f} Hz ({:+.2f} +- {:.2f} %), which is used: was "
             "the response measured with this workpiece and clamping?",
             axes[q], given->omega / unit::turn, found->omega / unit::turn, 100 * off,
             200 * se)});
  }
}

void warn_freedom(const Fit& chosen, Warnings& warnings) {
  if (chosen.freedom < 10) {
    warnings.push_back(
        {"few_equations",
         fmt::format("Only {:g} equations more than unknowns: the standard errors "
                     "themselves are uncertain.",
                     chosen.freedom)});
  }
}

void warn_other_model(std::span<const Fit> fits, const Fit& chosen,
                      Warnings& warnings) {
  for (const Fit& fit : fits) {
    if (fit.ok && fit.rms < 0.95 * chosen.rms) {
      warnings.push_back(
          {"other_model_fits_better",
           fmt::format("The {} chip model fits better ({:.2f} N against {:.2f} N) than "
                       "the {} one, though it is less exact: something else than the "
                       "chip shapes this record.",
                       chip::name_of(fit.chip.model), fit.rms, chosen.rms,
                       chip::name_of(chosen.chip.model))});
    }
  }
}

void warn_large_runout(const cases::Case& given, const Fit& chosen,
                       Warnings& warnings) {
  if (!chip::feels_runout(chosen.chip.model) || !(given.setup.cut.f_z > 0)) {
    return;
  }
  double lo = 0.0;
  double hi = 0.0;
  const auto& offsets = chosen.runout.radial_offsets;
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    if (!identification::unidentifiable(chosen,
                                        fmt::format("radial_offsets_mm[{}]", k + 1))) {
      lo = std::min(lo, offsets[k]);
      hi = std::max(hi, offsets[k]);
    }
  }
  const bool idle = std::ranges::any_of(
      warnings, [](const base::Warning& w) { return w.code == "idle_tooth"; });
  if (!idle && hi - lo > given.setup.cut.f_z) {
    warnings.push_back(
        {"runout_above_feed",
         fmt::format("The teeth differ by {:.1f} um, more than the feed per tooth: a "
                     "tooth may cut nothing. Is the number of teeth right?",
                     (hi - lo) / unit::um)});
  }
  // Chip and runout scale with the feed: a feed with a wrong unit shows in the runout.
  constexpr double most_of_diameter = 0.008;
  constexpr double always_possible = 10 * unit::um;
  const double D = given.setup.cutter.profile.D;
  if (D > 0 && hi - lo > most_of_diameter * D + always_possible) {
    warnings.push_back(
        {"large_runout",
         fmt::format(
             "The teeth differ by {:.0f} um, which is much for a tool of {:.4g} "
             "mm. Runout and 1/K scale with the feed: check that {:.4g} mm is "
             "the feed per tooth.",
             (hi - lo) / unit::um, D / unit::mm, given.setup.cut.f_z / unit::mm)});
  }
}

void warn_edge(const Fit& chosen, Warnings& warnings) {
  for (const std::string& name : chosen.on_edge) {
    warnings.push_back(
        {"runout_on_edge",
         fmt::format(
             "{} is found where a tooth just starts or stops cutting: the force "
             "tells it to one side only, so it has no standard error.",
             name)});
  }
}

}  // namespace

void add_fit_warnings(const cases::Case& given, std::span<const Fit> fits,
                      const Fit& chosen, Warnings& warnings) {
  for (const Fit& fit : fits) {
    if (fit.ok) continue;
    const bool better = fit.chip.model > chosen.chip.model;
    warnings.push_back(
        {better ? "no_exact_fit" : "no_fit",
         fmt::format("chip model {}: {}", chip::name_of(fit.chip.model), fit.message)});
  }
  warn_unidentifiable(chosen, warnings);
  for (const Group& group : identification::groups_of(chosen)) {
    warn_signs(chosen, group, warnings);
    warn_size(chosen, group, warnings);
  }
  warn_correlation(chosen, warnings);
  if (given.dynamometer && !given.dynamometer->frf.name.empty()) {
    warn_response(chosen, warnings);
  } else {
    warn_resonance(chosen, warnings);
  }
  warn_ringing(given, chosen, warnings);
  warn_freedom(chosen, warnings);
  warn_other_model(fits, chosen, warnings);
  warn_large_runout(given, chosen, warnings);
  warn_edge(chosen, warnings);
}

namespace {

/// `y`, with its channel where one channel reads it alone.
std::string reading_words(std::size_t axis, const signal::Matrix3& M) {
  constexpr std::array axes{"x", "y", "z"};
  std::string channel;
  for (std::size_t c = 0; c < 3; ++c) {
    const bool alone =
        std::abs(std::abs(M[c][axis]) - 1.0) < 1e-12 &&
        std::abs(M[c][(axis + 1) % 3]) + std::abs(M[c][(axis + 2) % 3]) < 1e-12;
    if (alone) channel = fmt::format(" (channel {})", c + 1);
  }
  return axes[axis] + channel;
}

std::string fault_words(const identification::SensorFault& fault, const Fit& chosen,
                        const signal::Matrix3& M) {
  constexpr std::array axes{"x", "y", "z"};
  const auto& one = fault.systematic;
  if (one.kind == identification::SystematicKind::delay) {
    return fmt::format("the reading of {} is {} by {} ms",
                       reading_words(one.reading, M),
                       fault.value > 0 ? "late" : "early",
                       base::with_error(1e3 * std::abs(fault.value), 2e3 * fault.se));
  }
  const bool gain = one.kind == identification::SystematicKind::gain;
  const std::string size = base::with_error(
      100 * (gain ? std::abs(fault.value) : fault.value), 200 * fault.se);
  const std::string what =
      gain ? fmt::format("the reading of {} is {} % too {}",
                         reading_words(one.reading, M), size,
                         fault.value > 0 ? "large" : "small")
           : fmt::format("the reading of {} contains {} % of the force in {}",
                         reading_words(one.reading, M), size, axes[one.force]);
  const auto names = force::coefficient_quantities(chosen.law);
  return fmt::format("{}; with that corrected {} = {:.4g} and {} = {:.4g}", what,
                     names[0].key, fault.coefficients[0] / names[0].unit, names[1].key,
                     fault.coefficients[1] / names[1].unit);
}

}  // namespace

void warn_sensor(std::span<const identification::SensorFault> faults, const Fit& chosen,
                 const signal::Matrix3& M, Warnings& warnings) {
  if (faults.empty()) return;
  std::vector<std::string> words;
  for (const auto& fault : faults) words.push_back(fault_words(fault, chosen, M));
  const auto kind = faults.front().systematic.kind;
  if (kind == identification::SystematicKind::delay) {
    warnings.push_back(
        {"channel_delay",
         fmt::format("The channels do not read at the same time: {}. Channels that are "
                     "sampled one after the other do this, and filters that differ.",
                     fmt::join(words, "; or "))});
    return;
  }
  const bool gain = kind == identification::SystematicKind::gain;
  warnings.push_back(
      {gain ? "channel_gain" : "cross_talk",
       fmt::format(
           "The dynamometer is not what the case says: {}. Check its calibration; "
           "[dynamometer] matrix tells what a channel reads.",
           fmt::join(words, "; or "))});
}

std::vector<std::string> reasons_for_care(std::span<const base::Warning> warnings) {
  std::vector<std::string> reasons;
  for (const base::Warning& warning : warnings) {
    const auto* const at =
        std::find_if(care.begin(), care.end(),
                     [&](const auto& entry) { return entry.first == warning.code; });
    const bool new_reason =
        at != care.end() &&
        std::find(reasons.begin(), reasons.end(), at->second) == reasons.end();
    if (new_reason) {
      reasons.emplace_back(at->second);
    }
  }
  return reasons;
}

}  // namespace trochoid::run
