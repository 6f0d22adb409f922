#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/cli/given_case.h>
#include <trochoid/cli/work_on.h>
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
  if (given && is_case(options.file)) {
    throw base::InputError({options.file.string() + ":1:1: the options " + names +
                            " go with a bare data file; in a case they are keys of " +
                            table});
  }
  if (!options.set.empty() && !is_case(options.file)) {
    throw base::InputError({options.file.string() +
                            ": --set goes with a case, and this is a bare data file"});
  }
}

/// The case that is named, or that of a bare data file.
inputs::Case case_of(const Options& options, const inputs::MachineTables& machine,
                     base::Command command) {
  return is_case(options.file) ? given_case(options, command)
                               : bare_case(options, machine, command);
}

}  // namespace

int modes(const Options& options) {
  const bool any = !options.kind.empty() || options.modes > 0 || options.dataset > 0 ||
                   !options.band.empty();
  refuse_for_case(options, any, "--kind, --modes, --band and --dataset", "[frf]");
  inputs::MachineTables machine;
  machine.frf =
      inputs::FrfTables{
          .source = {.file = inputs::file_at(options.file.string()),
                     .kind = base::named<structure::ResponseKind>(options.kind),
                     .dataset = options.dataset},
                        .modes = options.modes,
                        .band = options.band};
  const inputs::Case given = case_of(options, machine, base::Command::modes);
  return work_on(given, options, base::Command::modes,
                 [&](const run::Progress& progress, base::Stop /*stop*/) {
                   progress("Fitting the modes");
                   return run::modes_are_shared(given)
                              ? results::answer_of(run::shared_modes(given))
                              : results::answer_of(run::modes(given));
                 });
}

int actuator(const Options& options) {
  refuse_for_case(options, options.step_um || options.start_s,
                  "--step-um and --start-s", "[step]");
  inputs::MachineTables machine;
  machine.step =
      inputs::StepTables{.source = {.file = inputs::file_at(options.file.string()), .start = options.start_s}};
  if (options.step_um) {
    machine.step->source.step = *options.step_um * 1e-6;
  }
  const inputs::Case given = case_of(options, machine, base::Command::actuator);
  return work_on(given, options, base::Command::actuator,
                 [&](const run::Progress& progress, base::Stop /*stop*/) {
                   progress("Fitting the step");
                   return results::answer_of(run::actuator(given));
                 });
}

}  // namespace trochoid::cli
