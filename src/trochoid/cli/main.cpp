#include <trochoid/base/command.h>
#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/cli/commands.h>
#include <trochoid/cli/deliver.h>
#include <trochoid/cli/memory.h>
#include <trochoid/inputs/case.h>
#include <trochoid/inputs/findings.h>
#include <trochoid/numerics/thread_count.h>
#include <trochoid/results/provenance.h>

#include <CLI/CLI.hpp>

#include <fmt/core.h>
#include <fmt/ranges.h>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

using trochoid::base::Command;
using trochoid::cli::Options;

/// What one fit frees the next one needs: the system is not to have it back in between,
/// for giving it out again page by page takes as long as the fit.
void keep_freed_memory() {
#if defined(__GLIBC__)
  constexpr int kept = 32 << 20;  // bytes; glibc takes no more for the first
  mallopt(M_MMAP_THRESHOLD, kept);
  mallopt(M_TRIM_THRESHOLD, kept);
#endif
}

/// A file that may not grow is an error to be told, not a signal to die of.
void report_full_disks() {
#if defined(SIGXFSZ)
  std::signal(SIGXFSZ, SIG_IGN);
#endif
}

int answer(Command command, const Options& options) {
  using namespace trochoid::cli;
  switch (command) {
    case Command::simulate:
      return simulate(options);
    case Command::identify:
      return identify(options);
    case Command::surface:
      return surface(options);
    case Command::calibrate:
      return calibrate(options);
    case Command::stability:
      return stability(options);
    case Command::modes:
      return modes(options);
    case Command::actuator:
      return actuator(options);
    case Command::dynamics:
      return dynamics(options);
    case Command::correct:
      return correct(options);
    case Command::plan:
      return plan(options);
  }
  return our_bug;
}

std::vector<Command> all_commands() {
  std::vector<Command> all;
  all.reserve(trochoid::base::names<Command>.size());
  for (const std::string_view name : trochoid::base::names<Command>) {
    all.push_back(*trochoid::base::named<Command>(name));
  }
  return all;
}

void add_common(CLI::App& app, Options& options) {
  app.add_option("CASE.toml", options.file,
                 "The case file (docs/formats/case.md; `trochoid new` writes one)")
      ->required();
  app.add_flag("-q,--quiet", options.quiet, "Print nothing but errors");
}

void add_output(CLI::App& app, Options& options) {
  app.add_option("-o,--output", options.folder,
                 "Folder for the results (default: CASE.COMMAND beside the case)");
  app.add_flag("--json", options.json, "Print summary.json instead of the table");
  app.add_flag("--no-report", options.no_report, "Do not write report.html");
  app.add_option("--time-limit", options.time_limit,
                 "End after so many seconds of work, with what was found till then")
      ->check(CLI::Range(0.001, 1e9));
}

/// What is told to all that take one case.
void add_case(CLI::App& app, Options& options) {
  add_common(app, options);
  add_output(app, options);
  app.add_flag("--anyway", options.anyway,
               "Compute even what will take more than 1e9 evaluations or 1 GB");
}

/// What a bare data file does not say by itself.
void add_data_options(CLI::App& app, Command command, Options& options) {
  if (command == Command::modes) {
    app.get_option("CASE.toml")
        ->description(
            "The measured frequency response function (UFF58, or a "
            "table), or a case with [frf]");
    app.add_option("--kind", options.kind,
                   "What was measured, if the file does not say it by its unit")
        ->check(CLI::IsMember({"receptance", "mobility", "accelerance"}));
    app.add_option("--modes", options.modes,
                   "How many modes to fit (default: their number is chosen)")
        ->check(CLI::Range(1, 20));
    app.add_option("--band", options.band, "Lowest and highest frequency used, in Hz")
        ->expected(2);
    app.add_option("--dataset", options.dataset,
                   "Which frequency response function of a universal file, from 1")
        ->check(CLI::Range(1, 100000));
  }
  if (command == Command::identify) {
    app.add_flag(
        "--curves", options.curves,
        "Write every sample of long records to fitted.csv and residual.csv, not "
        "the mean turn");
  }
  if (command == Command::correct) {
    app.add_flag("--simulate-controller", options.simulate_controller,
                 "Run the real-time controller in the loop ([controller])");
  }
  if (command == Command::actuator) {
    app.get_option("CASE.toml")
        ->description("The record of the step (CSV), or a case with [step]");
    app.add_option("--step-um", options.step_um,
                   "Height of the commanded step (default: from its column)");
    app.add_option("--start-s", options.start_s,
                   "When the step was commanded (default: fitted)");
  }
}

