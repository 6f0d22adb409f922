#include <trochoid/files/numeric_table.h>

#include <trochoid/base/error.h>
#include <trochoid/files/channel_starts.h>
#include <trochoid/files/record_file_columns.h>
#include <trochoid/files/record_file_pulse.h>
#include <trochoid/files/record_file_time.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace trochoid::files {

namespace {

/// Sampling rates that are possible [Hz].
constexpr double lowest_stated = 1e-3;
constexpr double highest_stated = 1e9;

/// What each column is found by: its name, or its path where others have that name.
std::vector<std::string> searched_names(const NumericTable& table) {
  std::map<std::string, int> uses;
  for (const auto& column : table.columns) ++uses[column.name];
  std::vector<std::string> names;
  names.reserve(table.columns.size());
  for (const auto& column : table.columns) {
    const bool by_path = uses[column.name] > 1 && !column.path.empty();
    names.push_back(by_path ? column.path : column.name);
  }
  return names;
}

/// The case file may name a column by its path, too.
RecordSource by_searched_names(const NumericTable& table,
                               const std::vector<std::string>& names,
                               const RecordSource& source) {
  RecordSource wanted = source;
  const auto replace = [&](std::string& text) {
    for (std::size_t i = 0; i < names.size() && !text.empty(); ++i) {
      if (text != table.columns[i].path) continue;
      text = names[i];
      return;
    }
  };
  for (auto& text : wanted.columns) replace(text);
  replace(wanted.time_column);
  replace(wanted.angle_column);
  replace(wanted.pulse_column);
  replace(wanted.line_column);
  return wanted;
}

struct Used {
  std::vector<TableColumn> columns;  ///< all that a record takes

  /// The first force, whose length and times are those of the record.
  [[nodiscard]] const TableColumn& first() const { return columns.front(); }
};

Used used_of(const RecordColumns& found) {
  Used used;
  for (const auto& force : found.force) {
    if (force) used.columns.push_back(*force);
  }
  if (found.time) used.columns.push_back(*found.time);
  if (found.angle) used.columns.push_back(*found.angle);
  if (found.pulse) used.columns.push_back(*found.pulse);
  if (found.line) used.columns.push_back(*found.line);
  return used;
}

void check_lengths(const NumericTable& table, const Used& used, Problems& problems) {
  const auto& first = used.first();
  const std::size_t count = table.columns[first.index].count;
  for (const auto& column : used.columns) {
    const std::size_t other = table.columns[column.index].count;
    if (other == count) continue;
    problems.add(
        0, 0,
        fmt::format(
            "column {} has {} samples, {} has {}: they must be sampled together",
            excerpt(column.name), other, excerpt(first.name), count));
  }
  if (count < 2) {
    problems.add(0, 0,
                 fmt::format("the record has {} sample{}: at least 2 are needed, "
                             "and a whole revolution to find anything",
                             count, count == 1 ? "" : "s"));
  }
  const auto bytes = static_cast<double>(count) * sizeof(double) *
                     static_cast<double>(used.columns.size());
  if (bytes > largest_record) {
    problems.add(0, 0,
                 fmt::format("the record has {} samples: at most {:.2g} bytes of them "
                             "are read; save a part of it",
                             count, largest_record));
  }
}

/// Rate and begin of the samples, on which all columns must agree.
SampleRates rates_of(const NumericTable& table, const Used& used,
                     const RecordSource& source, Problems& problems) {
  SampleRates rates{.given = source.sample_rate.value_or(0.0)};
  const auto& first = table.columns[used.first().index];
  if (!source.time_column.empty()) return rates;
  if (!std::isfinite(first.first_time) || !std::isfinite(first.sample_rate) ||
      (first.sample_rate != 0.0 &&
       !(first.sample_rate >= lowest_stated && first.sample_rate <= highest_stated))) {
    problems.add(
        0, 0,
        fmt::format("column {} begins at {} s and has {} samples a second: a "
                    "number from 0.001 to 1e9 is needed",
                    excerpt(used.first().name), first.first_time, first.sample_rate));
    return rates;
  }
  rates.stated = first.sample_rate;
  rates.first_time = first.first_time;
  for (const auto& column : used.columns) {
    const double other = table.columns[column.index].sample_rate;
    const double slack = 1e-6 * std::max(other, first.sample_rate);
    if (other == 0.0 || first.sample_rate == 0.0 ||
        std::abs(other - first.sample_rate) <= slack) {
      continue;
    }
    problems.add(
        0, 0,
        fmt::format("column {} has {:.9g} samples a second, {} has {:.9g}: they "
                    "must be sampled together",
                    excerpt(column.name), other, excerpt(used.first().name),
                    first.sample_rate));
  }
  return rates;
}

std::vector<double> values_in_si(const NumericTable& table, const TableColumn& column,
                                 Problems& problems) {
  auto values = table.values(column.index);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] *= column.factor;
    if (std::isfinite(values[i])) continue;
    problems.add(
        0, 0,
        fmt::format("column {}: sample {} is not a finite number: leave out or "
                    "repair the sample",
                    excerpt(column.name), i + 1));
    break;
  }
  return values;
}

