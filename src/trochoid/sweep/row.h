#pragma once

#include <trochoid/base/command.h>
#include <trochoid/cases/case_source.h>
#include <trochoid/cases/sweep.h>
#include <trochoid/results/sweep.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::sweep {

/// What all rows have in common.
struct Study {
  base::Command command = base::Command::simulate;
  cases::Node root;                   ///< the case without its [sweep]
  std::filesystem::path file;         ///< of the case
  std::vector<cases::SweptKey> over;  ///< without their values
  std::vector<std::string> take;
  cases::DataInMemory data = {};
  std::filesystem::path base = {};  ///< as in CaseSource
};

/// The case of one row.
/// @param values  one for each swept key
cases::Node root_of(const Study& study, std::span<const cases::Node> values);

/// A case of the study, where its files are.
cases::CaseSource source_of(const Study& study, const cases::Node& root);

/// @brief The value at a path of an answer: `result.mean_N[1]`, entries from 1.
/// @return none where the answer has no such value
std::optional<results::Cell> taken(const results::Answer& answer,
                                   std::string_view path);

/// @brief The paths of an answer that hold a number or a text.
std::vector<std::string> paths_of(const results::Answer& answer);

/// @brief One row: the case with these values, answered.
///
/// Wrong input and no answer are a status of the row.
/// @param values  one for each swept key
results::SweepRow row_of(const Study& study, std::span<const cases::Node> values);

/// @brief Rows, on all threads; the same bits for every number of them.
/// @param values  of row 0, 1 ... count - 1
std::vector<results::SweepRow> rows(
    const Study& study, std::size_t count,
    const std::function<std::vector<cases::Node>(std::size_t)>& values);

}  // namespace trochoid::sweep
