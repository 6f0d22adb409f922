#include <trochoid/run/identify.h>

#include <trochoid/base/units.h>
#include <trochoid/identification/alternatives.h>
#include <trochoid/signal/axes.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

/// A reading of the channels that leaves this much less than the given one is the cure of
/// a fit that must not be used.
constexpr double much_better = 0.5;
/// Of a fit that may be used, one that leaves this much less is worth a word.
constexpr double better = 0.8;

bool axes_were_given(const cases::Case& given) {
  return !given.dynamometer || !given.dynamometer->automatic;
}

base::Warning likely(std::string message) {
  return {"likely_cause", std::move(message)};
}

/// @brief What the channels read, if that leaves so much less than the given reading.
/// @param least  of the rms that the given reading leaves
/// @return a sentence, or nothing
std::string better_axes(const cases::Case& given, const std::vector<MeasuredRun>& runs,
                        const signal::Matrix3& M, double least,
                        const Progress& progress) {
  const auto problem = axes_problem(given);
  const auto channels = channels_of(runs);
  const auto other = identification::better_axes(
      problem, channels, M, least, [&](double part) { progress(axes_progress(part)); });
  if (!other) return "";
  // A fit that may be used is doubted only for what shows in all of it.
  const bool usable = least > much_better;
  if (usable &&
      !identification::fits_better(problem, channels, M, other->matrix, least)) {
    return "";
  }
  const auto names = signal::axes_names(other->matrix);
  std::string times;
  if (std::isfinite(other->stated_rms)) {
    times =
        fmt::format(", which leaves {:.1f} times less", other->stated_rms / other->rms);
  }
  return fmt::format(
      "The axes of the dynamometer: with axes = \"auto\" in [dynamometer] the channels "
      "read {}, {}, {} of the force on the tool{}.",
      names[0], names[1], names[2], times);
}

/// `2.4 times`, or `far` where one explains all and the other nothing.
std::string how_much(double now, double other) {
  constexpr double far = 100.0;
  return now < far * other ? fmt::format("{:.1f} times", now / other)
                           : std::string("far");
}

/// @return a sentence, or nothing
std::string better_cut(const cases::Case& given, const std::vector<MeasuredRun>& runs,
                       const signal::Matrix3& M) {
  const auto found = identification::better_cut(
      given.setup, given.law, identification::on_tool(channels_of(runs), M),
      fit_options(given, given.identify.chip_models.back()));
  if (!found) return "";
  const std::string less = how_much(found->stated_rms, found->rms);
  if (found->turns_with_spindle != 0) {
    return fmt::format(
        "The dynamometer: x and y seem to turn with the spindle, as in records of a "
        "rotating dynamometer. It reads u and v: write axes = [\"u\", \"{}v\", \"z\"] and "
        "sensor_deg in [dynamometer], and columns = [...] in [[measurement]] if the "
        "columns have other names. With x and y turned back the fit leaves {} less.",
        found->turns_with_spindle > 0 ? "-" : "", less);
  }
  return found->teeth
             ? fmt::format(
                   "The number of teeth: with teeth = {} (and the same feed in a turn) "
                   "the fit leaves {} less than with {}. A spindle with {:.4g} times the "
                   "stated speed would look the same.",
                   *found->teeth, less, given.setup.cutter.teeth(),
                   static_cast<double>(*found->teeth) / given.setup.cutter.teeth())
             : fmt::format(
                   "Up for down: with engagement = \"{}\" the fit leaves {} less.",
                   found->up ? "up" : "down", less);
}

}  // namespace

std::vector<base::Warning> likely_causes(const cases::Case& given,
                                         const std::vector<MeasuredRun>& runs,
                                         const signal::Matrix3& M,
                                         const Progress& progress) {
  if (axes_were_given(given)) {
    const std::string found = better_axes(given, runs, M, much_better, progress);
    if (!found.empty()) {
      return {likely(found)};
    }
  }
  const std::string cut = better_cut(given, runs, M);
  if (!cut.empty()) return {likely(cut)};
  std::vector<base::Warning> out;
  if (axes_were_given(given)) {
    out.push_back(
        likely("The axes or the sign of the force: a table dynamometer feels the "
               "reaction, axes = [\"-x\", \"-y\", \"-z\"]; axes = \"auto\" tries all "
               "readings (no other reading fits much better; one with other signs may "
               "fit equally well)."));
  }
  const bool by_time = std::any_of(runs.begin(), runs.end(),
                                   [](const MeasuredRun& run) { return run.by_time; });
  if (by_time) {
    out.push_back(likely(fmt::format(
        "spindle_rpm = {:g}: the record is searched for its speed within 5 % of this "
        "only; a multiple or a fraction of the true speed looks periodic too.",
        given.setup.cut.Omega / unit::rpm)));
  }
  const auto offsets = given.identify.channel_offsets;
  if (offsets == cases::ChannelOffset::none ||
      offsets == cases::ChannelOffset::automatic) {
    out.push_back(
        likely("An offset of the channels: try "
               "channel_offsets = \"fit\" in [identify]."));
  }
  out.push_back(
      likely("Tool or cut: number and pitch of the teeth, "
             "feed per tooth, engagement, depth."));
  return out;
}

std::vector<base::Warning> look_at_channels(const cases::Case& given,
                                            const std::vector<MeasuredRun>& runs,
                                            const signal::Matrix3& M,
                                            const Progress& progress) {
  if (!axes_were_given(given)) {
    return {};
  }
  const std::string found = better_axes(given, runs, M, better, progress);
  return found.empty() ? std::vector<base::Warning>{}
                       : std::vector<base::Warning>{{"axes_fit_better", found}};
}

std::vector<base::Warning> look_at_cut(const cases::Case& given,
                                       const std::vector<MeasuredRun>& runs,
                                       const signal::Matrix3& M) {
  const std::string found = better_cut(given, runs, M);
  return found.empty() ? std::vector<base::Warning>{}
                       : std::vector<base::Warning>{{"cut_fits_better", found}};
}

}  // namespace trochoid::run
