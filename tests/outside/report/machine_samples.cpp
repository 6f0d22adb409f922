#include "machine_samples.h"

#include <trochoid/cases/case.h>
#include <trochoid/run/commands.h>
#include <trochoid/run/modes.h>
#include <trochoid/run/shared_modes.h>

namespace sample {

namespace {

using trochoid::results::Answer;
namespace cases = trochoid::cases;

const std::filesystem::path examples = TROCHOID_EXAMPLES;

}  // namespace

Answer modes() {
  return answer_of(trochoid::run::modes(
      cases::read_case(examples / "tap_test/case.toml", cases::Command::modes)));
}

Answer shared_modes() {
  cases::MachineTables machine;
  machine.frf = cases::FrfTables{
      .source = {.file = trochoid::files::file_at(
                     (examples / "several_responses/tool.uff").string())},
      .modes = 2};
  return answer_of(trochoid::run::shared_modes(
      cases::bare_case(machine, cases::Command::modes, {})));
}

Answer actuator() {
  return answer_of(trochoid::run::actuator(
      cases::read_case(examples / "tap_test/case.toml", cases::Command::actuator)));
}

Answer motion() {
  return answer_of(
      trochoid::run::dynamics(cases::read_case(examples / "runout_table_8mm/sine.toml",
                                               cases::Command::dynamics),
                              {}));
}

Answer correction() {
  return answer_of(
      trochoid::run::correct(cases::read_case(examples / "runout_correction/case.toml",
                                              cases::Command::correct),
                             true, {}));
}

Answer chatter() {
  return answer_of(
      trochoid::run::dynamics(cases::read_case(examples / "stability_922Hz/case.toml",
                                               cases::Command::dynamics),
                              {}));
}

Answer tool_point() {
  cases::Case given =
      cases::read_case(examples / "measured_frf/case.toml", cases::Command::stability);
  cases::Stability& diagram = *given.machine.stability;
  diagram.spindle_speed->count = 9;
  diagram.axial_depth->count = 8;
  diagram.harmonics = 2;
  return answer_of(trochoid::run::stability(given, {}));
}

Answer plan() {
  return answer_of(trochoid::run::plan(
      cases::read_case(examples / "plan_next_cut/case.toml", cases::Command::plan),
      {}));
}

}  // namespace sample
