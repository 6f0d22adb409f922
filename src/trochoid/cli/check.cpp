#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/base/printable.h>
#include <trochoid/cases/case_source.h>
#include <trochoid/cli/given_case.h>
#include <trochoid/run/commands.h>
#include <trochoid/run/records.h>

#include <fmt/core.h>

namespace trochoid::cli {

namespace {

/// The frequency response and the step that a case names.
void check_machine_files(const cases::Case& given, std::vector<std::string>& problems) {
  const auto look = [&](const auto& read) {
    try {
      read();
    } catch (const base::InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  };
  if (given.machine.frf) {
    look([&] { given.machine.frf->response.get(); });
  }
  if (given.machine.step) {
    look([&] { given.machine.step->step.get(); });
  }
  if (given.nc.program) {
    look([&] { given.nc.program->text.get(); });
  }
}

}  // namespace

int check(const Options& options) {
  const cases::Node root = document_of(options);
  const cases::Case given = cases::read_case(
      {root, options.file, {}}, base::named<base::Command>(options.command));
  std::vector<std::string> problems;
  std::string found;
  for (const base::Warning& note : given.notes) {
    found += fmt::format("warning [{}]: {}\n", note.code, note.message);
  }
  for (const cases::Measurement& measurement : given.measurements) {
    if (!measurement.mean.empty()) {
      found += fmt::format("means of {} channel{}\n", measurement.mean.size(),
                           measurement.mean.size() == 1 ? "" : "s");
      continue;
    }
    try {
      const signal::Record& record = measurement.record.get();
      found += run::describe_record(record, measurement);
      if (const auto why = run::missing_channel(record, given);
          !given.identify.by_channels && !why.empty()) {
        problems.push_back(why);
      }
      for (const base::Warning& note : record.notes) {
        found +=
            fmt::format("warning [{}]: {}: {}\n", note.code, record.file, note.message);
      }
    } catch (const base::InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  const auto& surfaces = given.machine.surface_measurements;
  for (const cases::SurfaceMeasurement& measurement : surfaces) {
    try {
      const files::SurfaceFile& surface = measurement.surface.get();
      for (const base::Warning& note : surface.notes) {
        found += fmt::format("warning [{}]: {}: {}\n", note.code,
                             measurement.source.file.path, note.message);
      }
    } catch (const base::InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  check_machine_files(given, problems);
  if (!problems.empty()) {
    throw base::InputError(std::move(problems));
  }
  if (!options.quiet) {
    fmt::print("{}: no mistakes found\n{}", options.file.string(),
               base::printable(found));
  }
  return answered;
}

}  // namespace trochoid::cli
