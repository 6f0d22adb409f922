#include <trochoid/files/surface_file.h>

#include <trochoid/files/numeric_table.h>
#include <trochoid/files/surface_columns.h>
#include <trochoid/files/surface_head.h>
#include <trochoid/files/surface_map.h>
#include <trochoid/files/surface_place.h>
#include <trochoid/files/surface_repeats.h>
#include <trochoid/files/surface_row.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trochoid::files {

namespace {

/// More teeth than a case can have.
constexpr double most_teeth = 64;

/// Lines of text below the row of names.
struct TextBelow {
  std::vector<std::size_t> open;  ///< lines since the last row of numbers
  std::size_t count = 0;
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t heads = 0;  ///< the row of names again, on every page of a print
  /// Rows that begin with a word and lack values: statistics, unless readings follow.
  std::vector<std::size_t> perhaps;
};

/// Everything that is known while the rows are read.
struct SurfaceReadings {
  SurfaceReadings(std::istream& in, const SurfaceSource& m, int of_teeth)
      : source(m), teeth(of_teeth), table(in, m.file.path, surface_kind) {}

  const SurfaceSource& source;
  int teeth;
  TableText table;
  SurfaceHead head;
  std::string units;  ///< the line; fields of the head are parts of it
  SurfaceColumns columns;
  std::vector<std::size_t> used;  ///< places of columns that must hold a number
  SurfaceFile surface;
  TextBelow text;
  std::size_t first_skipped = 0;
};

int tooth_in_row(SurfaceReadings& reading, const std::vector<Field>& fields,
                 const TableColumn& column) {
  auto& table = reading.table;
  const auto before = table.problems.lines.size();
  const double tooth = number_in_row(table, fields, column);
  if (table.problems.lines.size() > before) {
    return 0;
  }
  const double most = reading.teeth > 0 ? reading.teeth : most_teeth;
  if (tooth < 1 || tooth > most || tooth != std::floor(tooth)) {
    const auto& field = fields[column.index];
    table.problems.add(table.lines.number(), field.column,
                       fmt::format("column {}: {} is no tooth: must be a whole number "
                                   "from 1 to {}",
                                   excerpt(column.name), excerpt(field.text), most));
    return 0;
  }
  return static_cast<int>(tooth);
}

/// Three columns for one thing: the deviation must be what the other two make.
void check_deviation(SurfaceReadings& reading, const std::vector<Field>& fields,
                     const SurfaceValues& values) {
  const auto& columns = reading.columns;
  double rounded = 0.0;  // a number without decimals beside others is exact
  double whole = 0.0;
  for (const auto* column : {&columns.actual, &columns.nominal, &columns.error}) {
    const double step = last_decimal_of(fields[(*column)->index].text);
    (step < 1.0 ? rounded : whole) += 0.505 * step * (*column)->factor;
  }
  const double difference = *values.actual - *values.nominal;
  const double allowed = rounded > 0.0 ? rounded : whole;
  if (std::abs(difference - *values.error) <= allowed) return;
  const auto& field = fields[columns.error->index];
  reading.table.problems.add(
      reading.table.lines.number(), field.column,
      fmt::format("column {}: the deviation of {} mm is not measured less nominal, {} "
                  "mm: leave out the column that is not meant, or turn its sign round",
                  excerpt(columns.error->name), in_mm(*values.error),
                  in_mm(difference)));
}

void read_row(SurfaceReadings& reading, const std::vector<Field>& fields) {
  auto& table = reading.table;
  const auto& columns = reading.columns;
  const auto before = table.problems.lines.size();
  const auto number = [&](const std::optional<TableColumn>& column) {
    return column ? std::optional(number_in_row(table, fields, *column)) : std::nullopt;
  };
  SurfaceReading one;
  one.x = number(columns.x);
  one.step = number(columns.step);
  one.feed_offset = number(columns.feed_offset);
  one.height = number(columns.height).value_or(0.0);
  SurfaceValues values{number(columns.error), number(columns.actual),
                       number(columns.nominal)};
  if (columns.tooth) one.tooth = tooth_in_row(reading, fields, *columns.tooth);
  one.line = table.lines.number();
  if (reading.source.frame) {
    Direction point{};
    for (std::size_t i = 0; i < 3; ++i) {
      point[i] = number(columns.coordinate[i]).value_or(0.0);
    }
    place_in_frame(*reading.source.frame, point, values, one);
  } else {
    one.error = error_of(values).value_or(0.0);
  }
  if (reading.source.height) one.height = *reading.source.height;
  if (table.problems.lines.size() > before) return;
  if (values.error && values.actual && values.nominal) {
    check_deviation(reading, fields, values);
  }
  if (!std::isfinite(one.error + one.height + one.x.value_or(0.0))) {
    table.problems.add(one.line, 1, "the numbers of this row are too large");
  }
  reading.surface.readings.push_back(one);
}

void count_gap(SurfaceReadings& reading, std::size_t line) {
  if (reading.surface.counts.skipped++ == 0) reading.first_skipped = line;
}

void count_text_at(TextBelow& text, std::size_t line) {
  if (text.count++ == 0) text.first = line;
  text.last = line;
}

/// `Statistics;;;` and, below it, `Mean;;;0.05`; or else points that failed.
bool may_be_statistics(const SurfaceReadings& reading,
                       const std::vector<Field>& fields) {
  const auto& used = reading.used;
  return is_text(fields.front()) && used.front() != 0 &&
         (!reading.text.open.empty() || !reading.text.perhaps.empty() ||
          std::all_of(used.begin(), used.end(),
                      [&](std::size_t i) { return is_missing(fields[i].text); }));
}

/// Text was at the end, or else there is a row that cannot be read.
void refuse_open_text(SurfaceReadings& reading) {
  for (const std::size_t line : reading.text.perhaps) {
    count_gap(reading, line);
  }
  reading.text.perhaps.clear();
  for (const std::size_t line : reading.text.open) {
    reading.table.problems.add(line, 1,
                               "this line is no row of numbers, but rows follow: leave "
                               "it out, or begin it with #");
  }
  reading.text.open.clear();
}

void count_text(SurfaceReadings& reading, std::string_view line) {
  auto& text = reading.text;
  const std::size_t at = reading.table.lines.number();
  if (line == reading.head.names || (!reading.units.empty() && line == reading.units)) {
    if (line == reading.head.names) ++text.heads;
    return;
  }
  if (is_rule(line)) return;
  if (text.open.size() < 1000) text.open.push_back(at);
  count_text_at(text, at);
}

void take_line(SurfaceReadings& reading, std::string_view line,
               std::vector<Field>& fields) {
  auto& table = reading.table;
  split_row(table, line, fields);
  const std::size_t count = reading.head.head.names.size();
  if (fields.size() == count + 1 && fields.back().text.empty()) fields.pop_back();
  const bool whole = fields.size() == count;
  // Spreadsheets may end with rows of nothing.
  if (std::all_of(fields.begin(), fields.end(),
                  [](const Field& field) { return field.text.empty(); })) {
    return;
  }
  const bool rule = is_rule(line) && (table.separator == ' ' || fields.size() == 1);
  if (rule || is_text(fields[whole ? reading.used.front() : 0])) {
    count_text(reading, line);
    return;
  }
  const bool gap =
      whole && std::any_of(reading.used.begin(), reading.used.end(),
                           [&](std::size_t i) { return is_missing(fields[i].text); });
  if (gap && may_be_statistics(reading, fields)) {
    reading.text.perhaps.push_back(table.lines.number());
    return;
  }
  if (gap) {
    count_gap(reading, table.lines.number());
    return;
  }
  refuse_open_text(reading);
  if (complete_row(table, fields, count)) read_row(reading, fields);
}

/// The names may have commas where the rows have blanks.
void settle_rows(SurfaceReadings& reading, std::string_view line,
                 std::vector<Field>& fields) {
  const std::size_t count = reading.head.head.names.size();
  split_row(reading.table, line, fields);
  if (fields.size() > 1) return;
  const char stated = reading.table.separator;
  for (const char mark : {';', '\t', ',', ' '}) {
    reading.table.separator = mark;
    split_row(reading.table, line, fields);
    if (fields.size() == count) return;
  }
  reading.table.separator = stated;
  split_row(reading.table, line, fields);
}

void read_rows(SurfaceReadings& reading) {
  auto& table = reading.table;
  std::vector<Field> fields;
  std::optional<std::string_view> line;
  if (reading.head.row) {
    line = *reading.head.row;
    settle_rows(reading, *line, fields);
  } else if ((line = next_content(table))) {
    reading.units = *line;
    settle_rows(reading, reading.units, fields);
    if (table.separator == ' ') put_below(reading.head.head.names, fields);
    take_units(table, fields, reading.head.head);
  }
  reading.columns =
      find_surface_columns(reading.head.head, reading.source, table.problems);
  throw_problems(table);
  reading.used = used_columns(reading.columns);
  if (reading.head.head.units.empty()) {
    reading.units.clear();
  } else {
    line = next_content(table);
  }
  while (line && !table.problems.full()) {
    take_line(reading, *line, fields);
    line = next_content(table);
  }
  for (const std::size_t at : reading.text.perhaps) {
    count_text_at(reading.text, at);
  }
}

std::string span(std::size_t count, std::size_t first, std::size_t last) {
  return count == 1 ? fmt::format("line {}", first)
                    : fmt::format("lines {} to {}", first, last);
}

void add_notes(SurfaceReadings& reading) {
  auto& notes = reading.surface.notes;
  const auto& head = reading.head;
  const auto& text = reading.text;
  std::string skipped;
  if (head.above > 0) {
    skipped = span(head.above, head.first, head.last) + " before the row of names";
  }
  if (text.count > 0) {
    skipped += (skipped.empty() ? "" : ", ") + span(text.count, text.first, text.last) +
               " after the last reading";
  }
  if (text.heads > 0) {
    skipped += fmt::format("{}the row of names where it stands again ({})",
                           skipped.empty() ? "" : ", ", text.heads);
  }
  if (!skipped.empty()) {
    notes.push_back({"lines_skipped", "Text was skipped: " + skipped + "."});
  }
  const std::size_t gaps = reading.surface.counts.skipped;
  if (gaps > 0) {
    notes.push_back(
        {"readings_skipped",
         fmt::format(
             "{} of {} rows were left out because a value is missing, the first "
             "in line {}.",
             gaps, gaps + reading.surface.readings.size(), reading.first_skipped)});
  }
}

void check_surface_rows(SurfaceReadings& reading) {
  auto& table = reading.table;
  table.style.check(table.problems);
  const std::size_t gaps = reading.surface.counts.skipped;
  const std::size_t read = reading.surface.readings.size();
  if (gaps > read) {
    table.problems.add(reading.first_skipped, 1,
                       fmt::format("{} of {} rows, this one first, lack a value in one "
                                   "of the columns that are used: at most half may",
                                   gaps, gaps + read));
  }
  throw_problems(table);
  if (read == 0 && reading.text.count > 0) {
    table.problems.add(reading.text.first, 1,
                       "this line is no row of numbers, and none follows: its place or "
                       "its error is a text");
  } else if (read == 0) {
    table.problems.add(std::max<std::size_t>(table.lines.number(), 1), 1,
                       "no reading follows the row of names: "
                       "rows of numbers are needed");
  }
  throw_problems(table);
}

std::string unit_text(const std::optional<TableColumn>& column) {
  if (!column) return {};
  for (const auto unit : {LengthUnit::mm, LengthUnit::um, LengthUnit::m, LengthUnit::in,
                          LengthUnit::thou}) {
    if (factor_of(unit) == column->factor) return std::string(name_of(unit));
  }
  return {};
}

/// As read_surface_file, without the averages.
SurfaceFile read_surface_table(std::istream& in, const SurfaceSource& source,
                               int teeth) {
  SurfaceReadings reading(in, source, teeth);
  find_head(reading.table, source, reading.head);
  read_rows(reading);
  check_surface_rows(reading);
  add_notes(reading);
  reading.surface.x_unit = unit_text(reading.columns.x);
  reading.surface.height_unit = unit_text(reading.columns.height);
  return std::move(reading.surface);
}

SurfaceFile read_map(std::istream& in, const SurfaceSource& source, bool archive) {
  const SurfaceMap map =
      archive ? read_x3p(in, source.file.path) : read_sdf(in, source.file.path);
  if (source.unit) {
    refuse(
        source.file.path,
        "unit of the [[surface_measurement]]: X3P and SDF files are in metres; leave "
        "it out");
  }
  return readings_of(map, source);
}

}  // namespace

