#include <trochoid/run/vibration.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

using dynamics::Bounded;
using dynamics::Motion;
using dynamics::Periodic;
using dynamics::SteadyState;
using Warnings = std::vector<base::Warning>;

/// How far the start of a step may lie from what the command shows, in standard errors.
constexpr double start_slack = 3.0;

void warn_floor(const dynamics::Stability& stability, Warnings& warnings) {
  if (stability.floor && !stability.floor->decided) {
    warnings.push_back(
        {"chip_floor",
         fmt::format(
             "The slope of a power law grows without limit where the chip begins: "
             "with half and twice chip_floor_um the multiplier is {:.4f} and "
             "{:.4f}. Take the verdict as open.",
             stability.floor->at_half, stability.floor->at_twice)});
  }
}

void warn_modes(const cases::Case& given, Warnings& warnings) {
  const auto left_out = std::count_if(
      given.machine.modes.begin(), given.machine.modes.end(),
      [](const cases::Mode& mode) { return mode.axis == cases::Axis::z; });
  if (left_out > 0) {
    warnings.push_back({"mode_along_z",
                        fmt::format("{} of the modes move along z, which the chip does "
                                    "not feel: left out.",
                                    left_out)});
  }
}

}  // namespace

void warn_one_direction(const cases::Case& given, Warnings& warnings) {
  bool x = false;
  bool y = false;
  for (const cases::Mode& mode : given.machine.modes) {
    if (mode.axis == cases::Axis::z) continue;
    const bool askew = mode.angle != 0.0;
    x = x || askew || mode.axis == cases::Axis::x;
    y = y || askew || mode.axis == cases::Axis::y;
  }
  for (const cases::MeasuredFrf& frf : given.machine.measured_frfs) {
    x = x || frf.axis == cases::Axis::x;
    y = y || frf.axis == cases::Axis::y;
  }
  if (x == y) return;
  warnings.push_back(
      {"one_direction",
       fmt::format(
           "All that vibrates moves along {}: the tool counts as rigid along {}. "
           "If it is not, the true limit depth can be much lower: measure along "
           "{}, too.",
           x ? "x" : "y", x ? "y" : "x", x ? "y" : "x")});
}

namespace {

std::string linear_text(const std::optional<double>& linear_growth) {
  if (!linear_growth) {
    return "the vibration does not die out";
  }
  if (*linear_growth > 1) {
    return fmt::format("a small vibration grows to {:.4g} of itself in each turn",
                       *linear_growth);
  }
  return fmt::format(
      "the linearised cut is stable (a small vibration fades to {:.4g} of itself in "
      "each turn), the motion is not",
      *linear_growth);
}

std::string amplitude_text(const Bounded& bounded) {
  std::string text = fmt::format(
      "it stays within {:.4g} um of its middle along x and {:.4g} um along y over the "
      "last {} turns",
      bounded.amplitude[0] / unit::um, bounded.amplitude[1] / unit::um, bounded.turns);
  if (const auto* line = dynamics::chatter_line(bounded)) {
    text += fmt::format(
        ", strongest at {:.5g} Hz ({:.3g} um along x, {:.3g} um along y)",
        line->frequency, line->amplitude[0] / unit::um, line->amplitude[1] / unit::um);
  }
  return text;
}

std::string chatter_warning(const SteadyState& steady,
                            const std::optional<double>& linear_growth) {
  const std::string text = "Chatter: " + linear_text(linear_growth) + "; ";
  if (const auto* periodic = std::get_if<Periodic>(&steady.verdict)) {
    return text +
           fmt::format(
               "the motion repeats {} only, where the cut repeats {}.",
               dynamics::period_text(*periodic, steady.motion.flutes.size()),
               periodic->passes_of_cut == 1 ? "with every tooth" : "with every turn");
  }
  return text + amplitude_text(std::get<Bounded>(steady.verdict)) +
         ". Peaks are the largest of these turns, chip areas their means.";
}

}  // namespace

Warnings stability_warnings(const cases::Case& given,
                            const dynamics::StabilityOptions& options,
                            const dynamics::Stability& stability) {
  Warnings warnings;
  warn_floor(stability, warnings);
  warn_modes(given, warnings);
  warn_one_direction(given, warnings);
  if (!stability.cuts) {
    warnings.push_back(
        {"no_cut", "No tooth cuts anything: nothing but damping is left."});
  }
  const dynamics::Multiplier& mu = stability.multiplier;
  if (mu.error > options.tolerance * std::max(1.0, std::abs(mu.value))) {
    warnings.push_back(
        {"tolerance", fmt::format("The multiplier is good to {:.1e} only.", mu.error)});
  }
  return warnings;
}