CLI::App* add_sweep(CLI::App& app, Options& options) {
  CLI::App* sweep = app.add_subcommand(
      "sweep",
      "One case over many values of its keys ([sweep]): a table, a row a case; goes on "
      "where it was stopped");
  add_common(*sweep, options);
  add_output(*sweep, options);
  sweep->add_option("--command", options.command,
                    "What answers each row (default: `command` of [sweep])");
  sweep->add_option("--take", options.take,
                    "What is taken from each answer, such as result.peak_xy_N; several "
                    "times (default: `take` of [sweep])");
  return sweep;
}

/// `new COMMAND [FILE]`, and the schema that editors know a case file by.
CLI::App* add_new(CLI::App& app, std::string& wanted, Options& options) {
  const std::vector<std::string> names(trochoid::base::names<Command>.begin(),
                                       trochoid::base::names<Command>.end());
  CLI::App* fresh =
      app.add_subcommand("new", "Write a commented case file to start from");
  fresh->add_option("COMMAND", wanted, fmt::format("{}", fmt::join(names, ", ")))
      ->required()
      ->check(CLI::IsMember(names));
  fresh->add_option("FILE", options.file, "Where (default: print it)");
  fresh->add_flag_callback(
      "--schema",
      [] {
        fmt::print("{}", trochoid::inputs::case_schema());
        throw CLI::Success();
      },
      "Print the JSON Schema of the case file, for editors");
  return fresh;
}

/// Named with the nearest one there is, before anything else is looked at.
void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "-";
  if (first.starts_with('-')) {
    return;
  }
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands({})) {
    names.push_back(sub->get_name());
  }
  if (std::find(names.begin(), names.end(), first) == names.end()) {
    throw trochoid::base::InputError(
        {fmt::format("trochoid {}: there is no such command{}", first,
                     trochoid::inputs::suggestion(first, names))});
  }
}

int run(int argc, char** argv) {
  CLI::App app{"What a milling cutter with runout really does.", "trochoid"};
  app.footer(
      "Start with\n"
      "  trochoid new identify mycase.toml\n"
      "  trochoid identify mycase.toml\n"
      "Exit codes: 0 answered, 1 no good answer exists (the reason "
      "is said), 2 the input is wrong, 3 a bug of ours.");
  app.set_version_flag("--version", std::string(trochoid::results::version()));
  app.require_subcommand(1);
  Options options;
  std::function<int()> chosen;
  for (const Command command : all_commands()) {
    CLI::App* sub = app.add_subcommand(std::string(name_of(command)),
                                       std::string(purpose_of(command)));
    add_case(*sub, options);
    add_data_options(*sub, command, options);
    sub->callback(
        [&, command] { chosen = [&, command] { return answer(command, options); }; });
  }
  CLI::App* sweep = add_sweep(app, options);
  sweep->callback([&] { chosen = [&] { return trochoid::cli::sweep(options); }; });
  CLI::App* check = app.add_subcommand(
      "check",
      "Read a case file and its measurements and name every mistake in them; "
      "nothing is written");
  add_case(*check, options);
  check->callback([&] { chosen = [&] { return trochoid::cli::check(options); }; });
  std::string wanted;
  CLI::App* fresh = add_new(app, wanted, options);
  fresh->callback([&] {
    chosen = [&] {
      return trochoid::cli::new_case(*trochoid::base::named<Command>(wanted),
                                     options.file);
    };
  });
  CLI::App* report = app.add_subcommand(
      "report", "Make report.html of a result folder again from its files");
  report->add_option("FOLDER", options.file, "The result folder")->required();
  report->add_flag("-q,--quiet", options.quiet, "Print nothing but errors");
  report->callback([&] { chosen = [&] { return trochoid::cli::report(options); }; });
  refuse_unknown_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? trochoid::cli::answered : trochoid::cli::wrong_input;
  }
  const auto limit = trochoid::numerics::thread_limit_of_environment();
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    keep_freed_memory();
    report_full_disks();
    trochoid::cli::say_no_memory_at_the_end_of(argc > 1 ? argv[1] : "");
    const int code = run(argc, argv);
    if (std::fflush(stdout) != 0) {
      throw std::runtime_error("what is printed cannot be written");
    }
    return code;
  } catch (const trochoid::base::InputError& error) {
    trochoid::cli::complain(error.what());
    return trochoid::cli::wrong_input;
  } catch (const std::bad_alloc&) {
    trochoid::cli::say_no_memory(argc > 1 ? argv[1] : "");
    return trochoid::cli::our_bug;
  } catch (const std::exception& error) {
    trochoid::cli::complain(fmt::format("trochoid: {}\n", error.what()));
    const bool full = std::ferror(stdout) != 0;  // the place is wrong, not the program
    return full ? trochoid::cli::wrong_input : trochoid::cli::our_bug;
  }
}
