#include <trochoid/results/folder.h>

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "file_names.h"

namespace trochoid::results {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw std::runtime_error("cannot write " + path.string() + ": " + reason);
}

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
  fail(path, error.message());
}

/// @param put  puts the content into the stream
template <class Put>
void write_with(const fs::path& path, const Put& put) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  put(file);
  file.close();
  if (!file) {
    fail(path, errno != 0 ? std::generic_category().message(errno)
                          : "not everything could be written");
  }
}

void write_file(const fs::path& path, const std::string& text) {
  write_with(path, [&](std::ostream& file) {
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
  });
}

void check_names(const Answer& answer) {
  std::vector<std::string> names;
  for (const auto& table : answer.tables) names.push_back(table.file);
  for (const auto& text : answer.texts) names.push_back(text.file);
  for (const auto& name : names) {
    if (!is_ours(name)) {
      throw std::invalid_argument(name +
                                  " is not in the list of results/file_names.cpp");
    }
  }
}

/// Nothing that somebody else put there may disappear with an old answer.
void check_replaceable(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(folder, error);
  if (status.type() == fs::file_type::not_found) return;
  if (error) fail(folder, error);
  if (!fs::is_directory(status)) fail(folder, "it exists and is not a folder");
  if (fs::is_empty(folder, error)) return;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (entry.symlink_status().type() != fs::file_type::regular || !is_ours(name)) {
      fail(folder, "it holds '" + name +
                       "', which trochoid did not write; move that away, or name "
                       "another folder with -o");
    }
  }
  if (error) fail(folder, error);
  if (!holds_our_summary(folder)) {
    fail(folder,
         "it exists, but has no summary.json of trochoid; name another folder with -o");
  }
}

void write_files(const fs::path& folder, const Answer& answer,
                 const std::string& report_html) {
  write_file(folder / "case.toml", answer.heading.case_toml);
  for (const auto& table : answer.tables) {
    write_with(folder / table.file,
               [&](std::ostream& file) { write_csv(file, table); });
  }
  for (const auto& text : answer.texts) write_file(folder / text.file, text.text);
  if (!report_html.empty()) write_file(folder / "report.html", report_html);
  write_file(folder / "summary.json", summary_json(answer));
}

/// Put `fresh` in the place of `folder`, or leave everything as it was.
void put_in_place(const fs::path& fresh, const fs::path& folder, const fs::path& old) {
  std::error_code error;
  fs::rename(folder, old, error);
  const bool replaces = !error;
  if (error && error != std::errc::no_such_file_or_directory) fail(folder, error);
  fs::rename(fresh, folder, error);
  if (error) {
    const std::error_code reason = error;
    if (replaces) fs::rename(old, folder, error);
    fail(folder, reason);
  }
  if (replaces) fs::remove_all(old, error);
}

}  // namespace

void write_folder(const fs::path& folder, const Answer& answer,
                  const std::string& report_html) {
  check_names(answer);
  std::error_code error;
  fs::path place = fs::weakly_canonical(fs::absolute(folder), error);
  if (error) fail(folder, error);
  if (!place.has_filename()) place = place.parent_path();
  check_replaceable(place);

  const fs::path parent = place.parent_path();
  fs::create_directories(parent, error);
  if (error) fail(parent, error);
  const std::string sibling =
      fmt::format(".{}.{}", place.filename().string(), ::getpid());
  const fs::path fresh = parent / (sibling + ".new");
  const fs::path old = parent / (sibling + ".old");
  fs::remove_all(fresh, error);
  if (!fs::create_directory(fresh, error)) fail(fresh, error);
  try {
    write_files(fresh, answer, report_html);
    put_in_place(fresh, place, old);
  } catch (...) {
    fs::remove_all(fresh, error);
    throw;
  }
}

void write_report(const fs::path& folder, const std::string& report_html) {
  static_cast<void>(read_summary(folder));
  const fs::path report = folder / "report.html";
  const fs::path fresh = folder / fmt::format(".report.{}.new", ::getpid());
  std::error_code error;
  try {
    write_file(fresh, report_html);
    fs::rename(fresh, report, error);
    if (error) fail(report, error);
  } catch (...) {
    fs::remove(fresh, error);
    throw;
  }
}

}  // namespace trochoid::results
