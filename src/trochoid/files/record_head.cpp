#include <trochoid/files/record_head.h>

#include <trochoid/files/csv.h>
#include <trochoid/files/csv_columns.h>
#include <trochoid/files/time_stamp.h>

#include <fmt/core.h>

#include <algorithm>
#include <vector>

namespace trochoid::files {

namespace {

/// A line that holds something.
struct Line {
  std::size_t number = 0;  ///< from 1
  std::string_view text;
  bool comment = false;
};

/// Marks that begin a comment; without the one that is a separator, too.
constexpr std::string_view comment_marks = "#%";
constexpr std::string_view blanks = " \t";

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> out;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::size_t first = line.find_first_not_of(blanks);
    if (first == std::string_view::npos) continue;
    const bool comment = comment_marks.find(line[first]) != std::string_view::npos;
    out.push_back({number, line, comment});
  }
  return out;
}

/// Words between blanks; a unit in brackets belongs to the word before it.
std::vector<std::string> words(std::string_view line) {
  std::vector<std::string> out;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(blanks, at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    const std::string_view word = line.substr(at, end - at);
    if (!out.empty() && (word.front() == '(' || word.front() == '[')) {
      out.back() += word;
    } else {
      out.emplace_back(word);
    }
    at = end;
  }
  return out;
}

std::vector<std::string> fields_of(std::string_view line, char separator) {
  if (separator == ' ') return words(line);
  std::vector<Field> fields;
  split(line, separator, fields);
  if (fields.back().text.empty()) fields.pop_back();
  std::vector<std::string> out;
  for (const Field& field : fields) out.emplace_back(field.text);
  return out;
}

bool reads_as_number(std::string_view text) {
  return parse_number(text).fault == NumberFault::none;
}

/// A row of numbers, the first of which may be a time of day.
bool is_data(const std::vector<std::string>& fields) {
  return fields.size() >= 2 &&
         (reads_as_number(fields.front()) || time_of_stamp(fields.front())) &&
         std::all_of(fields.begin() + 1, fields.end(), reads_as_number);
}

struct Data {
  std::size_t index = 0;  ///< of the line
  char separator = ',';
  std::size_t columns = 0;
};

std::optional<Data> find_data(const std::vector<Line>& lines) {
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    if (lines[i].comment || lines[i + 1].comment) continue;
    for (const char separator : {';', '\t', ',', ' '}) {
      const auto fields = fields_of(lines[i].text, separator);
      const auto next = fields_of(lines[i + 1].text, separator);
      if (is_data(fields) && is_data(next) && fields.size() == next.size()) {
        return Data{i, separator, fields.size()};
      }
    }
  }
  return std::nullopt;
}

/// Names of a line before the numbers; a comment may say `name: Fx name: Fy`.
std::vector<std::string> names_in(const Line& line, char separator) {
  std::string_view text = line.text;
  if (line.comment) {
    text = trimmed(text.substr(text.find_first_not_of(blanks)), " \t#%");
    std::vector<std::string> said = words(text);
    const auto name = [](const std::string& word) {
      return small_letters(word) == "name:";
    };
    if (std::ranges::count_if(said, name) > 1) {
      std::erase_if(said, name);
      return said;
    }
  }
  return fields_of(text, separator);
}

bool all_texts(const std::vector<std::string>& fields) {
  return std::ranges::none_of(fields, reads_as_number) &&
         std::ranges::any_of(fields, [](const auto& f) { return !f.empty(); });
}

/// Whether a line below the names holds their units.
bool all_units(const std::vector<std::string>& fields) {
  return std::ranges::all_of(fields,
                             [](const auto& f) { return f.empty() || is_unit(f); });
}

std::string joined(const std::vector<std::string>& fields, char separator) {
  std::string out;
  for (const std::string& field : fields) {
    if (!out.empty()) out += separator;
    // A blank within a word would separate it from itself.
    for (const char c : field) out += separator == ' ' && c == ' ' ? '_' : c;
  }
  return out;
}

/// Whether the first line names the columns of the numbers, as in a plain table.
bool begins_with_names(const std::vector<Line>& lines, const Data& data) {
  const auto first = std::ranges::find(lines, false, &Line::comment);
  if (data.separator == ' ' ||
      first - lines.begin() >= static_cast<std::ptrdiff_t>(data.index)) {
    return false;
  }
  if (first->text.starts_with("sep=")) return true;
  const auto fields = fields_of(first->text, data.separator);
  return fields.size() == data.columns && all_texts(fields);
}

RecordHead unnamed(const Data& data, std::size_t line) {
  RecordHead out{.separator = data.separator, .names = {}, .names_line = line};
  for (std::size_t i = 1; i <= data.columns; ++i) {
    if (i > 1) out.names += data.separator;
    out.names += fmt::format("{}", i);
  }
  return out;
}

/// Whether what a plain table would be read by is no row of names.
bool has_no_names(const std::vector<Line>& lines, const Data& data) {
  const auto first = std::ranges::find(lines, false, &Line::comment);
  return first - lines.begin() == static_cast<std::ptrdiff_t>(data.index);
}

}  // namespace

std::optional<RecordHead> find_record_head(std::string_view beginning) {
  const std::vector<Line> lines = lines_of(beginning);
  const std::optional<Data> data = find_data(lines);
  if (!data || begins_with_names(lines, *data)) return std::nullopt;
  std::optional<std::pair<std::size_t, std::vector<std::string>>> units;
  for (std::size_t i = data->index; i-- > 0;) {
    const std::vector<std::string> fields = names_in(lines[i], data->separator);
    if (fields.size() != data->columns || !all_texts(fields)) continue;
    if (!units && all_units(fields)) {
      units = {lines[i].number, fields};
      continue;
    }
    RecordHead out{.separator = data->separator,
                   .names = joined(fields, data->separator),
                   .names_line = lines[i].number,
                   .data_line = lines[data->index].number};
    if (units) {
      out.units_line = units->first;
      out.units = joined(units->second, data->separator);
    }
    return out;
  }
  if (!has_no_names(lines, *data)) return std::nullopt;
  RecordHead out = unnamed(*data, lines[data->index].number);
  out.data_line = lines[data->index].number;
  return out;
}

}  // namespace trochoid::files
