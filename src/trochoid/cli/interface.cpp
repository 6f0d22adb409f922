#include <trochoid/cli/interface.h>

#include <trochoid/base/command.h>
#include <trochoid/base/names.h>
#include <trochoid/cases/case.h>
#include <trochoid/numerics/thread_count.h>
#include <trochoid/results/provenance.h>

#include <CLI/CLI.hpp>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::cli {

namespace {

using base::Command;

std::vector<Command> all_commands() {
  std::vector<Command> all;
  all.reserve(base::names<Command>.size());
  for (const std::string_view name : base::names<Command>) {
    all.push_back(*base::named<Command>(name));
  }
  return all;
}

/// What stands on the command line without a name: the case, or a bare data file.
constexpr const char* file_of(Command command) {
  switch (command) {
    case Command::modes:
      return "FRF";
    case Command::actuator:
      return "STEP";
    default:
      return "CASE.toml";
  }
}

/// @param file  what help calls it
void add_common(CLI::App& app, Options& options, const char* file = "CASE.toml") {
  app.add_option(
         file, options.file,
         "The case file (docs/formats/case.md; `trochoid new` writes one); -: the "
         "standard input")
      ->required()
      ->type_name(std::string(types::file));
  app.add_option("--set", options.set,
                 "In place of what the case says, such as cut.spindle_rpm=900; "
                 "several times")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  app.add_flag("-q,--quiet", options.quiet, "Print nothing but errors");
  app.add_flag("--verbose", options.verbose, "Tell of every step how long it took");
  app.add_option("--threads", options.threads,
                 "Work on at most so many threads (default: all there are, or what "
                 "TROCHOID_THREADS says)")
      ->check(CLI::Range(1, numerics::most_threads));
}

void add_output(CLI::App& app, Options& options) {
  app.add_option("-o,--output", options.folder,
                 "Folder for the results (default: CASE.COMMAND beside the case)")
      ->type_name(std::string(types::folder));
  app.add_flag("--json", options.json, "Print summary.json instead of the table");
  app.add_flag("--no-report", options.no_report, "Do not write report.html");
  app.add_option("--time-limit", options.time_limit,
                 "End after so many seconds of work, with what was found till then")
      ->check(CLI::Range(0.001, 1e9));
}

/// What is told to all that take one case.
void add_case(CLI::App& app, Options& options, const char* file = "CASE.toml") {
  add_common(app, options, file);
  add_output(app, options);
  app.add_flag("--anyway", options.anyway,
               "Compute even what will take more than 1e9 evaluations or 1 GB");
}

/// What a bare data file does not say by itself.
void add_data_options(CLI::App& app, Command command, Options& options) {
  if (command == Command::modes) {
    app.get_option(file_of(command))
        ->description(
            "The measured frequency response function (UFF58, or a "
            "table), or a case with [frf]")
        ->type_name(std::string(types::data));
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
  if (command == Command::program) {
    app.add_flag("--moves", options.moves,
                 "Write moves.csv even where there are more than a million");
  }
  if (command == Command::correct) {
    app.add_flag("--simulate-controller", options.simulate_controller,
                 "Run the real-time controller in the loop ([controller])");
  }
  if (command == Command::actuator) {
    app.get_option(file_of(command))
        ->description("The record of the step (CSV), or a case with [step]")
        ->type_name(std::string(types::data));
    app.add_option("--step-um", options.step_um,
                   "Height of the commanded step (default: from its column)");
    app.add_option("--start-s", options.start_s,
                   "When the step was commanded (default: fitted)");
  }
}

CLI::App* add_sweep(CLI::App& app, Options& options) {
  CLI::App* sweep = app.add_subcommand(
      "sweep",
      "Parameter sweep ([sweep]): one row per case in one table; resumes where it was "
      "stopped");
  add_common(*sweep, options);
  add_output(*sweep, options);
  sweep
      ->add_option("--command", options.command,
                   "What answers each row (default: `command` of [sweep])")
      ->type_name(std::string(types::command));
  sweep->add_option("--take", options.take,
                    "What is taken from each answer, such as result.peak_xy_N; several "
                    "times (default: `take` of [sweep])");
  return sweep;
}

/// `new COMMAND [FILE]`, and the schema that editors know a case file by.
CLI::App* add_new(CLI::App& app, std::string& wanted, Options& options) {
  const std::vector<std::string> names(base::names<Command>.begin(),
                                       base::names<Command>.end());
  CLI::App* fresh =
      app.add_subcommand("new", "Write a commented case file to start from");
  fresh->add_option("COMMAND", wanted, fmt::format("{}", fmt::join(names, ", ")))
      ->required()
      ->check(CLI::IsMember(names));
  fresh->add_option("FILE", options.file, "Where (default: print it)")
      ->type_name(std::string(types::file));
  CLI::Option* tool =
      fresh
          ->add_option(
              "--tool", options.tool,
              "A FreeCAD tool bit (.fctb) or a LinuxCNC tool table: its tool in "
              "place of the example's. Or a kind: face_mill, high_feed, round_insert, "
              "shoulder_mill, serrated, variable_helix")
          ->type_name(std::string(types::file));
  fresh
      ->add_option("--tool-number", options.tool_number,
                   "Which of a table of several tools (its T)")
      ->needs(tool);
  fresh
      ->add_flag("--tool-inches", options.tool_inches,
                 "The table of tools is in inches")
      ->needs(tool);
  fresh
      ->add_option(
          "--material", options.material,
          "A file with a [force], of examples/materials or written by identify: "
          "it is included")
      ->type_name(std::string(types::file));
  fresh->add_flag_callback(
      "--schema",
      [] {
        fmt::print("{}", cases::case_schema());
        throw CLI::Success();
      },
      "Print the JSON Schema of the case file, for editors");
  return fresh;
}

/// The standard input is a case in the working folder.
void take_input(Options& options) {
  if (options.file == "-") {
    options.from_input = true;
    options.file = "stdin.toml";
  }
}

/// What to type first, and what the program then ends with.
template <class Steps>
std::string footer(const Steps& steps) {
  std::vector<std::string> codes;
  for (const auto& [code, meaning] : exit_codes) {
    codes.push_back(fmt::format("{} {}", code, meaning));
  }
  return fmt::format("Start with\n  {}\nExit codes: {}.", fmt::join(steps, "\n  "),
                     fmt::join(codes, ", "));
}

std::vector<std::string> first_steps_of(Command command) {
  const std::string_view name = name_of(command);
  std::vector<std::string> steps{fmt::format("trochoid new {} mycase.toml", name),
                                 fmt::format("trochoid {} mycase.toml", name)};
  if (command == Command::modes) steps.emplace_back("trochoid modes tap_test.uff");
  if (command == Command::actuator) {
    steps.emplace_back("trochoid actuator step.csv --step-um 6");
  }
  return steps;
}

void add_sweep_command(CLI::App& app, Chosen& chosen) {
  Options& options = chosen.options;
  CLI::App* sweep = add_sweep(app, options);
  sweep->footer(
      footer(std::array{"trochoid sweep mycase.toml --command simulate",
                        "trochoid sweep mycase.toml   # goes on after a stop"}));
  sweep->callback([&chosen] {
    take_input(chosen.options);
    chosen.command = [&chosen] { return cli::sweep(chosen.options); };
  });
}

void add_check_command(CLI::App& app, Chosen& chosen) {
  Options& options = chosen.options;
  CLI::App* check = app.add_subcommand(
      "check",
      "Read a case file and its measurements and name every mistake in them; "
      "nothing is written");
  add_case(*check, options);
  check->footer(footer(std::array{"trochoid check mycase.toml"}));
  check->add_option("--for", options.command, "The command that the case is meant for")
      ->check(CLI::IsMember(std::vector<std::string>(base::names<Command>.begin(),
                                                     base::names<Command>.end())));
  check->callback([&chosen] {
    take_input(chosen.options);
    chosen.command = [&chosen] { return cli::check(chosen.options); };
  });
}

void add_report_command(CLI::App& app, Chosen& chosen) {
  Options& options = chosen.options;
  CLI::App* report = app.add_subcommand(
      "report",
      "Make report.html of a result folder again from its files, or a page that compares "
      "two of them");
  report->footer(footer(std::array{"trochoid report mycase.identify",
                                   "trochoid report first.identify second.identify"}));
  report->add_option("FOLDER", options.file, "The result folder")
      ->required()
      ->type_name(std::string(types::folder));
  report->add_option("OTHER", options.other, "Another folder, to be compared with it")
      ->type_name(std::string(types::folder));
  report
      ->add_option("-o,--output", options.folder,
                   "File for the comparison (default: compare.html)")
      ->type_name(std::string(types::file));
  report->add_flag("-q,--quiet", options.quiet, "Print nothing but errors");
  report->callback([&chosen] {
    chosen.command = [&chosen] { return cli::report(chosen.options); };
  });
}

}  // namespace

void add_interface(CLI::App& app, Chosen& chosen) {
  app.name("trochoid");
  app.description("What a milling cutter with runout really does.");
  app.footer(footer(first_steps));
  app.set_version_flag("--version", std::string(results::version()));
  app.require_subcommand(1);
  Options& options = chosen.options;
  for (const Command command : all_commands()) {
    CLI::App* sub = app.add_subcommand(std::string(name_of(command)),
                                       std::string(purpose_of(command)));
    add_case(*sub, options, file_of(command));
    add_data_options(*sub, command, options);
    sub->footer(footer(first_steps_of(command)));
    sub->callback([&chosen, command] {
      take_input(chosen.options);
      chosen.command = [&chosen, command] {
        return cli::answer(command, chosen.options);
      };
    });
  }
  add_sweep_command(app, chosen);
  add_check_command(app, chosen);
  CLI::App* fresh = add_new(app, chosen.wanted, options);
  fresh->footer(footer(first_steps));
  fresh->callback([&chosen] {
    chosen.command = [&chosen] {
      return new_case(*base::named<Command>(chosen.wanted), chosen.options);
    };
  });
  add_report_command(app, chosen);
}

}  // namespace trochoid::cli
