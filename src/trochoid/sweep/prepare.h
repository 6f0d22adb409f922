#pragma once

#include <trochoid/cases/case_source.h>
#include <trochoid/run/progress.h>
#include <trochoid/sweep/row.h>
#include <trochoid/sweep/rows.h>
#include <trochoid/sweep/sweep.h>

#include <filesystem>
#include <string>

namespace trochoid::sweep {

/// A sweep that was checked: its rows can be answered anywhere and in any order.
struct Prepared {
  Study study;
  Rows rows;
  results::SweepResult result;  ///< without rows; case_toml is that for Request::folder
  cases::Sweep plan;            ///< [sweep] as understood
  std::string meaning;          ///< all that draws depend on beside the seed
  std::string as_understood;    ///< the case of the first row, without [sweep]
};

/// @brief Check a case with [sweep], and lay out its rows.
/// @throws base::InputError where the case, a swept key or what is to be taken is wrong
Prepared prepare(const cases::CaseSource& source, const Request& request,
                 const run::Progress& progress);

/// @brief The case as understood, [sweep] too, with names of files as they count from
/// the folder.
std::string case_toml(const Prepared& prepared, const std::filesystem::path& folder);

/// All that the rows depend on: of another meaning nothing is taken over.
std::string meaning_of(const Prepared& prepared);

}  // namespace trochoid::sweep
