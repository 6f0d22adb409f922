#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/cli/deliver.h>
#include <trochoid/cli/given_case.h>
#include <trochoid/cli/progress_line.h>
#include <trochoid/cli/time_limit.h>
#include <trochoid/run/answer.h>
#include <trochoid/run/commands.h>

#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <string>
#include <utility>

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

/// Of a measured frequency response without a case.
cases::MachineTables frf_alone(const Options& options) {
  const bool any = !options.kind.empty() || options.modes > 0 || options.dataset > 0 ||
                   !options.band.empty();
  refuse_for_case(options, any, "--kind, --modes, --band and --dataset", "[frf]");
  cases::MachineTables machine;
  machine.frf = cases::FrfTables{
      .source = {.file = files::file_at(options.file.string()),
                 .kind = base::named<structure::ResponseKind>(options.kind),
                 .dataset = options.dataset},
      .modes = options.modes,
      .band = options.band};
  return machine;
}

/// Of the record of a step without a case.
cases::MachineTables step_alone(const Options& options) {
  refuse_for_case(options, options.step_um || options.start_s,
                  "--step-um and --start-s", "[step]");
  cases::MachineTables machine;
  machine.step =
      cases::StepTables{.source = {.file = files::file_at(options.file.string()),
                                   .start = options.start_s}};
  if (options.step_um) {
    machine.step->source.step = *options.step_um * 1e-6;
  }
  return machine;
}

/// The case that is named, or that of a bare data file.
cases::Case case_for(base::Command command, const Options& options) {
  const bool of_data =
      command == base::Command::modes || command == base::Command::actuator;
  if (!of_data) {
    return given_case(options, command);
  }
  const cases::MachineTables alone =
      command == base::Command::modes ? frf_alone(options) : step_alone(options);
  return is_case(options.file) ? given_case(options, command)
                               : bare_case(options, alone, command);
}

/// What these have found before they are done is an answer.
bool ends_by_itself(base::Command command) {
  return command == base::Command::stability || command == base::Command::identify;
}

/// That there is none, for lack of time.
results::Answer no_answer_in_time(const cases::Case& given, const Options& options,
                                  base::Command command, const std::string& doing) {
  results::Heading heading = run::heading_of(given);
  heading.ok = false;
  heading.message = fmt::format(
      "the time limit of {:g} s has passed and there is no answer yet (at last: {}); "
      "give it more time, or the command less to do",
      *options.time_limit, doing);
  return {.command = std::string(name_of(command)), .heading = std::move(heading)};
}

/// Of the program, from a thread beside the work.
[[noreturn]] void end_with(const results::Answer& answer,
                           const Options& options) noexcept {
  int code = our_bug;
  try {
    code = deliver(answer, options);
  } catch (const base::InputError& error) {
    complain(error.what());
    code = wrong_input;
  } catch (const std::exception& error) {
    complain(fmt::format("trochoid: {}\n", error.what()));
  }
  std::fflush(stdout);
  std::_Exit(code);
}

}  // namespace

int answer(base::Command command, const Options& options) {
  const cases::Case given = case_for(command, options);
  const auto found = [&] {
    ProgressLine progress(talk_of(options));
    const TimeLimit limit(options.time_limit, ends_by_itself(command), [&] {
      end_with(no_answer_in_time(given, options, command, progress.doing()), options);
    });
    return run::answer(command, given,
                       {.curves = options.curves,
                        .moves = options.moves,
                        .simulate_controller = options.simulate_controller,
                        .anyway = options.anyway},
                       std::ref(progress), limit.stop());
  };
  // What the run knows is let go of before it is written.
  return deliver(found(), options);
}

}  // namespace trochoid::cli
