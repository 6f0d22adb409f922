#include <trochoid/run/correct/correct.h>
#include <trochoid/run/shared/heading.h>
#include <trochoid/run/shared/machine.h>

#include <trochoid/run/correct/problem.h>
#include <trochoid/run/correct/warnings.h>

#include <fmt/core.h>

#include <utility>

namespace trochoid::run {

namespace {

std::string headline(const correction::BeforeAfter& cuts) {
  return fmt::format(
      "The flutes' peaks differ by {:.2f} % with the command, {:.2f} % without.",
      100 * dynamics::peak_difference(cuts.after.motion),
      100 * dynamics::peak_difference(cuts.before.motion));
}

/// The limit that the command comes nearest to; empty: none is known.
std::string nearest_limit(const correction::LimitReport& report) {
  const correction::Limit* nearest = nullptr;
  const auto share = [](const correction::Limit& l) { return l.value / l.limit; };
  for (const correction::Limit& limit : report.limits) {
    const bool counts = limit.known && limit.limit > 0;
    if (counts && (nearest == nullptr || share(limit) > share(*nearest))) {
      nearest = &limit;
    }
  }
  if (nearest == nullptr) return {};
  return fmt::format(" {}: {}.",
                     report.ok ? "Nearest to its limit" : "Beyond its limit",
                     nearest->reason);
}

}  // namespace

results::CorrectResult correct(const inputs::Case& given, bool controller,
                               const Progress& progress) {
  results::CorrectResult r{.heading = heading_of(given)};
  r.heading.ok = false;
  const auto problem = correction_problem(given, controller, r.heading.warnings);
  r.options = problem.options;
  const int steps = dynamics::steps_needed(correction::problem_of(problem.cut, {}));
  if (steps > dynamics::most_steps) {
    r.heading.message = too_many_steps(steps);
    return r;
  }
  r.correction = correction::correct(problem, progress);
  const correction::Correction& c = r.correction;
  add_setting_warnings(c.setting, r.heading.warnings);
  if (!c.ok) {
    r.heading.message = c.reason;
    return r;
  }
  add_correction_warnings(c, r.heading.warnings);
  r.heading.ok = !c.controller || c.controller->ok;
  r.heading.message = r.heading.ok ? headline(c.cuts) + nearest_limit(c.plan.limits)
                                   : c.controller->reason;
  return r;
}

}  // namespace trochoid::run
