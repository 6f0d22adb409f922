#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/correction/static_fit.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::cases {

namespace {

constexpr double most_speeds = 2000;

void check_shape(const Correction& c, Findings& findings) {
  const correction::CorrectionOptions& o = c.options;
  const bool in_time = o.strategy == correction::Method::inverse_in_time;
  if (in_time && o.shape != correction::Shape::sine &&
      o.shape != correction::Shape::quintic &&
      o.shape != correction::Shape::harmonics) {
    report(findings, "correct.strategy",
           "correct.strategy = \"inverse_in_time\": needs a motion without corners; "
           "must go with shape = \"quintic\", \"sine\" or \"harmonics\"");
  }
}

void check_runout_known(const CaseTables& t, Findings& findings) {
  if (geometry::runs_true(t.runout) && t.measurements.empty() &&
      sound(findings, {"runout", "runout.radial_offsets_mm", "runout.eccentricity_mm",
                       "measurement"})) {
    report(findings, "runout",
           "[runout]: there is none, so that nothing is to be corrected; give "
           "radial_offsets_mm or eccentricity_mm, or a [[measurement]] of the forces");
  }
}

}  // namespace

void check_correct(CaseTables& t, Findings& findings) {
  if (!t.machine.correct) {
    t.machine.correct.emplace();
  }
  Correction& c = *t.machine.correct;
  if (!c.spindle_speed) {
    c.spindle_speed = base::Steps{200 * unit::rpm, 10000 * unit::rpm, 50};
  }
  check_steps(c.spindle_speed, "correct.spindle_rpm", "speeds", most_speeds, findings);
  check_shape(c, findings);
  if (t.tool.teeth < 2 && sound(findings, {"tool.teeth"})) {
    report(findings, "tool.teeth",
           fmt::format("tool.teeth = {}: one tooth follows itself and feels no runout; "
                       "correct needs 2 or more",
                       t.tool.teeth));
  }
  if (t.measurements.size() > 1) {
    report(findings, "measurement[2].file",
           "[[measurement]]: correct takes one record; must not be given twice");
  }
  if (!t.measurements.empty() &&
      !correction::power_near(force::law_kinds[base::index(t.force.law)]) &&
      sound(findings, {"force.law"})) {
    report(findings, "force.law",
           "force.law: correct finds the runout in a record with a power law; must be "
           "\"power\" with a [[measurement]] (without one, any law)");
  }
  check_runout_known(t, findings);
  if (t.machine.controller && t.machine.controller->index_lost_at > 0 &&
      t.machine.controller->index_lost_at >= t.machine.controller->turns &&
      sound(findings, {"controller.turns", "controller.index_lost_at_turn"})) {
    report(
        findings, "controller.index_lost_at_turn",
        fmt::format("controller.index_lost_at_turn = {}: after the last of {} turns; "
                    "must be one of them",
                    t.machine.controller->index_lost_at, t.machine.controller->turns));
  }
}

}  // namespace trochoid::cases
