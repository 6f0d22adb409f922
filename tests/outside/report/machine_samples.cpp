#include "machine_samples.h"

#include <trochoid/inputs/case.h>
#include <trochoid/run/commands.h>
#include <trochoid/run/modes.h>
#include <trochoid/run/shared_modes.h>

namespace sample {

namespace {

using trochoid::results::Answer;
namespace inputs = trochoid::inputs;

const std::filesystem::path examples = TROCHOID_EXAMPLES;

}  // namespace

Answer modes() {
  return answer_of(trochoid::run::modes(
      inputs::read_case(examples / "tap_test/case.toml", inputs::Command::modes)));
}

Answer shared_modes() {
  inputs::MachineTables machine;
  machine.frf = inputs::FrfTables{
      .source = {.file = inputs::file_at(
                     (examples / "several_responses/tool.uff").string())},
      .modes = 2};
  return answer_of(trochoid::run::shared_modes(
      inputs::bare_case(machine, inputs::Command::modes, {})));
}

Answer actuator() {
  return answer_of(trochoid::run::actuator(
      inputs::read_case(examples / "tap_test/case.toml", inputs::Command::actuator)));
}

Answer motion() {
  return answer_of(
      trochoid::run::dynamics(inputs::read_case(examples / "runout_table_8mm/sine.toml",
                                                inputs::Command::dynamics),
                              {}));
}

Answer correction() {
  return answer_of(
      trochoid::run::correct(inputs::read_case(examples / "runout_correction/case.toml",
                                               inputs::Command::correct),
                             true, {}));
}

Answer chatter() {
  return answer_of(
      trochoid::run::dynamics(inputs::read_case(examples / "stability_922Hz/case.toml",
                                                inputs::Command::dynamics),
                              {}));
}

Answer tool_point() {
  inputs::Case given = inputs::read_case(examples / "measured_frf/case.toml",
                                         inputs::Command::stability);
  inputs::Stability& diagram = *given.machine.stability;
  diagram.spindle_speed->count = 9;
  diagram.axial_depth->count = 8;
  diagram.harmonics = 2;
  return answer_of(trochoid::run::stability(given, {}));
}

Answer plan() {
  return answer_of(trochoid::run::plan(
      inputs::read_case(examples / "plan_next_cut/case.toml", inputs::Command::plan),
      {}));
}

}  // namespace sample
