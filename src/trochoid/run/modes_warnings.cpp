#include <trochoid/run/vibration.h>

#include <trochoid/base/estimate.h>
#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

using structure::FittedMode;
using structure::ModesFit;
using Warnings = std::vector<base::Warning>;

constexpr int few_in_peak = 5;  ///< between half-power points
constexpr double poor_fit =
    0.95;  ///< explained fraction below which modes are in doubt
constexpr double loose_error = 0.1;  ///< relative standard error
constexpr double loose_angle = 5;    ///< [deg]
/// Transposed responses differ where they do so by three standard errors and 2 %.
constexpr double sure = 3.0;
constexpr double worth_telling = 0.02;

std::string hertz(double omega) {
  return fmt::format("{:.5g} Hz", omega / unit::Hz);
}

void warn_of_complex_shapes(const ModesFit& fit, Warnings& warnings) {
  std::string each;
  for (const FittedMode& mode : fit.modes) {
    each += fmt::format("{}{:.1f} +- {:.1f} % at {}", each.empty() ? "" : ", ",
                        100 * mode.imaginary.value,
                        100 * base::normal_interval * mode.imaginary.se,
                        hertz(mode.omega.value));
  }
  warnings.push_back(
      {"complex_modes",
       fmt::format(
           "{}As a fraction of the shape their imaginary part is {}. The cut is "
           "simulated with real modes only: modes.toml has the real modes that fit all "
           "responses best.",
           fit.complex_evidence
               ? fmt::format("Real modes do not describe these responses: complex "
                             "shapes are likelier, their criterion is less by "
                             "{:.0f}. ",
                             *fit.complex_evidence)
               : std::string("The shapes are complex. "),
           each)});
}

/// Two modes whose half-power widths overlap share what the response shows there.
void warn_overlap(const ModesFit& fit, Warnings& warnings) {
  for (std::size_t r = 0; r + 1 < fit.modes.size(); ++r) {
    const FittedMode& a = fit.modes[r];
    const FittedMode& b = fit.modes[r + 1];
    if (b.omega.value - a.omega.value <
        a.zeta.value * a.omega.value + b.zeta.value * b.omega.value) {
      warnings.push_back(
          {"modes_overlap",
           fmt::format("The modes at {:.5g} and {:.5g} Hz lie inside each other's "
                       "half-power widths: together they are known better than each "
                       "alone. Use both or none.",
                       a.omega.value / unit::Hz, b.omega.value / unit::Hz)});
    }
  }
}

void warn_of_mode(const FittedMode& m, bool shared, Warnings& warnings) {
  const std::string at = hertz(m.omega.value);
  if (m.lines_in_peak < few_in_peak) {
    warnings.push_back(
        {"few_lines",
         fmt::format(
             "Only {} lines {} between the half-power points of the mode at {}: "
             "its damping hangs on them. A longer record has a finer resolution.",
             m.lines_in_peak, shared ? "of a response lie" : "lie", at)});
  }
  const double angle = m.angle.se / unit::deg;
  if (m.damping.se > loose_error * m.damping.value ||
      m.stiffness.se > loose_error * m.stiffness.value || angle > loose_angle) {
    warnings.push_back(
        {"loosely_known",
         fmt::format(
             "The mode at {} is known loosely: stiffness to {:.0f} %, damping to "
             "{:.0f} %{} (standard errors).",
             at, 100 * m.stiffness.se / m.stiffness.value,
             100 * m.damping.se / m.damping.value,
             shared ? fmt::format(", its direction to {:.1f} deg", angle) : "")});
  }
}

void warn_of_reciprocity(const results::ModesResult& r, Warnings& warnings) {
  for (const structure::Reciprocity& pair : r.fit.reciprocity) {
    const double off = std::abs(pair.gain.value - 1);
    if (off > worth_telling && off > sure * pair.gain.se) {
      warnings.push_back(
          {"reciprocity_hurt",
           fmt::format(
               "The response {} is {:.3f} +- {:.3f} times {}, and reciprocity makes them "
               "equal: the calibration of hammer or sensor differs between the two, or "
               "they did not hit the same point. The modes lie between.",
               r.responses[pair.other].name, pair.gain.value,
               base::normal_interval * pair.gain.se, r.responses[pair.one].name)});
    }
  }
}

}  // namespace

void add_modes_warnings(const results::ModesResult& r, Warnings& warnings) {
  const ModesFit& fit = r.fit;
  if (fit.complex_shapes) {
    warn_of_complex_shapes(fit, warnings);
  }
  warn_of_reciprocity(r, warnings);
  for (const std::string& why : fit.left_out) {
    warnings.push_back(
        {"mode_left_out",
         fmt::format("A resonance is in the fit and not among the modes: {}.", why)});
  }
  if (fit.alternative > 0) {
    warnings.push_back(
        {"number_of_modes",
         fmt::format(
             "{} mode{} fit nearly as well: {} is {:.2g} times as likely.{}",
             fit.alternative, fit.alternative == 1 ? "" : "s", fit.modes.size(),
             fit.alternative_odds,
             r.shared ? "" : " Look at the stabilisation before trusting either.")});
  }
  if (!r.shared) {  // modes that are close by each other differ in their shapes
    warn_overlap(fit, warnings);
  }
  for (const FittedMode& mode : fit.modes) {
    warn_of_mode(mode, r.shared, warnings);
  }
  for (std::size_t q = 0; q < fit.responses.size(); ++q) {
    const double explained = fit.responses[q].explained;
    if (explained < poor_fit) {
      warnings.push_back(
          {"poor_fit",
           fmt::format("The modes leave {:.1f} % of the power of the response{}{} "
                       "unexplained: look at the fit before using them.",
                       100 * (1 - explained), r.shared ? " " : "",
                       r.responses[q].name)});
    }
  }
}

void add_delay_warning(const structure::Delay& delay, std::string_view of,
                       Warnings& warnings) {
  const double us = 1e6 * delay.time.value;
  warnings.push_back(
      {"time_delay",
       fmt::format(
           "The response{} comes {:.3g} +- {:.2g} us {} the force. The program removed "
           "this delay: it changes the mass of the lightest mode by {:+.1f} %. Channels "
           "that are sampled one after the other cause it, or a filter in one of them.",
           of, std::abs(us), 1e6 * base::normal_interval * delay.time.se,
           us > 0 ? "after" : "before", 100 * delay.mass_error)});
}

void add_complex_warning(const structure::ComplexCheck& check, Warnings& warnings) {
  if (check.complex()) {
    warnings.push_back(
        {"complex_modes",
         fmt::format(
             "Real modes do not describe this response: {} complex one{} likelier, "
             "the criterion is less by {:.0f}; at {} the imaginary part is "
             "{:.1f} % of the shape. A damper in one place does that, and so does "
             "a delay between the channels. [frf] shapes = \"complex\" fits them.",
             check.fit.modes.size(), check.fit.modes.size() == 1 ? " is" : "s are",
             check.evidence, hertz(check.omega), 100 * check.imaginary)});
  }
}

}  // namespace trochoid::run
