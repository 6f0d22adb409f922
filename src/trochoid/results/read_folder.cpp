#include <trochoid/base/error.h>
#include <trochoid/base/nesting.h>
#include <trochoid/base/read_text.h>
#include <trochoid/results/csv_cells.h>
#include <trochoid/results/folder.h>
#include <trochoid/results/json.h>

#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "disk.h"
#include "file_names.h"

namespace trochoid::results {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw base::InputError({path.string() + ":1:1: " + reason});
}

std::string read_file(const fs::path& path) {
  std::error_code error;
  // Not through a link: what it points to is nothing that we wrote.
  const auto type = fs::symlink_status(path, error).type();
  if (type == fs::file_type::not_found) refuse(path, "no such file");
  if (type != fs::file_type::regular) refuse(path, "not a regular file");
  auto text = base::read_text(path);
  if (!text) refuse(path, "cannot be read");
  return *std::move(text);
}

std::string_view cut_at(std::string_view& text, char mark) {
  const std::size_t end = text.find(mark);
  const std::string_view head = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  return head;
}

constexpr std::size_t longest_shown = 40;

/// An empty cell is a number that does not exist.
double read_number(std::string_view cell, const std::string& place) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0.0;
  const char* end = cell.data() + cell.size();
  const auto read = std::from_chars(cell.data(), end, value);
  if (read.ec != std::errc{} || read.ptr != end) {
    throw base::InputError({place + "'" + std::string(cell.substr(0, longest_shown)) +
                            "' is not a number"});
  }
  return value;
}

/// The cells of a row, a text where it stands in quotes.
void add_row(std::string_view row, const std::string& place, base::Table& table) {
  std::size_t cells = 0;
  for (bool more = true; more; ++cells) {
    const char* end = row.data() + row.size();
    const std::string_view cell = cut_cell(row);
    more = cell.data() + cell.size() != end;
    if (cells >= table.columns.size()) continue;
    auto& column = table.columns[cells];
    if (cell.starts_with('"')) {
      column.texts.push_back(unquoted(cell));
    } else {
      column.values.push_back(read_number(cell, place));
    }
  }
  if (cells != table.columns.size()) {
    throw base::InputError({place + std::to_string(cells) + " values, but " +
                            std::to_string(table.columns.size()) + " columns"});
  }
}

base::Table read_table(const fs::path& path) {
  const std::string text = read_file(path);
  std::string_view rest = text;
  base::Table table{path.filename().string(), {}};
  for (std::string_view head = cut_at(rest, '\n'); !head.empty();) {
    table.columns.push_back({std::string(cut_at(head, ',')), {}});
  }
  for (std::size_t line = 2; !rest.empty(); ++line) {
    add_row(cut_at(rest, '\n'),
            path.string() + ":" + std::to_string(line) + ":1: ", table);
  }
  for (const auto& column : table.columns) {
    if (!column.texts.empty() && !column.values.empty()) {
      refuse(path, "column " + column.name + " has numbers and texts");
    }
  }
  return table;
}

std::string title_of(const std::string& case_toml) {
  if (base::too_deep(case_toml)) return {};
  try {
    return toml::parse(case_toml)["title"].value_or(std::string{});
  } catch (const toml::parse_error&) {
    return {};  // the case is only shown, so it need not be right
  }
}

/// The member of that name; refused where there is none.
const Value& member(const fs::path& path, const Value& object, const char* key) {
  const Value* value = find(object, key);
  if (value == nullptr) refuse(path, std::string("it has no \"") + key + '"');
  return *value;
}

template <class Wanted>
const Wanted& part(const fs::path& path, const Value& object, const char* key) {
  const auto* value = std::get_if<Wanted>(&member(path, object, key).data);
  if (value == nullptr) refuse(path, std::string("\"") + key + "\" is of another kind");
  return *value;
}

Value parsed(const fs::path& path, const std::string& text) {
  try {
    return json_value(text);
  } catch (const std::invalid_argument& error) {
    refuse(path, error.what());
  }
}

void take_summary(const fs::path& path, Answer& answer) {
  const Value summary = parsed(path, read_summary(path.parent_path()));
  answer.command = part<std::string>(path, summary, "command");
  answer.heading.ok = part<std::string>(path, summary, "status") == "ok";
  answer.heading.message = part<std::string>(path, summary, "message");
  for (const Value& entry : part<Array>(path, summary, "warnings")) {
    answer.heading.warnings.push_back({part<std::string>(path, entry, "code"),
                                       part<std::string>(path, entry, "message")});
  }
  answer.result = part<Object>(path, summary, "result");
}

}  // namespace

std::string read_summary(const fs::path& folder) {
  const fs::path path = folder / "summary.json";
  std::string text = read_file(path);
  if (!is_our_summary(text)) refuse(path, "not a summary.json of trochoid");
  return text;
}

Answer read_folder(const fs::path& folder) {
  mend_folder(folder);
  Answer answer;
  take_summary(folder / "summary.json", answer);
  answer.heading.case_toml = read_file(folder / "case.toml");
  answer.heading.title = title_of(answer.heading.case_toml);
  std::vector<fs::path> paths;
  for (const std::string& name :
       names_in(folder).value_or(std::vector<std::string>{})) {
    if (is_ours(name)) paths.push_back(folder / name);
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
