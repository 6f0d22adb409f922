#include <trochoid/base/error.h>
#include <trochoid/cli/deliver.h>
#include <trochoid/report/report.h>
#include <trochoid/results/compared.h>
#include <trochoid/results/folder.h>

#include <fmt/core.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace trochoid::cli {

namespace {

namespace fs = std::filesystem;

/// Whether a file is one of our pages: nothing else is overwritten.
bool is_page(const fs::path& file) {
  std::string head(64'000, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find("\xC2\xB7 Trochoid</title>") != head.npos;
}

/// A folder without what stands before its name and means itself.
fs::path plain(const fs::path& folder) {
  const fs::path whole = folder.lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

/// Names of two folders: their paths from where they part.
std::pair<std::string, std::string> names_of(const fs::path& a, const fs::path& b) {
  auto first = a.begin();
  auto second = b.begin();
  while (std::next(first) != a.end() && std::next(second) != b.end() &&
         *first == *second) {
    ++first;
    ++second;
  }
  const auto rest = [](fs::path::iterator from, const fs::path& whole) {
    fs::path path;
    for (; from != whole.end(); ++from) path /= *from;
    return path.generic_string();
  };
  return {rest(first, a), rest(second, b)};
}

int compare(const Options& options) {
  const fs::path file = options.folder.empty() ? "compare.html" : options.folder;
  const auto [a, b] = names_of(plain(options.file), plain(options.other));
  const results::Answer both =
      results::compared({a, results::read_folder(options.file)},
                        {b, results::read_folder(options.other)});
  if (fs::exists(fs::symlink_status(file)) && !is_page(file)) {
    throw base::InputError({file.string() + ": it exists already and is no page of "
                                            "trochoid; name another file (-o)"});
  }
  const std::string page = report::html(both, results::summary_json(both));
  try {
    results::write_page(file, page);
  } catch (const std::runtime_error& error) {  // the place is wrong, not the program
    throw base::InputError({error.what()});
  }
  if (!options.quiet) {
    fmt::print("{}\nreport: {}\n", both.heading.message, file.string());
  }
  return answered;
}

}  // namespace

int report(const Options& options) {
  if (!options.other.empty()) return compare(options);
  if (!options.folder.empty()) {
    throw base::InputError({"-o: goes with two folders that are compared"});
  }
  const fs::path& folder = options.file;
  const results::Answer answer = results::read_folder(folder);
  // As it stands: the numbers keep the version that made them.
  const std::string summary = results::read_summary(folder);
  try {
    results::write_report(folder, report::html(answer, summary));
  } catch (const std::runtime_error& error) {  // the place is wrong, not the program
    throw base::InputError({error.what()});
  }
  if (!options.quiet) {
    fmt::print("report: {}\n", (folder / "report.html").string());
  }
  return answer.heading.ok ? answered : no_answer;
}

}  // namespace trochoid::cli
