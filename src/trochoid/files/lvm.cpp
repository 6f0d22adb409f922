#include <trochoid/files/lvm.h>

#include <trochoid/base/error.h>
#include <trochoid/files/csv_table.h>
#include <trochoid/files/numeric_table.h>

#include <fmt/core.h>

#include <algorithm>
#include <map>

namespace trochoid::files {

namespace {

constexpr std::string_view first_words = "LabVIEW Measurement";
constexpr TableKind lvm_kind{.noun = "a LabVIEW measurement file",
                             .files = "text with tables",
                             .row = "sample",
                             .example = "",
                             .begins = first_words};
constexpr std::string_view end_of_head = "***End_of_Header***";
constexpr std::string_view begin_of_special = "***Start_Special***";
constexpr std::string_view end_of_special = "***End_Special***";
constexpr std::size_t head_lines_at_most = 500;

/// A key of a head and the fields after it, one a channel.
struct Entry {
  std::size_t line = 0;
  std::vector<std::string> values;
};
using Head = std::map<std::string, Entry, std::less<>>;

struct LvmReading {
  TableText text;
  char decimal = '.';
  std::string x_columns = "One";  ///< One, Multi or No
  Head segment;
  std::size_t samples = 0;  ///< of the longest channel, as the head says
  bool further_segments = false;
};

/// A column of the table, by its place in a row.
struct SegmentPlace {
  std::size_t field = 0;
  std::size_t channel = 0;
};

/// Lines up to the end of a head.
Head read_head(LvmReading& reading) {
  Head head;
  std::vector<Field> fields;
  bool special = false;
  const std::size_t first = reading.text.lines.number();
  while (const auto line = next_line(reading.text)) {
    split(*line, reading.text.separator, fields);
    const auto key = fields[0].text;
    if (key == end_of_head) return head;
    if (reading.text.lines.number() > first + head_lines_at_most) break;
    if (key == begin_of_special || key == end_of_special) {
      special = key == begin_of_special;
    }
    if (special || key.empty()) continue;
    Entry& entry = head[std::string(key)];
    entry.line = reading.text.lines.number();
    entry.values.clear();
    for (std::size_t i = 1; i < fields.size(); ++i) {
      entry.values.emplace_back(fields[i].text);
    }
  }
  if (reading.text.problems.lines.empty()) {
    reading.text.problems.add(
        reading.text.lines.number(), 1,
        fmt::format("a head of this LabVIEW file has no end: a line {} must "
                    "follow; the file is cut off or damaged",
                    end_of_head));
  }
  throw_problems(reading.text);
  return head;
}

std::string value_of(const Head& head, std::string_view key, std::size_t i,
                     std::string_view standard) {
  const auto at = head.find(key);
  if (at == head.end() || at->second.values.size() <= i) return std::string(standard);
  return at->second.values[i];
}

/// A number of a head; 0 where there is none.
double number_of(LvmReading& reading, std::string_view key, std::size_t i) {
  const auto text = value_of(reading.segment, key, i, "");
  if (text.empty()) return 0.0;
  const Number number = parse_number(text);
  if (number.fault == NumberFault::none) return number.value;
  reading.text.problems.add(
      reading.segment.find(key)->second.line, 1,
      fmt::format("{} {}: a number is needed here", key, excerpt(text)));
  return 0.0;
}

void read_heads(LvmReading& reading) {
  const auto first = next_line(reading.text);
  // What stands behind the first words separates the fields, unless the head says more.
  if (first && first->find(',') != std::string_view::npos) reading.text.separator = ',';
  const Head file = read_head(reading);
  const auto separator = value_of(file, "Separator", 0, "Tab");
  reading.text.separator = separator == "Comma" ? ',' : '\t';
  const auto decimal = value_of(file, "Decimal_Separator", 0, ".");
  if (!decimal.empty()) reading.decimal = decimal.front();
  reading.x_columns = value_of(file, "X_Columns", 0, "One");
  reading.segment = read_head(reading);
  const auto samples = reading.segment.find("Samples");
  if (samples == reading.segment.end()) return;
  for (std::size_t i = 0; i < samples->second.values.size(); ++i) {
    const double count = number_of(reading, "Samples", i);
    if (count >= 1.0 && count < 1e15) {
      reading.samples = std::max(reading.samples, static_cast<std::size_t>(count));
    }
  }
}

/// The channels of the row of names; the times stand before one or each of them.
std::vector<SegmentPlace> places_of(const LvmReading& reading,
                                    const std::vector<Field>& names) {
  std::vector<SegmentPlace> places;
  const auto stated = parse_number(value_of(reading.segment, "Channels", 0, ""));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto name = names[i].text;
    const bool all = stated.fault == NumberFault::none &&
                     static_cast<double>(places.size()) >= stated.value;
    if (name.empty() || name == "X_Value" || name == "Comment" || all) continue;
    places.push_back({i, places.size()});
  }
  return places;
}

std::optional<double> number_at(LvmReading& reading, const Field& field,
                                const NumericColumn& column) {
  if (field.text.find(reading.decimal == '.' ? ',' : '.') == std::string_view::npos) {
    const Number number = parse_number(field.text);
    if (number.fault == NumberFault::none) return number.value;
  }
  reading.text.problems.add(
      reading.text.lines.number(), field.column,
      fmt::format("column {}: {} is not a finite number with a decimal {}",
                  excerpt(column.name), excerpt(field.text),
                  reading.decimal == '.' ? "point" : "comma"));
  return std::nullopt;
}

struct LvmColumns {
  std::vector<SegmentPlace> places;
  NumericTable table;
  std::vector<std::vector<double>> values;
  std::size_t rows = 0;
};

LvmColumns read_names(LvmReading& reading) {
  LvmColumns columns;
  std::vector<Field> names;
  if (const auto line = next_line(reading.text)) {
    split(*line, reading.text.separator, names);
  }
  columns.places = places_of(reading, names);
  for (const auto& [field, channel] : columns.places) {
    const double step = number_of(reading, "Delta_X", channel);
    const auto dimension = value_of(reading.segment, "X_Dimension", channel, "Time");
    if (dimension != "Time" && !dimension.empty()) {
      reading.text.problems.add(
          reading.segment.find("X_Dimension")->second.line, 1,
          fmt::format("column {} is over {}: a record over Time is needed",
                      excerpt(names[field].text), excerpt(dimension)));
    }
    columns.table.columns.push_back(
        {.name = std::string(names[field].text),
         .path = {},
         .unit = value_of(reading.segment, "Y_Unit_Label", channel, ""),
         .sample_rate = step > 0.0 ? 1.0 / step : 0.0,
         .first_time = number_of(reading, "X0", channel)});
  }
  // Without a step the times themselves are needed.
  const auto x = std::find_if(names.begin(), names.end(),
                              [](const Field& f) { return f.text == "X_Value"; });
  const bool stepped =
      !columns.table.columns.empty() && columns.table.columns.front().sample_rate > 0.0;
  if (x != names.end() && reading.x_columns != "No" && !stepped) {
    columns.places.push_back({static_cast<std::size_t>(x - names.begin()), 0});
    columns.table.columns.push_back({.name = "time", .path = {}, .unit = "s"});
  }
  columns.values.resize(columns.places.size());
  throw_problems(reading.text);
  return columns;
}

void read_row(LvmReading& reading, const std::vector<Field>& fields,
              LvmColumns& columns) {
  const std::size_t line = reading.text.lines.number();
  for (std::size_t i = 0; i < columns.places.size(); ++i) {
    const std::size_t at = columns.places[i].field;
    if (at >= fields.size() || fields[at].text.empty()) continue;  // a shorter channel
    const auto& column = columns.table.columns[i];
    if (columns.values[i].size() < columns.rows) {
      reading.text.problems.add(
          line, fields[at].column,
          fmt::format("column {}: the value of the row before is missing",
                      excerpt(column.name)));
      return;
    }
    if (const auto value = number_at(reading, fields[at], column)) {
      columns.values[i].push_back(*value);
    } else {
      columns.values[i].push_back(0.0);
    }
  }
  ++columns.rows;
}

void read_rows(LvmReading& reading, LvmColumns& columns) {
  std::vector<Field> fields;
  while (const auto line = next_line(reading.text)) {
    split(*line, reading.text.separator, fields);
    const auto first = fields[0].text;
    if (first == "Channels" || first.starts_with("***") || first == "X_Value") {
      reading.further_segments = true;
      break;
    }
    read_row(reading, fields, columns);
    if (reading.text.problems.full()) break;
  }
  throw_problems(reading.text);
  columns.rows = 0;  // the last may hold a time alone
  for (const auto& values : columns.values) {
    columns.rows = std::max(columns.rows, values.size());
  }
  if (columns.rows < reading.samples) {
    reading.text.problems.add(
        reading.segment.find("Samples")->second.line, 1,
        fmt::format("the head says {} samples, but {} follow: the file is cut off",
                    reading.samples, columns.rows));
  } else if (!reading.text.lines.terminated() && columns.rows != reading.samples) {
    reading.text.problems.add(
        reading.text.lines.number(), 1,
        "the last line has no end, so that its last number may be cut off: end it, or "
        "leave it out");
  }
  throw_problems(reading.text);
}

}  // namespace

bool is_lvm(std::string_view head) {
  constexpr std::string_view byte_order = "\xEF\xBB\xBF";
  if (head.starts_with(byte_order)) head.remove_prefix(byte_order.size());
  return head.starts_with(first_words);
}

signal::Record read_lvm_record(std::istream& in, const std::string& name,
                               const RecordSource& source) {
  LvmReading reading{.text = TableText(in, name, lvm_kind)};
  reading.text.separator = '\t';
  read_heads(reading);
  LvmColumns columns = read_names(reading);
  read_rows(reading, columns);
  for (std::size_t i = 0; i < columns.values.size(); ++i) {
    columns.table.columns[i].count = columns.values[i].size();
  }
  if (reading.further_segments) {
    columns.table.notes.push_back(
        {"part_of_record",
         fmt::format("The file has several segments: the first one is read, {} "
                     "samples.",
                     columns.rows)});
  }
  columns.table.values = [&columns](std::size_t i) { return columns.values[i]; };
  return record_of(columns.table, name, source);
}

}  // namespace trochoid::files
