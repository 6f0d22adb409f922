#include <trochoid/run/correction_words.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::run {

namespace {

/// A chip area that differs so much where the peaks do not is worth a word.
constexpr double unequal_area = 0.1;
/// Part of the chip differences that one axis should be able to take away.
constexpr double one_axis_enough = 0.8;

void add_limit_warnings(const CorrectionFindings& f, results::Answer& answer) {
  for (const correction::Limit& l : f.plan.limits.limits) {
    if (l.known && !l.ok) {
      answer.heading.warnings.push_back({"beyond_limit", l.reason});
    }
  }
}

/// Of the tooth that stands out most against the one before it.
std::string runout_line(const CorrectionSetting& s) {
  const std::vector<double> h_ro = chip_differences(s.rho);
  const auto most = std::max_element(h_ro.begin(), h_ro.end());
  const auto j = static_cast<std::size_t>(most - h_ro.begin());
  std::string text = fmt::format("tooth {} cuts {:.2f} um more than the feed", j + 1,
                                 *most / unit::um);
  if (s.fit && s.fit->ok) {
    text += fmt::format("; a rigid model reads {:.2f} um from the forces",
                        s.fit->h_ro[j].value / unit::um);
  }
  if (s.ratio && s.ratio->ok) {
    text +=
        fmt::format(", the ratio of the peaks {:.2f} um", s.ratio->h_ro[j] / unit::um);
  }
  return text + "\n";
}

}  // namespace

void add_correction_warnings(const CorrectionFindings& f,
                             const correction::AxisLimits& axes,
                             results::Answer& answer) {
  add_limit_warnings(f, answer);
  const dynamics::Motion& after = f.moved.after;
  if (!periodic(f.moved.before) || !periodic(after)) {
    answer.heading.warnings.push_back(
        {"not_periodic",
         fmt::format("The force still changes by {:.3g} N from turn to turn: a "
                     "difference between flutes means little then.",
                     std::max(f.moved.before.last_change, after.last_change))});
  }
  if (area_difference_of(after) > unequal_area) {
    answer.heading.warnings.push_back(
        {"unequal_chips",
         fmt::format("Equal peaks are not equal chips: the flutes still cut areas that "
                     "differ by {:.0f} % ({:.0f} % before).",
                     100 * area_difference_of(after),
                     100 * area_difference_of(f.moved.before))});
  }
  if (axes.most_teeth > 1 && axes.one_axis > (1 - one_axis_enough) * axes.uncorrected) {
    answer.heading.warnings.push_back(
        {"several_teeth_in_cut",
         fmt::format(
             "{} teeth cut at once: one axis can take the chip differences from {:.3g} "
             "to {:.3g} um at best, two axes to {:.3g} um (root mean square).",
             axes.most_teeth, axes.uncorrected / unit::um, axes.one_axis / unit::um,
             axes.two_axes / unit::um)});
  }
  if (f.setting.fit && f.setting.designed_for != f.setting.rho) {
    answer.heading.warnings.push_back(
        {"static_estimate",
         fmt::format("The command is made for what a rigid model reads from the forces "
                     "({:.3g} um between tooth 1 and the one before); {:.3g} um are "
                     "there, as tool and table give way.",
                     chip_differences(f.setting.designed_for)[0] / unit::um,
                     chip_differences(f.setting.rho)[0] / unit::um)});
  }
}

std::string correction_table(const CorrectionFindings& f) {
  std::string text =
      runout_line(f.setting) + fmt::format("{:>5} {:>16} {:>16} {:>18} {:>18}\n",
                                           "tooth", "|Fy| before N", "|Fy| after N",
                                           "area before mm rad", "area after mm rad");
  for (std::size_t j = 0; j < f.moved.before.flutes.size(); ++j) {
    const dynamics::FluteMotion& a = f.moved.before.flutes[j];
    const dynamics::FluteMotion& b = f.moved.after.flutes[j];
    text +=
        fmt::format("{:>5} {:>16.3f} {:>16.3f} {:>18.5f} {:>18.5f}\n", j + 1, a.peak_y,
                    b.peak_y, a.chip_area / unit::mm, b.chip_area / unit::mm);
  }
  const double before = difference_of(f.moved.before);
  const double after = difference_of(f.moved.after);
  text += fmt::format("difference of the peaks: {:.2f} % before, {:.2f} % after\n",
                      100 * before, 100 * after);
  const correction::Range range = correction::range_of(f.plan.command.wave);
  text += fmt::format(
      "command: {:.2f} um peak to peak about {:.2f} um, for a motion of "
      "{:.2f} um\n",
      range.peak_to_peak() / unit::um, f.plan.limits.offset / unit::um,
      correction::range_of(f.plan.motion).peak_to_peak() / unit::um);
  text += fmt::format("the table stays within {:.2f} um of it while it is cut upon\n",
                      table_deviation(f) / unit::um);
  for (const correction::Limit& l : f.plan.limits.limits) {
    text += fmt::format("  {}{}\n", l.known && !l.ok ? "BEYOND: " : "", l.reason);
  }
  text += fmt::format("highest speed for {:.0f} % (rigid cut):",
                      100 * f.wanted.allowed_difference);
  const double highest_looked_at = f.wanted.spindle_speed->last;
  for (std::size_t s = 0; s < f.map.strategies.size(); ++s) {
    const bool beyond = f.map.highest[s] >= highest_looked_at;
    text += fmt::format(" {} {}{:.0f} rpm{}", f.map.strategies[s].name,
                        beyond ? "above " : "", f.map.highest[s] / unit::rpm,
                        s + 1 < f.map.strategies.size() ? "," : "\n");
  }
  return text;
}

}  // namespace trochoid::run
