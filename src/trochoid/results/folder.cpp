#include <trochoid/results/folder.h>

#include <fmt/core.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include "disk.h"
#include "file_names.h"
#include "staged_folder.h"

namespace trochoid::results {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
  cannot_write(path, error.message());
}

/// @param shown  where the file is going to be, for messages
/// @param put    puts the content into the stream
template <class Put>
void write_with(const fs::path& path, const fs::path& shown, const Put& put) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  put(file);
  file.close();
  if (!file) {
    cannot_write(shown, errno != 0 ? std::generic_category().message(errno)
                                   : "not everything could be written");
  }
  flush_to_disk(path, shown);
}

void write_file(const fs::path& path, const fs::path& shown, const std::string& text) {
  write_with(path, shown, [&](std::ostream& file) {
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
  });
}

void check_names(const Answer& answer) {
  std::vector<std::string> names;
  for (const auto& table : answer.tables) names.push_back(table.file);
  for (const auto& text : answer.texts) {
    if (!text.named_by_user) names.push_back(text.file);
  }
  for (const auto& name : names) {
    if (!is_ours(name)) {
      throw std::invalid_argument(name +
                                  " is not in the list of results/file_names.cpp");
    }
  }
}

using Names = std::vector<std::string>;

/// A report that was never finished, of a program that was killed.
constexpr std::string_view unfinished_report = ".report.html.new-";

void remove_unfinished_reports(const fs::path& folder, const PlaceLock& lock) {
  for (const std::string& name : names_in(folder).value_or(Names{})) {
    if (lock.held() && name.starts_with(unfinished_report)) {
      std::error_code ignored;
      fs::remove(folder / name, ignored);
    }
  }
}

/// Nothing that somebody else put there may disappear with an old answer.
void check_replaceable(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(folder, error);
  if (status.type() == fs::file_type::not_found) return;
  if (error) fail(folder, error);
  if (!fs::is_directory(status)) cannot_write(folder, "it exists and is not a folder");
  const auto names = names_in(folder);
  if (!names) cannot_write(folder, "it cannot be looked into");
  if (names->empty()) return;
  for (const std::string& name : *names) {
    const fs::file_type type = fs::symlink_status(folder / name, error).type();
    if (type != fs::file_type::regular ||
        !(is_ours_in(folder, name) || name.starts_with(unfinished_report))) {
      cannot_write(folder,
                   "it contains '" + name +
                       "', which trochoid did not write; move that away, or name "
                       "another folder with -o");
    }
  }
  if (!holds_our_summary(folder)) {
    cannot_write(
        folder,
        "it exists, but has no summary.json of trochoid; name another folder with -o");
  }
}

/// @param place  where the folder is going to be, for messages
void write_files(const fs::path& folder, const fs::path& place, const Answer& answer,
                 const std::string& report_html) {
  const auto put = [&](const std::string& name, const std::string& text) {
    write_file(folder / name, place / name, text);
  };
  put("case.toml", answer.heading.case_toml);
  for (const auto& table : answer.tables) {
    write_with(folder / table.file, place / table.file,
               [&](std::ostream& file) { write_csv(file, table); });
  }
  for (const auto& text : answer.texts) put(text.file, text.text);
  if (!report_html.empty()) put("report.html", report_html);
  put("summary.json", summary_json(answer));
}

/// Absolute, without a slash at the end.
fs::path place_of(const fs::path& folder) {
  std::error_code error;
  fs::path place = fs::weakly_canonical(fs::absolute(folder), error);
  if (error) fail(folder, error);
  return place.has_filename() ? place : place.parent_path();
}

/// The highest folder that is still to be made for a place, which may be itself.
fs::path first_missing(const fs::path& place) {
  std::error_code error;
  fs::path missing = place;
  while (missing.parent_path().has_relative_path() &&
         fs::status(missing.parent_path(), error).type() == fs::file_type::not_found) {
    missing = missing.parent_path();
  }
  return missing;
}

}  // namespace

void check_place(const fs::path& folder) {
  const fs::path place = place_of(folder);
  check_replaceable(place);
  const fs::path missing = first_missing(place);
  std::error_code error;
  if (!fs::is_directory(missing.parent_path(), error)) {
    cannot_write(place, "'" + missing.parent_path().string() + "' is not a folder");
  }
  if (missing == place) {
    const StagedFolder tried(place);
  } else if (fs::create_directory(missing, error)) {
    fs::remove(missing, error);
  } else if (error) {
    fail(place, error);
  }
}

void write_folder(const fs::path& folder, const Answer& answer,
                  const std::string& report_html) {
  check_names(answer);
  const fs::path place = place_of(folder);
  check_replaceable(place);
  std::error_code error;
  fs::create_directories(place.parent_path(), error);
  if (error) fail(place.parent_path(), error);
  StagedFolder fresh(place);
  write_files(fresh.path(), place, answer, report_html);
  const PlaceLock lock(place);
  check_replaceable(place);  // it may have changed meanwhile
  fresh.put_in_place(lock);
}

void mend_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) {
    const fs::path place = place_of(folder);
    mend(place, PlaceLock(place));
  }
}

void write_report(const fs::path& folder, const std::string& report_html) {
  static_cast<void>(read_summary(folder));
  const PlaceLock lock(place_of(folder));
  remove_unfinished_reports(folder, lock);
  write_page(folder / "report.html", report_html);
}

void write_page(const fs::path& file, const std::string& html) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const fs::path fresh =
      folder / fmt::format(".{}.new-{}", file.filename().string(), process_number());
  std::error_code error;
  try {
    write_file(fresh, file, html);
    fs::rename(fresh, file, error);
    if (error) fail(file, error);
  } catch (...) {
    fs::remove(fresh, error);
    throw;
  }
  flush_to_disk(folder, file);
}

}  // namespace trochoid::results
