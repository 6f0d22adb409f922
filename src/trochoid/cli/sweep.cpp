#include <trochoid/sweep/sweep.h>

#include <trochoid/base/error.h>
#include <trochoid/cli/deliver.h>
#include <trochoid/cli/given_case.h>
#include <trochoid/cli/progress_line.h>
#include <trochoid/cli/time_limit.h>
#include <trochoid/results/folder.h>

#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <system_error>

namespace trochoid::cli {

namespace {

void check_place(const std::filesystem::path& folder) {
  try {
    results::check_place(folder);
  } catch (const std::runtime_error& error) {
    throw base::InputError({error.what()});
  }
}

/// A part that takes too long is given up; those before it are kept.
[[noreturn]] void give_up() noexcept {
  complain(
      "trochoid sweep: the time limit has passed; rows that are done are kept, and "
      "the same command goes on there\n");
  std::fflush(stdout);
  std::_Exit(no_answer);
}

}  // namespace

int sweep(const Options& options) {
  const std::filesystem::path folder = result_folder(options, "sweep");
  check_place(folder);
  const std::filesystem::path part = sweep::part_file_of(folder);
  const auto result = [&] {
    ProgressLine progress(talk_of(options));
    const TimeLimit limit(options.time_limit, true, give_up);
    const cases::Node root = document_of(options);
    return sweep::sweep({root, options.file, {}},
                        {.command = options.command,
                         .take = options.take,
                         .part_file = part,
                         .folder = folder},
                        std::ref(progress), limit.stop());
  }();
  const int code = deliver(results::answer_of(result), options);
  if (result.complete) {
    std::error_code gone;
    std::filesystem::remove(part, gone);
  }
  return code;
}

}  // namespace trochoid::cli
