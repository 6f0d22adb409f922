#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/vibration/actuator.h>
#include <trochoid/run/vibration/modes.h>
#include <trochoid/run/vibration/shared_modes.h>

namespace trochoid::cli {

namespace {

/// A case is a .toml file; anything else is measured data.
bool is_case(const std::filesystem::path& file) {
  return file.extension() == ".toml";
}

void refuse_for_case(const Options& options, bool given, const char* names,
                     const char* table) {
  if (given) {
    throw base::InputError({options.file.string() + ":1:1: the options " + names +
                            " go with a bare data file; in a case they are keys of " +
                            table});
  }
}

int answer_modes(const inputs::Case& given, const Options& options) {
  return deliver(run::modes_are_shared(given)
                     ? results::answer_of(run::shared_modes(given))
                     : results::answer_of(run::modes(given)),
                 options);
}

}  // namespace

int modes(const Options& options) {
  const auto folder = result_folder(options, "modes");
  const bool any = !options.kind.empty() || options.modes > 0 || options.dataset > 0 ||
                   !options.band.empty();
  if (is_case(options.file)) {
    refuse_for_case(options, any, "--kind, --modes, --band and --dataset", "[frf]");
    return answer_modes(inputs::read_case(options.file, inputs::Command::modes, folder),
                        options);
  }
  inputs::MachineTables machine;
  machine.frf =
      inputs::FrfTables{.file = options.file.string(),
                        .kind = base::named<structure::ResponseKind>(options.kind),
                        .dataset = options.dataset,
                        .modes = options.modes,
                        .band = options.band};
  return answer_modes(inputs::bare_case(machine, inputs::Command::modes, folder),
                      options);
}

int actuator(const Options& options) {
  const auto folder = result_folder(options, "actuator");
  if (is_case(options.file)) {
    refuse_for_case(options, options.step_um || options.start_s,
                    "--step-um and --start-s", "[step]");
    return deliver(results::answer_of(run::actuator(inputs::read_case(
                       options.file, inputs::Command::actuator, folder))),
                   options);
  }
  inputs::MachineTables machine;
  machine.step =
      inputs::StepTables{.file = options.file.string(), .start = options.start_s};
  if (options.step_um) {
    machine.step->step = *options.step_um * 1e-6;
  }
  return deliver(results::answer_of(run::actuator(
                     inputs::bare_case(machine, inputs::Command::actuator, folder))),
                 options);
}

}  // namespace trochoid::cli
