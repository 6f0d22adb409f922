#include <trochoid/files/record_table.h>

#include <trochoid/files/csv_table.h>
#include <trochoid/files/dynoware.h>
#include <trochoid/files/record_file_columns.h>
#include <trochoid/files/record_file_pulse.h>
#include <trochoid/files/record_file_time.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::files {

namespace {

/// Everything that is known while the rows are read.
struct RecordReading {
  RecordReading(std::istream& in, const std::string& name, const RecordSource& m)
      : source(m), text(in, name, record_kind) {
    record.file = name;
  }

  const RecordSource& source;
  TableText text;
  signal::Record record;
  std::optional<DynoWareHeader> header;  ///< of a DynoWare export
  RecordColumns columns;
  std::vector<double> pulse;
  std::vector<std::size_t> row_lines;
  std::size_t time_column = 1;  ///< in the last row
  double time_step = std::numeric_limits<double>::infinity();
};

/// The first line that holds something; none, with a problem, in an empty file.
std::optional<std::string> first_content(RecordReading& reading) {
  const auto line = next_content(reading.text);
  if (line) {
    return std::string(*line);
  }
  if (reading.text.problems.lines.empty()) {
    reading.text.problems.add(
        1, 1,
        "the file holds no data: a row of names, for example "
        "angle_deg,Fx_N,Fy_N,Fz_N, and rows of numbers are needed");
  }
  return std::nullopt;
}

void read_row(RecordReading& reading, std::vector<Field>& fields) {
  auto& columns = reading.columns;
  if (!complete_row(reading.text, fields, columns.count)) return;
  auto& record = reading.record;
  for (std::size_t i = 0; i < 3; ++i) {
    record.channel[i].push_back(
        columns.force[i] ? number_in_row(reading.text, fields, *columns.force[i])
                         : 0.0);
  }
  if (columns.angle) {
    record.angle.push_back(number_in_row(reading.text, fields, *columns.angle));
  }
  if (columns.pulse) {
    reading.pulse.push_back(number_in_row(reading.text, fields, *columns.pulse));
  }
  if (columns.time) {
    const auto& field = fields[columns.time->index];
    record.time.push_back(number_in_row(reading.text, fields, *columns.time));
    reading.time_column = field.column;
    reading.time_step =
        std::min(reading.time_step, last_decimal(field.text) * columns.time->factor);
  }
  reading.row_lines.push_back(reading.text.lines.number());
}

void keep_names(const RecordColumns& columns, signal::Record& record) {
  for (std::size_t i = 0; i < 3; ++i) {
    record.measured[i] = columns.force[i].has_value();
    if (columns.force[i]) record.channel_column[i] = columns.force[i]->name;
  }
  if (columns.angle) record.angle_column = columns.angle->name;
  if (columns.time) record.time_column = columns.time->name;
}

/// Columns of text, a comment for example, are no mistake as long as nobody needs them.
void note_text_columns(RecordReading& reading, const TableHead& head,
                       const std::vector<Field>& row) {
  const auto& columns = reading.columns;
  const auto used = [&](std::size_t i) {
    const auto is = [i](const auto& column) { return column && column->index == i; };
    return is(columns.time) || is(columns.angle) || is(columns.pulse) ||
           std::any_of(columns.force.begin(), columns.force.end(), is);
  };
  for (std::size_t i = 0; i < std::min(row.size(), head.names.size()); ++i) {
    if (used(i) || parse_number(row[i].text).fault != NumberFault::not_a_number)
      continue;
    reading.record.notes.push_back(
        {"column_skipped", fmt::format("Column {} holds text and is not used.",
                                       excerpt(head.names[i].text))});
  }
}

void read_rows(RecordReading& reading, TableHead& head) {
  std::vector<Field> fields;
  auto line = next_content(reading.text);
  if (line) {
    split(*line, reading.text.separator, fields);
    take_units(reading.text, fields, head);
  }
  // The texts of the unit row end with the next line.
  reading.columns =
      find_columns(head, reading.source, reading.text.problems, reading.record.notes);
  keep_names(reading.columns, reading.record);
  if (!head.units.empty()) line = next_content(reading.text);
  for (bool first = true; line; first = false) {
    split(*line, reading.text.separator, fields);
    if (first) note_text_columns(reading, head, fields);
    read_row(reading, fields);
    if (reading.text.problems.full()) return;
    line = next_content(reading.text);
  }
}

/// The last row of an export that ends without a line end may be cut off inside its
/// last number.
void drop_last_row(RecordReading& reading) {
  auto& record = reading.record;
  for (auto& values : record.channel) values.pop_back();
  if (!record.angle.empty()) record.angle.pop_back();
  if (!record.time.empty()) record.time.pop_back();
  if (!reading.pulse.empty()) reading.pulse.pop_back();
  reading.row_lines.pop_back();
  record.notes.push_back(
      {"last_row_left_out",
       "The last line has no end, so that its last number may be cut off: the row is "
       "left out."});
}

void check_record(RecordReading& reading) {
  reading.text.style.check(reading.text.problems);
  throw_problems(reading.text);
  const bool in_part =
      reading.header && reading.header->samples &&
      static_cast<double>(reading.row_lines.size()) < *reading.header->samples;
  if (in_part && !reading.text.lines.terminated() && reading.row_lines.size() > 2) {
    drop_last_row(reading);
  }
  const auto rows = reading.row_lines.size();
  const auto last = reading.text.lines.number();
  if (rows < 2) {
    reading.text.problems.add(
        last, 1,
        fmt::format("the record has {} sample{}: at least 2 are needed, "
                    "and a whole revolution to find anything",
                    rows, rows == 1 ? "" : "s"));
    throw_problems(reading.text);
  }
  const auto& time = reading.record.time;
  const auto first = time.empty() ? std::nullopt : std::optional(time.front());
  const SampleRates rates{
      .given = reading.source.sample_rate.value_or(0.0),
      .stated = reading.header ? reading.header->sample_rate : 0.0,
      .stated_line = reading.header ? reading.header->rate_line : 0};
  settle_time(reading.record,
              {reading.record.time,
               reading.row_lines,
               reading.time_column,
               {reading.header.has_value(), reading.time_step}},
              rates, reading.text.problems);
  if (reading.header) {
    const auto note =
        check_sample_count(*reading.header, {rows, first}, reading.text.problems);
    if (!note.empty()) reading.record.notes.push_back({"part_of_record", note});
  }
  throw_problems(reading.text);
  if (reading.columns.pulse) {
    take_pulses(reading.record, reading.columns.pulse->name, reading.pulse,
                reading.text.problems);
    throw_problems(reading.text);
  }
}

/// @param names  the row of names
signal::Record read_table(RecordReading& reading, const std::string& names) {
  throw_problems(reading.text);
  TableHead head = head_of(reading.text, names);
  const std::size_t fewest = reading.source.columns.empty() ? 2 : 1;
  if (head.names.size() < fewest) {
    reading.text.problems.add(
        head.names_line, 1,
        fmt::format("the row of names has {} column{}: the forces and what they were "
                    "recorded over are needed, separated by , ; or a tab",
                    head.names.size(), head.names.size() == 1 ? "" : "s"));
    throw_problems(reading.text);
  }
  read_rows(reading, head);
  check_record(reading);
  return std::move(reading.record);
}

}  // namespace

signal::Record read_csv_record(std::istream& in, const std::string& name,
                               const RecordSource& source) {
  RecordReading reading(in, name, source);
  const auto line = first_content(reading);
  return read_table(reading, line ? names_row(reading.text, *line) : std::string());
}

signal::Record read_dynoware_record(std::istream& in, const std::string& name,
                                    const RecordSource& source) {
  RecordReading reading(in, name, source);
  if (const auto line = first_content(reading)) {
    reading.header =
        read_dynoware_header(*line, reading.text.lines, reading.text.problems);
    reading.text.separator = reading.header->separator;
  }
  return read_table(reading, reading.header ? reading.header->names : std::string());
}

}  // namespace trochoid::files
