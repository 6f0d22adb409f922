#include <trochoid/files/uff58_record.h>

#include <trochoid/files/csv.h>
#include <trochoid/files/number_run.h>
#include <trochoid/files/numeric_table.h>
#include <trochoid/files/uff58.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace trochoid::files {

namespace {

constexpr int time_response = 1;
/// Kinds of ordinates.
constexpr int unknown = 0;
constexpr int general = 1;
constexpr int reaction_force = 9;
constexpr int excitation_force = 13;

/// The degree of freedom that a set was measured at.
struct Freedom {
  int node = 0;
  int direction = 0;  ///< 1, 2, 3: x, y, z; negative: against it; else none of them
};

Freedom freedom_of(const Uff58& set) {
  const bool response = set.response_direction != 0;
  return {response ? set.response_node : set.reference_node,
          response ? set.response_direction : set.reference_direction};
}

bool may_be_force(const Uff58& set) {
  const int kind = set.ordinate.type;
  const int axis = std::abs(freedom_of(set).direction);
  return (kind == excitation_force || kind == reaction_force || kind == unknown ||
          kind == general) &&
         axis >= 1 && axis <= 3;
}

/// `Fx` for a force along x; of anything else its label.
NumericColumn column_of(const Uff58& set, std::size_t number) {
  constexpr std::array names = {"Fx", "Fy", "Fz"};
  const auto [node, direction] = freedom_of(set);
  const auto axis = static_cast<std::size_t>(std::abs(direction));
  NumericColumn column{
      .unit = set.ordinate.unit == "NONE" ? std::string() : set.ordinate.unit,
      .count = set.y.size()};
  if (may_be_force(set)) {
    column.name = names[axis - 1];
    column.path = fmt::format("{} at {}", column.name, node);
  } else {
    column.name = set.ordinate.label.empty() || set.ordinate.label == "NONE"
                      ? fmt::format("set {}", number)
                      : set.ordinate.label;
    column.path = fmt::format("{} of set {}", column.name, number);
  }
  if (set.even) {
    column.sample_rate =
        set.abscissa_increment > 0.0 ? 1.0 / set.abscissa_increment : 0.0;
    column.first_time = set.abscissa_min;
  }
  return column;
}

void check_set(const Uff58& set, const std::string& name) {
  if (set.y.size() >= set.promised) return;
  refuse(name,
         fmt::format("the data set in line {} is to have {} points and has {}: the "
                     "file is cut off",
                     set.line, set.promised, set.y.size()));
}

/// Time histories of real numbers; that there are none is a problem.
std::vector<Uff58> histories_of(UffFile file, const std::string& name) {
  std::string others;
  for (const auto& set : file.sets) {
    if (set.function_type != time_response) {
      others += fmt::format(" {}", set.function_type);
    }
  }
  std::erase_if(file.sets, [](const Uff58& set) {
    return set.function_type != time_response || set.complex_valued();
  });
  if (file.sets.empty()) {
    refuse(name,
           fmt::format("the universal file has no time history (data set 58, "
                       "function type 1, real numbers){}{}",
                       others.empty() ? "" : "; its functions are of type", others));
  }
  for (const auto& set : file.sets) check_set(set, name);
  return std::move(file.sets);
}

/// Times of the first force, where they are not even; those of the others must be these.
void add_times(const std::vector<Uff58>& sets, const std::string& name,
               NumericTable& table) {
  const auto uneven = [](const Uff58& set) { return !set.even && may_be_force(set); };
  const auto first = std::find_if(sets.begin(), sets.end(), uneven);
  if (first == sets.end()) return;
  for (const auto& set : sets) {
    if (uneven(set) && set.x != first->x) {
      refuse(name, fmt::format("the data sets in lines {} and {} have different times: "
                               "they must be sampled together",
                               first->line, set.line));
    }
  }
  table.columns.push_back(
      {.name = "time", .path = {}, .unit = "s", .count = first->x.size()});
}

void note_directions(const std::vector<Uff58>& sets, NumericTable& table) {
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (!may_be_force(sets[i]) || freedom_of(sets[i]).direction > 0) continue;
    table.notes.push_back(
        {"sign_turned", fmt::format("The direction of {} is against its axis; its sign "
                                    "was turned.",
                                    excerpt(table.columns[i].path))});
  }
}

}  // namespace

signal::Record read_uff58_record(std::istream& in, const std::string& name,
                                 const RecordSource& source) {
  const std::uint64_t bytes = size_of(in);
  if (static_cast<double>(bytes) > largest_record) {
    refuse(name, fmt::format("the file has {} bytes: at most {:.2g} are read", bytes,
                             largest_record));
  }
  const auto text = bytes_at(in, 0, bytes);
  const auto sets = histories_of(
      read_uff(text ? std::string_view(*text) : std::string_view(), name), name);
  NumericTable table;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    table.columns.push_back(column_of(sets[i], i + 1));
  }
  note_directions(sets, table);
  add_times(sets, name, table);
  table.values = [&](std::size_t i) {
    if (i == sets.size()) {
      return std::find_if(sets.begin(), sets.end(),
                          [](const Uff58& s) { return !s.even && may_be_force(s); })
          ->x;
    }
    const Uff58& set = sets[i];
    const bool turned = may_be_force(set) && freedom_of(set).direction < 0;
    std::vector<double> values;
    values.reserve(set.y.size());
    for (const auto& y : set.y) values.push_back(turned ? -y.real() : y.real());
    return values;
  };
  return record_of(table, name, source);
}

}  // namespace trochoid::files
