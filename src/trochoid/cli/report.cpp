#include <trochoid/cli/deliver.h>
#include <trochoid/results/folder.h>

#include <fmt/core.h>

namespace trochoid::cli {

int report(const Options& options) {
  const base::Answer answer = results::read_folder(options.file);
  Options again = options;
  again.folder = options.file;
  again.quiet = true;
  again.json = false;
  const int code = deliver(answer, again);
  if (!options.quiet) {
    fmt::print("report: {}\n", (options.file / "report.html").string());
  }
  return code;
}

}  // namespace trochoid::cli
