#include <trochoid/cli/deliver.h>

#include <trochoid/base/error.h>
#include <trochoid/cli/progress_line.h>
#include <trochoid/report/report.h>
#include <trochoid/results/folder.h>

#include <fmt/core.h>

#include <cstdio>
#include <stdexcept>

namespace trochoid::cli {

std::filesystem::path result_folder(const Options& options,
                                    const std::string& command) {
  if (!options.folder.empty()) {
    return options.folder;
  }
  std::filesystem::path folder = options.file;
  folder.replace_extension();
  folder += "." + command;
  return folder;
}

int deliver(const results::Answer& answer, const Options& options) {
  const std::filesystem::path folder = result_folder(options, answer.command);
  const std::string summary = results::summary_json(answer);
  try {
    ProgressLine progress(options.quiet);
    progress("Writing the results");
    results::write_folder(folder, answer,
                          options.no_report ? "" : report::html(answer, summary));
  } catch (const std::runtime_error& error) {  // the place is wrong, not the program
    throw base::InputError({error.what()});
  }
  if (options.json) {
    fmt::print("{}\n", summary);
  } else if (!options.quiet) {
    if (!answer.heading.title.empty()) {
      fmt::print("{}\n\n", answer.heading.title);
    }
    fmt::print("{}", answer.short_table);
    for (const base::Warning& warning : answer.heading.warnings) {
      fmt::print("warning [{}]: {}\n", warning.code, warning.message);
    }
    fmt::print("\nresults: {}\n", folder.string());
    if (!options.no_report) {
      fmt::print("report:  {}\n", (folder / "report.html").string());
    }
  }
  if (!answer.heading.ok) {
    fmt::print(stderr, "trochoid {}: {}\n", answer.command, answer.heading.message);
  }
  return answer.heading.ok ? answered : no_answer;
}

}  // namespace trochoid::cli