Warnings motion_warnings(const cases::Case& given, const SteadyState& steady,
                         const std::optional<double>& linear_growth) {
  Warnings warnings;
  const bool chatter = dynamics::chatters(steady.verdict);
  if (chatter) {
    warnings.push_back({"chatter", chatter_warning(steady, linear_growth)});
    if (given.setup.process_damping.acts()) {
      warnings.push_back(
          {"process_damping_of_chatter",
           "Process damping is modelled for small vibrations, on the way out as much "
           "as on the way in. It shows where chatter begins, but the true amplitude of "
           "chatter is different."});
    }
  } else if (std::holds_alternative<Bounded>(steady.verdict)) {
    warnings.push_back(
        {"not_periodic",
         fmt::format("The force still changes by {:.3g} N from turn to turn, less and "
                     "less: ask for more revolutions. Peaks are from the last turn.",
                     steady.motion.last_change)});
  }
  if (!chatter && linear_growth.value_or(0.0) > dynamics::chatter_growth) {
    warnings.push_back(
        {"linear_unstable",
         fmt::format(
             "The linearised cut is unstable (a small vibration grows to {:.4g} "
             "of itself in each turn), the motion is not: the linear picture "
             "fails where chips are thin, or the vibration is still too small "
             "to be seen. The motion counts; ask for more revolutions.",
             *linear_growth)});
  }
  const cases::Sampling& sampling = given.sampling;
  if (sampling.start != 0 || !sampling.angles.empty()) {
    warnings.push_back(
        {"sampling_ignored",
         fmt::format(
             "[sampling] {} has no meaning here and is ignored: a motion begins "
             "with the tip of tooth 1 at theta = 0 and is written at "
             "samples_per_rev equal steps.",
             sampling.angles.empty() ? "start_deg" : "angles_deg")});
  }
  return warnings;
}

void add_tap_warnings(const signal::TapResponse& tap, Warnings& warnings) {
  for (const signal::TapHit& hit : tap.hits) {
    if (!hit.fault.empty()) {
      warnings.push_back(
          {"hit_left_out",
           fmt::format("The hit at {:.4g} s is left out: {}.", hit.time, hit.fault)});
    }
  }
  if (!tap.fault.empty()) {
    return;
  }
  warnings.push_back(
      {"hammer_band",
       fmt::format(
           "Lines above {:.4g} Hz are left out: the force of the hammer is more "
           "than 20 dB down there. A harder tip excites more.",
           tap.excited / unit::Hz)});
  if (tap.decay > 0) {
    warnings.push_back(
        {"exponential_window",
         fmt::format(
             "The response still rings at the end of its blocks of {:.3g} s: an "
             "exponential window takes it to {:.3g} %. Its damping is taken out "
             "of the modes.",
             tap.block, 100 * tap.window_end)});
  }
  if (tap.coherence.empty()) {
    warnings.push_back(
        {"one_hit", "One hit has no coherence: strike three times and more."});
  }
}

void add_actuator_warnings(const structure::StepRecord& record,
                           const structure::ActuatorFit& fit, Warnings& warnings) {
  if (fit.dynamics.gain < 0) {
    warnings.push_back(
        {"negative_gain",
         "The actuator moves against its command: is the sensor reversed? "
         "actuator.toml is not written."});
  }
  if (!record.change || record.start) {
    return;
  }
  const double late = fit.start - (*record.change)[1];
  const double early = (*record.change)[0] - fit.start;
  if (std::max(late, early) > start_slack * fit.start_se) {
    warnings.push_back(
        {"start_differs",
         fmt::format("The motion fits a step {:.3g} ms {} than the command shows it{}",
                     1e3 * std::max(late, early), late > early ? "later" : "earlier",
                     late > early
                         ? ": a dead time, or a third pole, which the two poles "
                           "of the model do not have."
                         : ": check the times of the record.")});
  }
}

std::string motion_message(const SteadyState& steady) {
  const std::string after = fmt::format("After {} turns ", steady.motion.turns_done);
  if (const auto* periodic = std::get_if<Periodic>(&steady.verdict)) {
    return after +
           (periodic->several_periods() ? "the cut chatters: the motion repeats "
                                        : "the motion repeats itself ") +
           dynamics::period_text(*periodic, steady.motion.flutes.size()) + '.';
  }
  const auto& bounded = std::get<Bounded>(steady.verdict);
  return after + (bounded.fades ? "the motion has not settled."
                                : "the cut chatters: the motion stays bounded and does "
                                  "not repeat itself.");
}

std::string growth_message(const SteadyState& steady,
                           const std::optional<double>& linear_growth) {
  const Motion& motion = steady.motion;
  const std::string text = "chatter: " + linear_text(linear_growth);
  if (!motion.finite) {
    return text + fmt::format(
                      "; after {} turns the tool is more than {:.0f} mm from "
                      "where it would rest: far out of the cut",
                      motion.turns_done, dynamics::run_away / unit::mm);
  }
  const auto& seen = std::get<dynamics::Growing>(steady.verdict).per_turn;
  return text +
         fmt::format("; after {} turns the vibration still grows{}", motion.turns_done,
                     seen ? fmt::format(", to {:.4g} of itself in each turn", *seen)
                          : std::string());
}

}  // namespace trochoid::run
