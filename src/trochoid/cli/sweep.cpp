#include <trochoid/sweep/sweep.h>

#include <trochoid/cli/deliver.h>
#include <trochoid/cli/progress_line.h>

#include <fmt/core.h>

#include <functional>
#include <system_error>

namespace trochoid::cli {

int sweep(const Options& options) {
  const std::filesystem::path folder = result_folder(options, "sweep");
  std::filesystem::path part = std::filesystem::absolute(folder).lexically_normal();
  if (part.filename().empty()) {
    part = part.parent_path();
  }
  part.replace_filename(fmt::format(".{}.part", part.filename().string()));
  const auto answer = [&] {
    ProgressLine progress(options.quiet);
    return results::answer_of(sweep::sweep({.file = options.file,
                                            .command = options.command,
                                            .take = options.take,
                                            .part_file = part,
                                            .folder = folder},
                                           std::ref(progress)));
  };
  const int code = deliver(answer(), options);
  std::error_code gone;
  std::filesystem::remove(part, gone);
  return code;
}

}  // namespace trochoid::cli
