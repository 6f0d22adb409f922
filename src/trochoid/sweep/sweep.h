#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/cases/case_source.h>
#include <trochoid/results/sweep.h>
#include <trochoid/run/progress.h>

#include <filesystem>
#include <string>
#include <vector>

namespace trochoid::sweep {

/// What is asked of a sweep beside the case.
struct Request {
  std::string command;                ///< empty: that of [sweep]
  std::vector<std::string> take;      ///< empty: those of [sweep]
  std::filesystem::path part_file;    ///< keeps rows that are done; empty: nothing does
  std::filesystem::path folder = {};  ///< where the result will be, for file names
};

/// @brief Where rows that are done are kept until the folder is written: beside it,
/// hidden.
std::filesystem::path part_file_of(const std::filesystem::path& folder);

/// @brief One case over many values of its keys: [sweep].
///
/// The caller removes `part_file` once the result is written.
/// @throws base::InputError where the case, a swept key or what is to be taken is wrong
/// @param stop  from when on no part is begun but the first: no answer, but rows that
///              are kept
results::SweepResult sweep(const cases::CaseSource& source, const Request& request,
                           const run::Progress& progress, base::Stop stop = {});

}  // namespace trochoid::sweep
