#include <trochoid/results/correct.h>
#include <trochoid/results/correct_tables.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::results {

namespace {

using correction::ControllerInLoop;
using correction::Setting;

/// Of the tooth that stands out most against the one before it.
std::string runout_line(const Setting& s) {
  const std::vector<double> h_ro = correction::chip_differences(s.rho);
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

std::string flute_lines(const correction::BeforeAfter& cuts) {
  std::string text =
      fmt::format("{:>5} {:>16} {:>16} {:>18} {:>18}\n", "tooth", "|Fy| before N",
                  "|Fy| after N", "area before mm rad", "area after mm rad");
  for (std::size_t j = 0; j < cuts.before.motion.flutes.size(); ++j) {
    const dynamics::FluteMotion& a = cuts.before.motion.flutes[j];
    const dynamics::FluteMotion& b = cuts.after.motion.flutes[j];
    text +=
        fmt::format("{:>5} {:>16.3f} {:>16.3f} {:>18.5f} {:>18.5f}\n", j + 1, a.peak_y,
                    b.peak_y, a.chip_area / unit::mm, b.chip_area / unit::mm);
  }
  return text + fmt::format(
                    "difference of the peaks: {:.2f} % before, {:.2f} % "
                    "after\n",
                    100 * dynamics::peak_difference(cuts.before.motion),
                    100 * dynamics::peak_difference(cuts.after.motion));
}

std::string command_lines(const correction::Correction& c) {
  const correction::Plan& plan = c.plan;
  const correction::Range range = correction::range_of(plan.command.wave);
  std::string text = fmt::format(
      "command: {:.2f} um peak to peak about {:.2f} um, for a motion of "
      "{:.2f} um\n",
      range.peak_to_peak() / unit::um, plan.limits.offset / unit::um,
      correction::range_of(plan.motion).peak_to_peak() / unit::um);
  text += fmt::format("the table stays within {:.2f} um of it while it is cut upon\n",
                      c.cuts.table_deviation / unit::um);
  if (plan.optimum) {
    text += "  " + optimum_words(*plan.optimum) + "\n";
  }
  for (const correction::Limit& l : plan.limits.limits) {
    text += fmt::format("  {}{}\n", l.known && !l.ok ? "BEYOND: " : "", l.reason);
  }
  return text;
}

std::string speed_line(const correction::SpeedMap& map, double allowed) {
  if (map.curves.empty()) {
    return {};
  }
  std::string text = fmt::format("highest speed for {:.0f} % ({} cut):", 100 * allowed,
                                 name_of(map.cut));
  for (const correction::Curve& curve : map.curves) {
    const bool beyond = curve.highest >= map.Omega.back();
    text += fmt::format(" {} {}{:.0f} rpm,", curve.name, beyond ? "above " : "",
                        curve.highest / unit::rpm);
  }
  text.back() = '\n';
  return text;
}

std::string fault_text(const ControllerInLoop& run) {
  return fmt::format(
      "; fault \"{}\" at {:.3f} s, {}\n", trochoid_problem_name(run.fault),
      run.fault_time,
      run.time_to_safe ? fmt::format("at mid-stroke {:.3f} s later", *run.time_to_safe)
                       : "not yet at mid-stroke");
}

std::string controller_line(const ControllerInLoop& run) {
  const correction::LoopTurn* running = last_running(run);
  const std::string text = fmt::format(
      "controller: {:.2f} % before, {} running",
      100 * run.turns[correction::enabling_turn - 1].difference,
      running != nullptr ? fmt::format("{:.2f} %", 100 * running->difference)
                         : "never");
  return text + (run.fault != TROCHOID_NO_PROBLEM
                     ? fault_text(run)
                     : fmt::format("; command within {:.2f} and {:.2f} um\n",
                                   run.lowest / unit::um, run.highest / unit::um));
}

}  // namespace

std::string optimum_words(const correction::Optimum& optimum) {
  switch (optimum.optimality) {
    case correction::Optimality::equal:
      return "the flutes are made equal: no motion does better";
    case correction::Optimality::limit_of_one_axis:
      return optimum.proven
                 ? "limit of one axis: a convex problem, no motion of these harmonics "
                   "does better"
                 : fmt::format(
                       "limit of one axis in this shape: {} of {} starts ended "
                       "here, which is not a proof",
                       optimum.agreeing, optimum.starts);
    case correction::Optimality::local_minimum:
      break;
  }
  return "local minimum of a problem that is not convex: another shape or strategy may "
         "do better";
}

std::string correct_text(const CorrectResult& r) {
  const correction::Correction& c = r.correction;
  std::string text = runout_line(c.setting) + flute_lines(c.cuts) + command_lines(c) +
                     speed_line(c.speeds, r.options.allowed_difference);
  if (c.speeds.spindle) {
    const correction::SpeedModulation& m = *c.speeds.spindle;
    text += fmt::format(
        "a spindle speed that changes within the turn by up to {:.1f} % instead of the "
        "table: {:.2f} % (rigid cut), {:.3g} N m{}\n",
        100 * m.speed_change, 100 * m.peak_difference, m.torque,
        m.limit.empty() ? std::string()
                        : fmt::format("; {:.0f} % of the motion, the limit is {}",
                                      100 * m.part, m.limit));
  }
  if (c.controller && c.controller->ok) {
    text += controller_line(*c.controller);
  }
  return text;
}

}  // namespace trochoid::results
