#include <trochoid/base/error.h>
#include <trochoid/cli/commands.h>
#include <trochoid/inputs/case.h>
#include <trochoid/inputs/record_file.h>

#include <fmt/core.h>

namespace trochoid::cli {

int check(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::check);
  std::vector<std::string> problems;
  for (const inputs::Measurement& measurement : given.measurements) {
    try {
      inputs::read_record(measurement);
    } catch (const base::InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) {
    throw base::InputError(std::move(problems));
  }
  if (!options.quiet) {
    fmt::print("{}: no mistakes found\n", options.file.string());
  }
  return answered;
}

}  // namespace trochoid::cli
