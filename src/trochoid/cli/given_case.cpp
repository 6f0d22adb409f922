#include <trochoid/base/error.h>
#include <trochoid/cases/case_source.h>
#include <trochoid/cases/settings.h>
#include <trochoid/cli/deliver.h>
#include <trochoid/cli/given_case.h>
#include <trochoid/results/folder.h>
#include <trochoid/run/work.h>

#include <filesystem>
#include <iostream>
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

/// The case is sound: is it too much?
void add_work(const Options& options, base::Command command, const cases::Case& given,
              Problems& problems) {
  const std::string why =
      options.anyway ? "" : run::too_much(run::work_of(command, given));
  if (!why.empty()) {
    problems.push_back(options.file.string() + ": " + why);
  }
}

/// @param read  the case, or InputError
template <class Read>
cases::Case checked(const Options& options, base::Command command, const Read& read) {
  const auto folder = result_folder(options, std::string(name_of(command)));
  std::optional<cases::Case> given;
  Problems problems;
  try {
    given = read(folder);
    add_work(options, command, *given, problems);
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

cases::Node standard_input(const std::filesystem::path& name) {
  constexpr std::size_t most = std::size_t{16} << 20U;  // as of a file
  std::string text;
  std::string part(4096, '\0');
  while (text.size() <= most && std::cin) {
    std::cin.read(part.data(), static_cast<std::streamsize>(part.size()));
    text.append(part, 0, static_cast<std::size_t>(std::cin.gcount()));
  }
  if (text.size() > most) {
    throw base::InputError({name.string() +
                            ":1:1: larger than 16 MiB; this cannot be a "
                            "case file"});
  }
  return cases::with_includes(cases::parse_text(text, name.string()), name);
}

}  // namespace

cases::Node document_of(const Options& options) {
  return cases::with_settings(options.from_input ? standard_input(options.file)
                                                 : cases::load_document(options.file),
                              options.set, options.file);
}

cases::Case given_case(const Options& options, base::Command command) {
  return checked(options, command, [&](const std::filesystem::path& folder) {
    const cases::Node root = document_of(options);
    return cases::read_case({root, options.file, {}}, command, folder);
  });
}

cases::Case bare_case(const Options& options, const cases::MachineTables& machine,
                      base::Command command) {
  return checked(options, command, [&](const std::filesystem::path& folder) {
    return cases::bare_case(machine, command, folder);
  });
}

}  // namespace trochoid::cli