void throw_if_any(const Problems& problems) {
  if (!problems.lines.empty()) throw base::InputError(problems.lines);
}

void read_columns(const NumericTable& table, const RecordColumns& found,
                  signal::Record& record, Problems& problems) {
  keep_channels(found, record);
  for (std::size_t i = 0; i < found.force.size(); ++i) {
    if (!found.force[i]) continue;
    record.values_of(i) = values_in_si(table, *found.force[i], problems);
  }
  const auto count = std::max(
      {record.channel[0].size(), record.channel[1].size(), record.channel[2].size()});
  for (auto& values : record.channel) {
    if (values.empty()) values.assign(count, 0.0);
  }
  if (found.angle) {
    record.angle = values_in_si(table, *found.angle, problems);
    record.angle_column = found.angle->name;
  }
  if (found.time) {
    record.time = values_in_si(table, *found.time, problems);
    record.time_column = found.time->name;
  }
  if (found.line) record.line = values_in_si(table, *found.line, problems);
}

/// What is read of a record.
struct Columns {
  signal::Record& record;
  std::vector<double> pulse = {};
};

/// What one column of a record is read into.
std::vector<double>* values_of(const TableColumn& column, const RecordColumns& found,
                               Columns& read) {
  const auto is = [&](const std::optional<TableColumn>& other) {
    return other && other->index == column.index;
  };
  for (std::size_t c = 0; c < found.force.size(); ++c) {
    if (is(found.force[c])) return &read.record.values_of(c);
  }
  if (is(found.angle)) return &read.record.angle;
  if (is(found.line)) return &read.record.line;
  return is(found.pulse) ? &read.pulse : nullptr;
}

/// Bring columns that start at different times together; the times of a column of times
/// are those of all.
void align(const NumericTable& table, const RecordColumns& found, Columns& read,
           SampleRates& rates, Problems& problems) {
  const double rate = rates.given > 0.0 ? rates.given : rates.stated;
  if (found.time || !(rate > 0.0)) return;
  std::vector<StartedColumn> started;
  for (const TableColumn& column : used_of(found).columns) {
    // A column that says no rate says no start either.
    const NumericColumn& own = table.columns[column.index];
    const double start = own.sample_rate > 0.0 ? own.first_time : rates.first_time;
    if (!std::isfinite(start)) {
      problems.add(0, 0,
                   fmt::format("column {} begins at {} s: a number is needed",
                               excerpt(column.name), start));
      return;
    }
    started.push_back({column.name, start, values_of(column, found, read)});
  }
  const Starts starts = align_starts(started, rate);
  if (!starts.problem.empty()) {
    problems.add(0, 0, starts.problem);
    return;
  }
  rates.first_time = starts.first;
  if (starts.note.empty()) return;
  read.record.notes.push_back({"channels_aligned", starts.note});
  const std::size_t count = started.front().values->size();
  for (std::size_t c = 0; c < 3; ++c) {
    if (!read.record.measured[c]) read.record.channel[c].assign(count, 0.0);
  }
}

}  // namespace

void refuse(const std::string& name, const std::string& why) {
  throw base::InputError({name + ": " + why});
}

signal::Record record_of(const NumericTable& table, const std::string& name,
                         const RecordSource& source) {
  if (table.columns.empty()) refuse(name, "the file has no column of numbers");
  const auto names = searched_names(table);
  TableHead head{.paths = true};
  for (std::size_t i = 0; i < names.size(); ++i) {
    head.names.push_back({names[i], i + 1});
    head.units.push_back({table.columns[i].unit, i + 1});
  }
  signal::Record record;
  record.file = name;
  record.notes = table.notes;
  Problems problems{name, {}};
  const auto found = find_columns(head, by_searched_names(table, names, source),
                                  problems, record.notes);
  throw_if_any(problems);
  const auto used = used_of(found);
  check_lengths(table, used, problems);
  auto rates = rates_of(table, used, source, problems);
  throw_if_any(problems);
  read_columns(table, found, record, problems);
  Columns read{record};
  if (found.pulse) read.pulse = values_in_si(table, *found.pulse, problems);
  throw_if_any(problems);
  align(table, found, read, rates, problems);
  throw_if_any(problems);
  settle_time(record, {.values = record.time, .lines = {}}, rates, problems);
  throw_if_any(problems);
  if (found.pulse) {
    take_pulses(record, found.pulse->name, read.pulse, problems);
    throw_if_any(problems);
  }
  return record;
}

}  // namespace trochoid::files
