#include <trochoid/base/error.h>
#include <trochoid/cli/deliver.h>
#include <trochoid/cli/given_case.h>
#include <trochoid/results/folder.h>

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace trochoid::cli {

namespace {

using Problems = std::vector<std::string>;

/// Why the results cannot be written there; empty: they can.
Problems problems_of_place(const std::filesystem::path& folder) {
  try {
    results::check_place(folder);
  } catch (const std::runtime_error& error) {
    return {error.what()};
  }
  return {};
}

/// @param read  the case, or InputError
template <class Read>
inputs::Case checked(const std::filesystem::path& folder, const Read& read) {
  std::optional<inputs::Case> given;
  Problems problems;
  try {
    given = read();
  } catch (const base::InputError& error) {
    problems = error.problems();
  }
  for (std::string& problem : problems_of_place(folder)) {
    problems.push_back(std::move(problem));
  }
  if (!problems.empty()) {
    throw base::InputError(std::move(problems));
  }
  return std::move(*given);
}

}  // namespace

inputs::Case given_case(const Options& options, base::Command command) {
  const auto folder = result_folder(options, std::string(name_of(command)));
  return checked(folder,
                 [&] { return inputs::read_case(options.file, command, folder); });
}

inputs::Case bare_case(const Options& options, const inputs::MachineTables& machine,
                       base::Command command) {
  const auto folder = result_folder(options, std::string(name_of(command)));
  return checked(folder, [&] { return inputs::bare_case(machine, command, folder); });
}

}  // namespace trochoid::cli
