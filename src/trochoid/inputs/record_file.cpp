#include <fmt/core.h>
#include <trochoid/base/error.h>
#include <trochoid/inputs/dynoware.h>
#include <trochoid/inputs/record_file.h>
#include <trochoid/inputs/record_file_columns.h>
#include <trochoid/inputs/record_file_time.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace trochoid::inputs {

namespace {

/// Everything that is known while the rows are read.
struct Reading {
  Reading(std::istream& in, const std::string& name, const Measurement& m)
      : measurement(m), lines(in) {
    problems.file = name;
    record.file = name;
  }

  const Measurement& measurement;
  LineReader lines;
  Problems problems;
  signal::Record record;
  bool dynoware = false;
  DynoWareHeader header;  ///< of a DynoWare export
  char separator = ',';
  RecordColumns columns;
  DecimalStyle style;
  std::vector<std::size_t> row_lines;
  std::size_t time_column = 1;  ///< in the last row
  double time_step = std::numeric_limits<double>::infinity();
};

void throw_problems(const Reading& reading) {
  if (!reading.problems.lines.empty()) {
    throw base::InputError(reading.problems.lines);
  }
}

/// Formats that are told apart by how their files begin.
std::string foreign_format(std::string_view begin) {
  const auto starts = [&](std::string_view text) {
    return begin.substr(0, text.size()) == text;
  };
  if (starts("MATLAB ") || starts("\x89HDF")) return "a MATLAB or HDF5 file";
  if (starts("TDSm")) return "a TDMS file";
  if (starts("LabVIEW Measurement")) return "a LabVIEW measurement file";
  if (starts("\xFF\xFE") || starts("\xFE\xFF")) return "UTF-16 text";
  if (starts("PK\x03\x04")) return "a packed file, perhaps a spreadsheet";
  return {};
}

/// The next line that holds something, as text; none at the end or after a problem.
std::optional<std::string_view> next_content(Reading& reading) {
  while (auto line = reading.lines.next()) {
    if (reading.lines.number() == 1 && line->substr(0, 3) == "\xEF\xBB\xBF") {
      line->remove_prefix(3);
    }
    if (reading.lines.number() == 1) {
      if (const auto foreign = foreign_format(*line); !foreign.empty()) {
        reading.problems.add(1, 1,
                             fmt::format("this is {}, which is not read yet: export it "
                                         "as CSV text in UTF-8",
                                         foreign));
        return std::nullopt;
      }
    }
    if (const auto at = control_character(*line)) {
      reading.problems.add(
          reading.lines.number(), *at,
          fmt::format("byte 0x{:02X} does not belong into a text: a record is a CSV "
                      "file or a DynoWare text export",
                      static_cast<unsigned char>((*line)[*at - 1])));
      return std::nullopt;
    }
    const auto first = line->find_first_not_of(" \t");
    if (first != std::string_view::npos && (*line)[first] != '#') return line;
  }
  if (reading.lines.too_long()) {
    reading.problems.add(
        reading.lines.number(), LineReader::longest + 1,
        fmt::format("the line is longer than {} bytes: a record has one sample a line",
                    LineReader::longest));
  }
  return std::nullopt;
}

void detect_separator(Reading& reading, std::string_view names) {
  for (const char mark : {';', '\t', ','}) {
    if (names.find(mark) == std::string_view::npos) continue;
    reading.separator = mark;
    return;
  }
}

/// Take the first lines up to the row of names.
std::string read_names(Reading& reading) {
  auto line = next_content(reading);
  if (!line) {
    if (reading.problems.lines.empty()) {
      reading.problems.add(1, 1,
                           "the file holds no data: a row of names, for example "
                           "angle_deg,Fx_N,Fy_N,Fz_N, and rows of numbers are needed");
    }
    return {};
  }
  reading.dynoware = is_dynoware(*line);
  const auto format = reading.measurement.format;
  if (format == FileFormat::dynoware && !reading.dynoware) {
    reading.problems.add(reading.lines.number(), 1,
                         "the case file says format = \"dynoware\", but a DynoWare "
                         "export begins with `DynoWare,Version ...`");
    return {};
  }
  if (format == FileFormat::csv && reading.dynoware) {
    reading.problems.add(reading.lines.number(), 1,
                         "this is a DynoWare export, but the case file says format = "
                         "\"csv\": \"dynoware\" is right");
    return {};
  }
  if (reading.dynoware) {
    reading.header =
        read_dynoware_header(std::string(*line), reading.lines, reading.problems);
    reading.separator = reading.header.separator;
    return reading.header.names;
  }
  if (line->size() == 5 && line->substr(0, 4) == "sep=") {  // as spreadsheets write
    reading.separator = (*line)[4];
    line = next_content(reading);
    return line ? std::string(*line) : std::string();
  }
  detect_separator(reading, *line);
  return std::string(*line);
}

std::string_view fault_text(NumberFault fault) {
  switch (fault) {
    case NumberFault::missing:
      return "the value is missing: every column needs a number in every row";
    case NumberFault::not_finite:
      return "is not a finite number: leave out or repair the sample";
    case NumberFault::out_of_range:
      return "is too large or too small for a number";
    default:
      return "is not a number";
  }
}

/// One number of a row; a problem and 0 when it is none.
double value_of(Reading& reading, const std::vector<Field>& fields,
                const RecordColumn& column) {
  const auto& field = fields[column.index];
  auto number = parse_number(field.text);
  const auto line = reading.lines.number();
  if (number.fault == NumberFault::none &&
      !std::isfinite(number.value * column.factor)) {
    number.fault = NumberFault::out_of_range;
  }
  if (number.fault == NumberFault::none) {
    reading.style.see(field.text, line, field.column);
    return number.value * column.factor;
  }
  const auto what =
      number.fault == NumberFault::missing ? std::string() : excerpt(field.text) + ' ';
  reading.problems.add(line, field.column,
                       fmt::format("column {}: {}{}", excerpt(column.name), what,
                                   fault_text(number.fault)));
  return 0.0;
}

void read_row(Reading& reading, std::vector<Field>& fields) {
  auto& columns = reading.columns;
  // Some programs end every row with a separator.
  if (fields.size() == columns.count + 1 && fields.back().text.empty()) {
    fields.pop_back();
  }
  if (fields.size() != columns.count) {
    const bool commas = reading.separator == ',' && fields.size() == 2 * columns.count;
    reading.problems.add(
        reading.lines.number(), 1,
        fmt::format("the row has {} fields, the row of names {}{}", fields.size(),
                    columns.count,
                    commas ? ": with decimal commas the columns must be separated by ; "
                             "or a tab"
                           : ": every row must be complete"));
    return;
  }
  auto& record = reading.record;
  for (std::size_t i = 0; i < 3; ++i) {
    if (columns.force[i]) {
      record.channel[i].push_back(value_of(reading, fields, *columns.force[i]));
    }
  }
  if (columns.angle) {
    record.angle.push_back(value_of(reading, fields, *columns.angle));
  }
  if (columns.time) {
    const auto& field = fields[columns.time->index];
    record.time.push_back(value_of(reading, fields, *columns.time));
    reading.time_column = field.column;
    reading.time_step =
        std::min(reading.time_step, last_decimal(field.text) * columns.time->factor);
  }
  reading.row_lines.push_back(reading.lines.number());
}

void read_rows(Reading& reading, RecordHead& head) {
  std::vector<Field> fields;
  auto line = next_content(reading);
  if (line) {
    split(*line, reading.separator, fields);
    if (is_unit_row(fields)) {
      head.units = fields;
      head.units_line = reading.lines.number();
    }
  }
  if (head.units.size() == head.names.size() + 1 && head.units.back().text.empty()) {
    head.units.pop_back();
  }
  if (!head.units.empty() && head.units.size() != head.names.size()) {
    reading.problems.add(head.units_line, 1,
                         fmt::format("the row of units has {} fields, the row of names "
                                     "{}: every column needs its unit",
                                     head.units.size(), head.names.size()));
    head.units.resize(std::min(head.units.size(), head.names.size()));
  }
  // The texts of the unit row end with the next line.
  reading.columns =
      find_columns(head, reading.measurement, reading.problems, reading.record.notes);
  if (!head.units.empty()) line = next_content(reading);
  while (line) {
    split(*line, reading.separator, fields);
    read_row(reading, fields);
    if (reading.problems.full()) return;
    line = next_content(reading);
  }
}

/// Angle, time and rate of the record from what is known of them.
void settle_time(Reading& reading) {
  auto& record = reading.record;
  const double given = reading.measurement.sample_rate.value_or(0.0);
  const double stated = reading.header.sample_rate;
  if (given > 0.0 && stated > 0.0 && std::abs(given - stated) > 1e-6 * stated) {
    reading.problems.add(reading.header.rate_line, 1,
                         fmt::format("the sampling rate here is {} Hz, the case file "
                                     "says {} Hz: they must agree",
                                     stated, given));
    return;
  }
  const double rate = given > 0.0 ? given : stated;
  const TimeColumn column{record.time,
                          reading.row_lines,
                          reading.time_column,
                          {reading.dynoware, reading.time_step}};
  if (rate > 0.0) {
    if (!record.time.empty()) check_rate(column, rate, reading.problems);
    const double first = record.time.empty() ? 0.0 : record.time.front();
    record.time.resize(record.size());
    for (std::size_t i = 0; i < record.size(); ++i) {
      record.time[i] = first + static_cast<double>(i) / rate;
    }
    record.sample_rate = rate;
  } else if (!record.time.empty()) {
    check_increasing(column, reading.problems);
    if (reading.problems.lines.empty()) record.sample_rate = even_rate(record.time);
  } else if (record.angle.empty()) {
    reading.problems.add(1, 1,
                         "neither angles nor times nor a sampling rate are known: add "
                         "a column angle_deg or time_s, or sample_rate_Hz in the case "
                         "file");
  }
}

void check_whole(Reading& reading) {
  reading.style.check(reading.problems);
  throw_problems(reading);
  const auto rows = reading.row_lines.size();
  const auto last = reading.lines.number();
  if (rows < 2) {
    reading.problems.add(
        last, 1,
        fmt::format("the record has {} sample{}: at least 2 are needed, "
                    "and a whole revolution to find anything",
                    rows, rows == 1 ? "" : "s"));
    throw_problems(reading);
  }
  const auto& time = reading.record.time;
  const auto first = time.empty() ? std::nullopt : std::optional(time.front());
  settle_time(reading);
  if (reading.dynoware) {
    const auto note = check_sample_count(
        reading.header, {rows, first, last, reading.lines.terminated()},
        reading.problems);
    if (!note.empty()) reading.record.notes.push_back({"part_of_record", note});
  }
  throw_problems(reading);
}

std::ifstream open(const Measurement& measurement) {
  const auto name = measurement.file.string();
  const auto where =
      measurement.location.empty() ? name + ":1:1" : measurement.location;
  const auto refuse = [&](std::string_view why) {
    throw base::InputError({fmt::format("{}: file = {}: {}", where, name, why)});
  };
  std::error_code error;
  const auto status = std::filesystem::status(measurement.file, error);
  if (!std::filesystem::exists(status)) refuse("there is no such file");
  if (!std::filesystem::is_regular_file(status)) {
    refuse("this is no regular file: name a CSV file or a DynoWare text export");
  }
  std::ifstream in(measurement.file, std::ios::binary);
  if (!in) refuse("the file cannot be opened for reading");
  if (in.peek() == std::ifstream::traits_type::eof()) {
    throw base::InputError({name + ":1:1: the file is empty: a row of names, for "
                                   "example angle_deg,Fx_N,Fy_N,Fz_N, and rows of "
                                   "numbers are needed"});
  }
  return in;
}

}  // namespace

signal::Record read_record(std::istream& in, const std::string& name,
                           const Measurement& measurement) {
  if (!measurement.columns.empty() && measurement.columns.size() != 3) {
    throw std::invalid_argument("read_record: columns must hold 3 names or none");
  }
  Reading reading(in, name, measurement);
  const auto names = read_names(reading);
  throw_problems(reading);
  RecordHead head;
  head.names_line = reading.lines.number();
  split(names, reading.separator, head.names);
  if (head.names.back().text.empty()) head.names.pop_back();
  if (head.names.size() < 3) {
    reading.problems.add(
        head.names_line, 1,
        fmt::format("the row of names has {} column{}: three forces are needed, "
                    "separated by , ; or a tab",
                    head.names.size(), head.names.size() == 1 ? "" : "s"));
    throw_problems(reading);
  }
  read_rows(reading, head);
  check_whole(reading);
  return std::move(reading.record);
}

signal::Record read_record(const Measurement& measurement) {
  auto in = open(measurement);
  return read_record(in, measurement.file.string(), measurement);
}

}  // namespace trochoid::inputs
