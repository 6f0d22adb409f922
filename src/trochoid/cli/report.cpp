#include <trochoid/base/error.h>
#include <trochoid/cli/deliver.h>
#include <trochoid/report/report.h>
#include <trochoid/results/folder.h>

#include <fmt/core.h>

#include <stdexcept>

namespace trochoid::cli {

int report(const Options& options) {
  const std::filesystem::path& folder = options.file;
  const results::Answer answer = results::read_folder(folder);
  // As it stands: the numbers keep the version that made them.
  const std::string summary = results::read_summary(folder);
  try {
    results::write_report(folder, report::html(answer, summary));
  } catch (const std::runtime_error& error) {  // the place is wrong, not the program
    throw base::InputError({error.what()});
  }
  if (!options.quiet) {
    fmt::print("report: {}\n", (folder / "report.html").string());
  }
  return answer.heading.ok ? answered : no_answer;
}

}  // namespace trochoid::cli
