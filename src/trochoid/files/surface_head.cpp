#include <trochoid/files/surface_head.h>

#include <trochoid/base/error.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace trochoid::files {

namespace {

constexpr std::size_t lines_at_most = 500;  // before the names
constexpr std::size_t numbers_at_most = 3;  // rows of them before the names
constexpr std::array separators = {';', '\t', ',', 'w', ' '};

/// One blank or, of a table in columns, more of them.
void split_wide(std::string_view line, std::vector<Field>& fields) {
  fields.clear();
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
    std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    while (end < line.size() && line[end] == ' ' && end + 1 < line.size() &&
           line[end + 1] != ' ' && line[end + 1] != '\t') {
      end = std::min(line.find_first_of(" \t", end + 1), line.size());
    }
    fields.push_back({line.substr(at, end - at), at + 1});
    at = end;
  }
}

/// `x` and `[mm]`, `x`, `/` and `mm`: one name.
void join_units(std::string_view line, std::vector<Field>& fields) {
  std::vector<Field> joined;
  for (const Field& field : fields) {
    const char first = field.text.front();
    const bool after_slash = !joined.empty() && joined.back().text.ends_with('/');
    if (!joined.empty() &&
        (first == '[' || first == '(' || first == '/' || after_slash)) {
      Field& name = joined.back();
      const std::size_t begin = name.column - 1;
      name.text = line.substr(begin, field.column - 1 + field.text.size() - begin);
    } else {
      joined.push_back(field);
    }
  }
  fields = std::move(joined);
}

/// @return the separator that makes numbers only of a line; none: it is another line
std::optional<char> separator_of_numbers(std::string_view line,
                                         std::vector<Field>& fields) {
  for (const char separator : separators) {
    split_names(line, separator, fields);
    while (!fields.empty() && fields.back().text.empty()) fields.pop_back();
    if (fields.size() > 1 &&
        std::all_of(fields.begin(), fields.end(), [](const Field& f) {
          const auto fault = parse_number(f.text).fault;
          return fault != NumberFault::not_a_number && fault != NumberFault::missing;
        })) {
      return separator;
    }
  }
  return std::nullopt;
}

void take_line(std::string_view line, char separator, std::size_t number,
               SurfaceHead& head) {
  head.names = line;
  head.head = {};
  head.head.names_line = number;
  split_names(head.names, separator, head.head.names);
  while (head.head.names.size() > 1 && head.head.names.back().text.empty()) {
    head.head.names.pop_back();
  }
}

char of_rows(char separator) {
  return separator == 'w' ? ' ' : separator;
}

/// Whether a line is the row of names, by one separator or another.
bool settle(TableText& table, std::string_view line, const SurfaceSource& source,
            SurfaceHead& head) {
  std::vector<char> marks(separators.begin(), separators.end());
  if (head.stated != 0) marks.assign(1, head.stated);
  for (const char separator : marks) {
    if (separator != 'w' && line.find(separator) == std::string_view::npos) continue;
    take_line(line, separator, table.lines.number(), head);
    if (names_surface(head.head, source)) {
      table.separator = of_rows(separator);
      return true;
    }
  }
  return false;
}

/// The line that comes nearest to a row of names, to say what it lacks.
struct Nearest {
  std::string line;
  std::size_t number = 0;
  std::size_t known = 0;
  char separator = ',';
  bool numbers = false;  ///< it is the first row of numbers, and nothing is above it
  bool axes = false;     ///< a list with one coordinate axis a row

  void see(std::string_view text, std::size_t at) {
    TableHead head;
    for (const char mark : separators) {
      if (mark != ',' && mark != 'w' && text.find(mark) == std::string_view::npos)
        continue;
      split_names(text, mark, head.names);
      axes = axes || lists_axes(head);
      const std::size_t names = known_names(head);
      if (number != 0 && names <= known) continue;
      line = text;
      number = at;
      known = names;
      separator = mark;
    }
  }
};

[[noreturn]] void refuse_head(TableText& table, const SurfaceSource& source,
                              const Nearest& nearest, SurfaceHead& head) {
  if (table.problems.lines.empty() && nearest.number == 0) {
    table.problems.add(
        1, 1,
        fmt::format("the file has no data: a row of names, for example {}, and rows "
                    "of numbers are needed",
                    surface_kind.example));
  }
  throw_problems(table);
  if (nearest.axes) {
    table.problems.add(nearest.number, 1,
                       "this list has one row for each coordinate axis of a point: "
                       "export one row a point, with its coordinates X, Y, Z and its "
                       "deviation, as text");
    throw_problems(table);
  }
  if (nearest.known == 0 && !nearest.numbers) {
    table.problems.add(
        nearest.number, 1,
        fmt::format("no row of names is found here or below, for example "
                    "{}, with rows of numbers under it",
                    surface_kind.example));
    throw_problems(table);
  }
  take_line(nearest.line, nearest.separator, nearest.number, head);
  static_cast<void>(find_surface_columns(head.head, source, table.problems));
  throw_problems(table);
  table.problems.add(nearest.number, 1,
                     "no row of names is found: place, height and error are needed");
  throw base::InputError(table.problems.lines);
}

void count_above(std::size_t line, SurfaceHead& head) {
  if (head.above++ == 0) head.first = line;
  head.last = line;
}

/// The names may stand in the last comment before the numbers.
bool take_comment(TableText& table, const std::string& comment,
                  const SurfaceSource& source, SurfaceHead& head) {
  std::string line = comment;  // its marks become blanks, so that places stay
  const std::size_t end = std::min(line.find_first_not_of("#%! \t"), line.size());
  std::fill(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(end), ' ');
  return settle(table, line, source, head);
}

}  // namespace

void split_names(std::string_view line, char separator, std::vector<Field>& fields) {
  if (separator == 'w') {
    split_wide(line, fields);
    join_units(line, fields);
  } else if (separator == ' ') {
    fields.clear();
    std::size_t at = 0;
    while ((at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
      const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
      fields.push_back({line.substr(at, end - at), at + 1});
      at = end;
    }
    join_units(line, fields);
  } else {
    split(line, separator, fields);
  }
}

void find_head(TableText& table, const SurfaceSource& source, SurfaceHead& head) {
  Nearest nearest;
  std::vector<Field> fields;
  std::string comment;
  std::size_t comment_line = 0;
  std::size_t rows = 0;
  while (const auto line = next_line(table)) {
    const std::size_t number = table.lines.number();
    if (number > lines_at_most) break;
    if (is_comment(table, *line)) {
      comment = *line;
      comment_line = number;
      continue;
    }
    if (line->size() == 5 && line->starts_with("sep=")) {  // as spreadsheets write
      head.stated = line->back();
      continue;
    }
    if (settle(table, *line, source, head)) return;
    if (const auto mark = separator_of_numbers(*line, fields)) {
      head.row = std::string(*line);
      if (comment_line > 0 && take_comment(table, comment, source, head)) {
        head.head.names_line = comment_line;
        return;
      }
      head.row.reset();
      if (nearest.number == 0) {
        nearest = {.line = std::string(*line), .number = number, .separator = *mark};
        nearest.numbers = true;
      }
      if (++rows == numbers_at_most) break;
    } else {
      nearest.see(*line, number);
    }
    count_above(number, head);
  }
  refuse_head(table, source, nearest, head);
}

}  // namespace trochoid::files
