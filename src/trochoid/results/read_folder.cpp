#include <trochoid/base/error.h>
#include <trochoid/results/folder.h>

#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "file_names.h"

namespace trochoid::results {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw base::InputError({path.string() + ":1:1: " + reason});
}

std::string read_file(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) refuse(path, "no such file");
  if (!fs::is_regular_file(path, error)) refuse(path, "not a regular file");
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.good() && !file.eof()) refuse(path, "cannot be read");
  return text;
}

std::string_view cut_at(std::string_view& text, char mark) {
  const std::size_t end = text.find(mark);
  const std::string_view head = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  return head;
}

/// An empty cell is a number that does not exist.
double read_number(std::string_view cell, const std::string& place) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0.0;
  const char* end = cell.data() + cell.size();
  const auto read = std::from_chars(cell.data(), end, value);
  if (read.ec != std::errc{} || read.ptr != end) {
    throw base::InputError({place + "'" + std::string(cell) + "' is not a number"});
  }
  return value;
}

base::Table read_table(const fs::path& path) {
  const std::string text = read_file(path);
  std::string_view rest = text;
  base::Table table{path.filename().string(), {}};
  for (std::string_view head = cut_at(rest, '\n'); !head.empty();) {
    table.columns.push_back({std::string(cut_at(head, ',')), {}});
  }
  for (std::size_t line = 2; !rest.empty(); ++line) {
    std::string_view row = cut_at(rest, '\n');
    const auto cells = std::count(row.begin(), row.end(), ',') + 1;
    const std::string place = path.string() + ":" + std::to_string(line) + ":1: ";
    if (cells != std::ssize(table.columns)) {
      throw base::InputError({place + std::to_string(cells) + " values, but " +
                              std::to_string(table.columns.size()) + " columns"});
    }
    for (auto& column : table.columns) {
      column.values.push_back(read_number(cut_at(row, ','), place));
    }
  }
  return table;
}

std::string title_of(const std::string& case_toml) {
  try {
    return toml::parse(case_toml)["title"].value_or(std::string{});
  } catch (const toml::parse_error&) {
    return {};  // the case is only shown, so it need not be right
  }
}

void take_summary(const fs::path& path, base::Answer& answer) {
  try {
    const Json summary = Json::parse(read_summary(path.parent_path()));
    answer.command = summary.at("command").get<std::string>();
    answer.ok = summary.at("status") == "ok";
    answer.message = summary.at("message").get<std::string>();
    for (const auto& entry : summary.at("warnings")) {
      answer.warnings.push_back({entry.at("code").get<std::string>(),
                                 entry.at("message").get<std::string>()});
    }
    answer.result = summary.at("result").dump();
  } catch (const Json::exception& error) {
    refuse(path, error.what());
  }
}

}  // namespace

std::string read_summary(const fs::path& folder) {
  const fs::path path = folder / "summary.json";
  std::string text = read_file(path);
  const Json summary = Json::parse(text, nullptr, false);
  if (!summary.is_object() || !summary.contains("trochoid")) {
    refuse(path, "not a summary.json of trochoid");
  }
  return text;
}

base::Answer read_folder(const fs::path& folder) {
  base::Answer answer;
  take_summary(folder / "summary.json", answer);
  answer.case_toml = read_file(folder / "case.toml");
  answer.title = title_of(answer.case_toml);
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_ours(entry.path().filename().string())) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  for (const auto& path : paths) {
    const std::string name = path.filename().string();
    if (path.extension() == ".csv") answer.tables.push_back(read_table(path));
    if (path.extension() == ".toml" && name != "case.toml") {
      answer.texts.push_back({name, read_file(path)});
    }
  }
  return answer;
}

}  // namespace trochoid::results
