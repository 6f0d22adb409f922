#include <trochoid/base/error.h>
#include <trochoid/report/report.h>
#include <trochoid/results/folder.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "bytes.h"
#include "folder.h"

namespace {

using trochoid::fuzz::demand;
using trochoid::fuzz::Folder;
using trochoid::fuzz::write;
namespace results = trochoid::results;

auto angle_brackets(const std::string& page) {
  return std::count(page.begin(), page.end(), '<');
}

/// The page of an answer that says nothing.
std::ptrdiff_t brackets_of_an_empty_page() {
  return angle_brackets(trochoid::report::html({}, "{}"));
}

/// No text of a folder becomes a tag of the page: it has its own, and those of warnings.
void check_page(const results::Answer& answer, const std::string& summary) {
  static const auto empty = brackets_of_an_empty_page();
  const std::string page = trochoid::report::html(answer, summary);
  const auto warnings = std::ssize(answer.heading.warnings);
  demand(angle_brackets(page) == empty + (warnings > 0 ? 6 + 2 * warnings : 0));
}

/// Up to a byte 0, and it as well.
std::string_view cut_off(std::string_view& left) {
  const auto end = left.find('\0');
  const auto part = left.substr(0, end);
  left = end == std::string_view::npos ? std::string_view{} : left.substr(end + 1);
  return part;
}

}  // namespace

/// summary.json, case.toml and forces.csv, with a byte 0 between them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder("trochoid_result");
  std::string_view left(reinterpret_cast<const char*>(data), size);
  for (const char* const name : {"summary.json", "case.toml", "forces.csv"}) {
    write(folder.path / name, cut_off(left));
  }
  try {
    const auto answer = results::read_folder(folder.path);
    const auto summary = results::read_summary(folder.path);
    check_page(answer, summary);
    demand(!results::summary_json(answer).empty());
    for (const auto& table : answer.tables) demand(!results::csv(table).empty());
  } catch (const trochoid::base::InputError& error) {
    demand(!error.problems().empty());
  }
  return 0;
}
