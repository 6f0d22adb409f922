#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/cli/deliver.h>
#include <trochoid/cli/given_case.h>
#include <trochoid/run/vibration/actuator.h>
#include <trochoid/run/vibration/modes.h>

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

}  // namespace

int modes(const Options& options) {
  const bool any = !options.kind.empty() || options.modes > 0 || options.dataset > 0 ||
                   !options.band.empty();
  if (is_case(options.file)) {
    refuse_for_case(options, any, "--kind, --modes, --band and --dataset", "[frf]");
    return deliver(
        results::answer_of(run::modes(given_case(options, base::Command::modes))),
        options);
  }
  inputs::MachineTables machine;
  machine.frf =
      inputs::FrfTables{.file = options.file.string(),
                        .kind = base::named<structure::ResponseKind>(options.kind),
                        .dataset = options.dataset,
                        .modes = options.modes,
                        .band = options.band};
  return deliver(
      results::answer_of(run::modes(bare_case(options, machine, base::Command::modes))),
      options);
}

int actuator(const Options& options) {
  if (is_case(options.file)) {
    refuse_for_case(options, options.step_um || options.start_s,
                    "--step-um and --start-s", "[step]");
    return deliver(
        results::answer_of(run::actuator(given_case(options, base::Command::actuator))),
        options);
  }
  inputs::MachineTables machine;
  machine.step =
      inputs::StepTables{.file = options.file.string(), .start = options.start_s};
  if (options.step_um) {
    machine.step->step = *options.step_um * 1e-6;
  }
  return deliver(results::answer_of(run::actuator(
                     bare_case(options, machine, base::Command::actuator))),
                 options);
}

}  // namespace trochoid::cli