std::optional<double> SurfaceCounts::repeatability() const {
  if (repeats == 0) return std::nullopt;
  return std::sqrt(squares / static_cast<double>(repeats));
}

void SurfaceCounts::add(const SurfaceCounts& other) {
  skipped += other.skipped;
  repeats += other.repeats;
  squares += other.squares;
}

SurfaceFile read_surface_file(std::istream& in, const SurfaceSource& source,
                              int teeth) {
  const auto& frame = source.frame;
  if (frame &&
      (frame->origin.size() != 3 || !frame->feed || !frame->normal || !frame->up)) {
    throw std::invalid_argument("read_surface: the frame lacks a direction");
  }
  const std::string head = first_bytes(in, 16);
  if (is_archive(head) || is_sdf(head)) {
    return read_map(in, source, is_archive(head));
  }
  SurfaceFile surface = read_surface_table(in, source, teeth);
  average_repeats(surface);
  surface.framed = frame.has_value();
  return surface;
}

SurfaceFile read_surface_file(const SurfaceSource& source, int teeth) {
  return read_surface_file(*open_table(source.file, surface_kind), source, teeth);
}

std::vector<SurfaceReading> read_surface(std::istream& in, const std::string& name,
                                         int teeth) {
  const SurfaceSource source{.file = file_at(name)};
  return read_surface_file(in, source, teeth).readings;
}

std::vector<SurfaceReading> read_surface(const SurfaceSource& source, int teeth) {
  return read_surface_file(source, teeth).readings;
}

}  // namespace trochoid::files
