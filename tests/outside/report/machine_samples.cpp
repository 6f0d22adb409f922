#include "machine_samples.h"

#include <trochoid/inputs/case.h>
#include <trochoid/run/actuator.h>
#include <trochoid/run/correct.h>
#include <trochoid/run/dynamics.h>
#include <trochoid/run/modes.h>

namespace sample {

namespace {

using trochoid::results::Answer;
namespace inputs = trochoid::inputs;

const std::filesystem::path examples = TROCHOID_EXAMPLES;

}  // namespace

Answer modes() {
  return trochoid::run::modes(
      inputs::read_case(examples / "tap_test/case.toml", inputs::Command::modes));
}

Answer actuator() {
  return trochoid::run::actuator(
      inputs::read_case(examples / "tap_test/case.toml", inputs::Command::actuator));
}

Answer motion() {
  return trochoid::run::dynamics(
      inputs::read_case(examples / "runout_table_8mm/sine.toml",
                        inputs::Command::dynamics),
      {});
}

Answer correction() {
  return trochoid::run::correct(
      inputs::read_case(examples / "runout_correction/case.toml",
                        inputs::Command::correct),
      true, {});
}

Answer chatter() {
  return trochoid::run::dynamics(
      inputs::read_case(examples / "stability_922Hz/case.toml",
                        inputs::Command::dynamics),
      {});
}

}  // namespace sample
