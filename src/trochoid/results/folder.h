#pragma once

#include <trochoid/base/table.h>
#include <trochoid/results/answer.h>

#include <filesystem>
#include <iosfwd>
#include <string>

namespace trochoid::results {

/// Version of summary.json, in it as trochoid.schema. Raised when a key goes, or changes
/// its meaning or unit; further keys do not raise it.
inline constexpr int summary_version = 1;

/// @brief Text of summary.json: provenance, status, warnings, result.
std::string summary_json(const Answer& answer);

/// @brief CSV text of a table; every number is the shortest that reads back the same.
/// @throws std::invalid_argument when the columns are not equally long; nothing is
///         written then
std::string csv(const base::Table& table);
/// @brief The same, handed on piece by piece: the text as a whole is in no memory.
void write_csv(std::ostream& out, const base::Table& table);

/// @brief Write the folder of an answer whole or not at all (a sibling, then a rename).
///
/// Holds case.toml, summary.json, the tables and, if not empty, report.html. An older
/// folder of the same name is replaced only if we wrote it (it holds our summary.json).
/// @throws std::runtime_error when the place cannot be written, or holds foreign files
void write_folder(const std::filesystem::path& folder, const Answer& answer,
                  const std::string& report_html);

/// @brief Can write_folder write there? To be asked before the work.
///
/// By making a folder and removing it again: beside the place, or the first one missing
/// above it. Nothing else is touched but what a killed program left.
/// @throws std::runtime_error as write_folder does
void check_place(const std::filesystem::path& folder);

/// @brief Put back the folder that a killed program had only set aside, if it is missing.
void mend_folder(const std::filesystem::path& folder);

/// @brief Put a new report.html into a folder of ours; everything else stays as it is.
/// @throws base::InputError when it is not a folder of ours
/// @throws std::runtime_error when it cannot be written
void write_report(const std::filesystem::path& folder, const std::string& report_html);

/// @brief Write a page by itself, whole or not at all (a sibling, then a rename).
/// @throws std::runtime_error when it cannot be written
void write_page(const std::filesystem::path& file, const std::string& html);

/// @brief Text of the summary.json of a folder, with the provenance of whoever made it.
/// @throws base::InputError when it is not a folder of ours
std::string read_summary(const std::filesystem::path& folder);

/// @brief Read a folder back, for `report`.
/// @throws base::InputError when it is not a folder of ours
Answer read_folder(const std::filesystem::path& folder);

}  // namespace trochoid::results
