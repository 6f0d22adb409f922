#include <trochoid/cli/deliver.h>

#include <trochoid/base/error.h>
#include <trochoid/base/printable.h>
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

void complain(const std::string& text) noexcept {
  try {
    std::fputs(base::printable(text).c_str(), stderr);
  } catch (...) {  // no memory for it: as it stands
    std::fputs(text.c_str(), stderr);
  }
}

int deliver(const results::Answer& answer, const Options& options) {
  const std::filesystem::path folder = result_folder(options, answer.command);
  const std::string summary = results::summary_json(answer);
  try {
    ProgressLine progress(talk_of(options), "Writing the results");
    progress.tell_if_alone();
    results::write_folder(folder, answer,
                          options.no_report ? "" : report::html(answer, summary));
  } catch (const std::runtime_error& error) {  // the place is wrong, not the program
    throw base::InputError({error.what()});
  }
  if (options.json) {
    fmt::print("{}\n", summary);
  } else if (!options.quiet) {
    if (!answer.heading.title.empty()) {
      fmt::print("{}\n\n", base::printable(answer.heading.title));
    }
    fmt::print("{}", base::printable(answer.short_table));
    for (const base::Warning& warning : answer.heading.warnings) {
      fmt::print("warning [{}]: {}\n", warning.code, base::printable(warning.message));
    }
    fmt::print("\nresults: {}\n", folder.string());
    if (!options.no_report) {
      fmt::print("report:  {}\n", (folder / "report.html").string());
    }
  }
  if (!answer.heading.ok) {
    complain(fmt::format("trochoid {}: {}\n", answer.command, answer.heading.message));
  }
  return answer.heading.ok ? answered : no_answer;
}

}  // namespace trochoid::cli
