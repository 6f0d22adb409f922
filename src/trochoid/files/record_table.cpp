#include <trochoid/files/record_table.h>

#include <trochoid/files/csv_columns.h>
#include <trochoid/files/csv_table.h>
#include <trochoid/files/dynoware.h>
#include <trochoid/files/record_file_columns.h>
#include <trochoid/files/record_file_pulse.h>
#include <trochoid/files/record_file_time.h>
#include <trochoid/files/record_head.h>
#include <trochoid/files/time_stamp.h>

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
  std::optional<RecordHead> found_head;  ///< of a table that other lines stand before
  std::optional<TimeStamp> first_stamp;  ///< of times that are times of a day
  std::size_t time_column = 1;           ///< in the last row
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
        "the file has no data: a row of names, for example "
        "angle_deg,Fx_N,Fy_N,Fz_N, and rows of numbers are needed");
  }
  return std::nullopt;
}

/// A time in seconds; those of a day are counted from the whole second of the first.
double time_in_row(RecordReading& reading, const std::vector<Field>& fields) {
  const TableColumn& column = *reading.columns.time;
  const std::string_view text = fields[column.index].text;
  const auto stamp = parse_number(text).fault == NumberFault::not_a_number
                         ? time_of_stamp(text)
                         : std::nullopt;
  if (!stamp) return number_in_row(reading.text, fields, column);
  if (!reading.first_stamp) {
    reading.first_stamp = stamp;
    reading.first_stamp->seconds = std::floor(stamp->seconds);
  }
  return stamp->since(*reading.first_stamp);
}

void read_row(RecordReading& reading, std::vector<Field>& fields) {
  auto& columns = reading.columns;
  if (!complete_row(reading.text, fields, columns.count)) return;
  auto& record = reading.record;
  for (std::size_t i = 0; i < columns.force.size(); ++i) {
    record.values_of(i).push_back(
        columns.force[i] ? number_in_row(reading.text, fields, *columns.force[i])
                         : 0.0);
  }
  if (columns.angle) {
    record.angle.push_back(number_in_row(reading.text, fields, *columns.angle));
  }
  if (columns.pulse) {
    reading.pulse.push_back(number_in_row(reading.text, fields, *columns.pulse));
  }
  if (columns.line) {
    record.line.push_back(number_in_row(reading.text, fields, *columns.line));
  }
  if (columns.time) {
    const auto& field = fields[columns.time->index];
    record.time.push_back(time_in_row(reading, fields));
    reading.time_column = field.column;
    const std::string_view seconds = field.text.substr(field.text.rfind(':') + 1);
    reading.time_step =
        std::min(reading.time_step, last_decimal(seconds) * columns.time->factor);
  }
  reading.row_lines.push_back(reading.text.lines.number());
}

void keep_names(const RecordColumns& columns, signal::Record& record) {
  keep_channels(columns, record);
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
           is(columns.line) ||
           std::any_of(columns.force.begin(), columns.force.end(), is);
  };
  for (std::size_t i = 0; i < std::min(row.size(), head.names.size()); ++i) {
    if (used(i) || parse_number(row[i].text).fault != NumberFault::not_a_number)
      continue;
    reading.record.notes.push_back(
        {"column_skipped", fmt::format("Column {} contains text and is not used.",
                                       excerpt(head.names[i].text))});
  }
}

void read_rows(RecordReading& reading, TableHead& head) {
  std::vector<Field> fields;
  auto line = next_content(reading.text);
  if (line) {
    split_row(reading.text, *line, fields);
    if (!reading.found_head) take_units(reading.text, fields, head);
  }
  // The texts of the unit row end with the next line.
  reading.columns =
      find_columns(head, reading.source, reading.text.problems, reading.record.notes);
  keep_names(reading.columns, reading.record);
  if (!head.units.empty() && !reading.found_head) line = next_content(reading.text);
  for (bool first = true; line; first = false) {
    split_row(reading.text, *line, fields);
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
  if (!record.line.empty()) record.line.pop_back();
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

/// Where nothing tells angle or time, the columns that might are named.
void check_axis(RecordReading& reading, const TableHead& head) {
  if (!reading.text.problems.lines.empty()) return;
  const RecordColumns& columns = reading.columns;
  const bool rate = reading.source.sample_rate.has_value() ||
                    (reading.header && reading.header->sample_rate > 0.0);
  if (columns.time || columns.angle || columns.pulse || rate) return;
  TableHead others;
  for (std::size_t i = 0; i < head.names.size(); ++i) {
    const bool force = std::ranges::any_of(columns.force, [&](const auto& column) {
      return column && column->index == i;
    });
    if (!force) others.names.push_back(head.names[i]);
  }
  if (others.names.empty()) return;  // settle_time says what is lacking
  reading.text.problems.add(
      head.names_line, 1,
      fmt::format(
          "neither angles nor times nor a sampling rate are known: add a column "
          "angle_deg or time_s, or sample_rate_Hz in the case file, or "
          "time_column there, if that is one of {}",
          all_names(others)));
  throw_problems(reading.text);
}

/// Three or four columns without names, which are those of an array of NumPy.
void assume_names(RecordReading& reading, const TableHead& head) {
  RecordHead& found = *reading.found_head;
  const std::size_t count = head.names.size();
  if (found.named() || !reading.source.columns.empty() || count < 3 || count > 4) {
    return;
  }
  const bool time = count == 4 && reading.source.time_column.empty();
  if (count == 4 && !time) return;
  const char mark = found.separator;
  found.names =
      fmt::format("{}Fx{}Fy{}Fz", time ? std::string("time") + mark : "", mark, mark);
  reading.record.notes.push_back(
      {"columns_assumed",
       fmt::format("The columns have no names; they were taken for {}Fx, Fy, Fz.",
                   time ? "time, " : "")});
}

/// A table that does not begin with a row of names.
signal::Record read_below(RecordReading& reading) {
  const RecordHead& found = *reading.found_head;
  LineReader& lines = reading.text.lines;
  while (lines.number() + 1 < found.data_line && lines.next()) {
  }
  reading.text.separator = found.separator;
  TableHead head{.names_line = found.names_line, .units_line = found.units_line};
  split_row(reading.text, found.names, head.names);
  assume_names(reading, head);
  split_row(reading.text, found.names, head.names);
  if (!found.units.empty()) split_row(reading.text, found.units, head.units);
  head.units.resize(found.units.empty() ? 0 : head.names.size());
  if (found.names_line > 1 && found.named()) {
    reading.record.notes.push_back(
        {"lines_passed_over",
         fmt::format("The columns are named in line {}; what stands before it is not "
                     "looked at.",
                     found.names_line)});
  }
  read_rows(reading, head);
  check_axis(reading, head);
  check_record(reading);
  return std::move(reading.record);
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
  check_axis(reading, head);
  check_record(reading);
  return std::move(reading.record);
}

}  // namespace

signal::Record read_csv_record(std::istream& in, const std::string& name,
                               const RecordSource& source) {
  constexpr std::size_t longest_head = std::size_t{1} << 16;
  RecordReading reading(in, name, source);
  reading.found_head = find_record_head(first_bytes(in, longest_head));
  if (reading.found_head) return read_below(reading);
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
