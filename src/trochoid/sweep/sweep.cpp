#include <trochoid/sweep/sweep.h>

#include <trochoid/sweep/work.h>

#include <fmt/core.h>

namespace trochoid::sweep {

namespace {

/// A part takes about as long: short for whoever stops it, long beside its writing.
constexpr std::chrono::duration<double> part_time{1.0};

}  // namespace

std::filesystem::path part_file_of(const std::filesystem::path& folder) {
  std::filesystem::path part = std::filesystem::absolute(folder).lexically_normal();
  if (part.filename().empty()) {
    part = part.parent_path();
  }
  return part.replace_filename(fmt::format(".{}.part", part.filename().string()));
}

results::SweepResult sweep(const inputs::CaseSource& source, const Request& request,
                           const run::Progress& progress, base::Stop stop) {
  Work work(source, request, progress);
  work.go_on(progress, stop, part_time);
  return work.take_result();
}

}  // namespace trochoid::sweep
