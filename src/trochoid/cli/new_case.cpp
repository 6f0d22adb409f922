#include <trochoid/base/error.h>
#include <trochoid/cases/case.h>
#include <trochoid/cli/commands.h>

#include <fmt/core.h>

#include <fstream>
#include <optional>
#include <system_error>

namespace trochoid::cli {

int new_case(base::Command command, const Options& options) {
  const std::filesystem::path& file = options.file;
  cases::NewCaseOptions given{.material = options.material,
                              .folder = file.parent_path()};
  if (!options.tool.empty()) {
    given.tool = {options.tool, options.tool_number, options.tool_inches};
  }
  const std::string text = cases::new_case(command, given);
  if (file.empty()) {
    fmt::print("{}", text);
    return answered;
  }
  std::error_code error;
  const auto status = std::filesystem::symlink_status(file, error);
  if (std::filesystem::exists(status)) {  // a link that leads nowhere counts
    throw base::InputError({file.string() + ": it exists already and is not "
                                            "overwritten; name another file"});
  }
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) {
    throw base::InputError({file.string() + ": it cannot be written"});
  }
  fmt::print("{0}: edit it, then run\n  trochoid {1} {0}\n", file.string(),
             name_of(command));
  return answered;
}

}  // namespace trochoid::cli
