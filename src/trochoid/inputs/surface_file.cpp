#include <fmt/core.h>
#include <trochoid/base/units.h>
#include <trochoid/inputs/csv_columns.h>
#include <trochoid/inputs/surface_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace trochoid::inputs {

namespace {

using namespace std::string_view_literals;

constexpr TableKind surface_kind{.noun = "a measured surface",
                                 .files = "a CSV file",
                                 .row = "reading",
                                 .example = "x_mm,height_mm,error_mm"};

constexpr std::array x_names = {"x"sv, "position"sv};
constexpr std::array step_names = {"step"sv, "k"sv};
constexpr std::array offset_names = {"feedoffset"sv};
constexpr std::array height_names = {"height"sv, "z"sv};
constexpr std::array error_names = {"error"sv, "deviation"sv};
constexpr std::array tooth_names = {"tooth"sv};
constexpr std::array<NameList, 6> all_lists = {x_names,      step_names,  offset_names,
                                               height_names, error_names, tooth_names};

/// More teeth than a case can have.
constexpr double most_teeth = 64;

bool is_known_name(std::string_view name) {
  return std::any_of(all_lists.begin(), all_lists.end(), [&](const NameList& list) {
    return std::find(list.begin(), list.end(), name) != list.end();
  });
}

struct SurfaceColumns {
  std::optional<TableColumn> x, step, feed_offset, height, error, tooth;
};

SurfaceColumns find_columns(const TableHead& head, Problems& problems) {
  std::vector<base::Warning> notes;  // lengths without a unit are refused: none come
  const ColumnSearch search{head, problems, notes, is_known_name,
                            "leave out, or rename, the one that is not meant"};
  SurfaceColumns columns;
  if (lacks_names(search, surface_kind.example)) {
    return columns;
  }
  const auto found = [&](NameList names, Quantity quantity) {
    const auto at = usual_column(search, names);
    return at ? std::optional(column_at(search, *at, quantity)) : std::nullopt;
  };
  columns.x = found(x_names, Quantity::length);
  columns.step = found(step_names, Quantity::number);
  columns.feed_offset = found(offset_names, Quantity::length);
  columns.height = found(height_names, Quantity::length);
  columns.error = found(error_names, Quantity::length);
  columns.tooth = found(tooth_names, Quantity::number);
  const auto lacks = [&](std::string_view wanted) {
    problems.add(head.names_line, 1,
                 fmt::format("no column is named {}: the columns are {}", wanted,
                             all_names(head)));
  };
  if (!columns.x && !columns.step) {
    lacks("x or position, for example x_mm, or step");
  }
  if (!columns.height) {
    lacks("height or z, for example height_mm");
  }
  if (!columns.error) {
    lacks("error or deviation, for example error_mm");
  }
  return columns;
}

int tooth_in_row(TableText& table, const std::vector<Field>& fields,
                 const TableColumn& column, int teeth) {
  const auto before = table.problems.lines.size();
  const double tooth = number_in_row(table, fields, column);
  if (table.problems.lines.size() > before) {
    return 0;
  }
  const double most = teeth > 0 ? teeth : most_teeth;
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

SurfaceReading reading_of(TableText& table, const std::vector<Field>& fields,
                          const SurfaceColumns& columns, int teeth) {
  SurfaceReading reading;
  const auto number = [&](const std::optional<TableColumn>& column) {
    return column ? std::optional(number_in_row(table, fields, *column)) : std::nullopt;
  };
  reading.x = number(columns.x);
  reading.step = number(columns.step);
  reading.feed_offset = number(columns.feed_offset);
  reading.height = number(columns.height).value_or(0.0);
  reading.error = number(columns.error).value_or(0.0);
  if (columns.tooth) {
    reading.tooth = tooth_in_row(table, fields, *columns.tooth, teeth);
  }
  reading.line = table.lines.number();
  return reading;
}

/// Two rows for one place: nobody can say which of them is right.
void check_twice(const std::vector<SurfaceReading>& readings, Problems& problems) {
  const auto place = [&](std::size_t i) {
    const auto& r = readings[i];
    return std::tuple(r.x, r.step, r.feed_offset, r.height, r.tooth);
  };
  std::vector<std::size_t> order(readings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  std::vector<std::pair<std::size_t, std::size_t>> twice;  // the later line first
  std::size_t first = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (place(order[i]) == place(order[first])) {
      twice.emplace_back(readings[order[i]].line, readings[order[first]].line);
    } else {
      first = i;
    }
  }
  std::sort(twice.begin(), twice.end());
  for (const auto& [later, earlier] : twice) {
    problems.add(later, 1,
                 fmt::format("the same place as in line {}: leave out one of the two, "
                             "or put a repeated measurement into a file of its own",
                             earlier));
  }
}

std::vector<SurfaceReading> read_rows(TableText& table, TableHead& head, int teeth) {
  std::vector<Field> fields;
  auto line = next_content(table);
  if (line) {
    split(*line, table.separator, fields);
    take_units(table, fields, head);
  }
  // The texts of the unit row end with the next line.
  const SurfaceColumns columns = find_columns(head, table.problems);
  throw_problems(table);
  if (!head.units.empty()) line = next_content(table);
  std::vector<SurfaceReading> readings;
  while (line && !table.problems.full()) {
    split(*line, table.separator, fields);
    if (complete_row(table, fields, head.names.size())) {
      readings.push_back(reading_of(table, fields, columns, teeth));
    }
    line = next_content(table);
  }
  return readings;
}

std::string mm(double length) {
  return fmt::format("{:.10g}", length / unit::mm);
}

}  // namespace

std::vector<SurfaceReading> read_surface(std::istream& in, const std::string& name,
                                         int teeth) {
  TableText table(in, name, surface_kind);
  const auto first = next_content(table);
  const std::string names = first ? names_row(table, *first) : std::string();
  if (names.empty() && table.problems.lines.empty()) {
    table.problems.add(
        1, 1,
        fmt::format("the file holds no data: a row of names, for example {}, and rows "
                    "of numbers are needed",
                    surface_kind.example));
  }
  throw_problems(table);
  TableHead head = head_of(table, names);
  if (head.names.size() == 1) {
    table.problems.add(head.names_line, 1,
                       "the row of names has 1 column: place, height and error are "
                       "needed, separated by , ; or a tab");
    throw_problems(table);
  }
  auto readings = read_rows(table, head, teeth);
  table.style.check(table.problems);
  throw_problems(table);
  if (readings.empty()) {
    table.problems.add(table.lines.number(), 1,
                       "no reading follows the row of names: "
                       "rows of numbers are needed");
  }
  check_twice(readings, table.problems);
  throw_problems(table);
  return readings;
}

std::vector<SurfaceReading> read_surface(const SurfaceMeasurement& measurement,
                                         int teeth) {
  auto in = open_table(measurement.file, measurement.location, surface_kind);
  return read_surface(in, measurement.file, teeth);
}

std::vector<std::string> check_readings(const std::vector<SurfaceReading>& readings,
                                        const std::string& file, const Case& given) {
  constexpr double slack = 1e-9;  // numbers in um and in mm differ in the last bit
  const double a_p = given.setup.cut.a_p;
  const auto& wall = given.machine.wall;
  const bool along_wall = wall && given.machine.surface.value_or(Surface{}).model !=
                                      surface::Model::quasi_static;
  const auto beyond = [&](double value, double most) {
    return value < -slack * most || value > most * (1 + slack);
  };
  Problems problems{file, {}};
  for (const SurfaceReading& reading : readings) {
    if (beyond(reading.height, a_p)) {
      problems.add(reading.line, 1,
                   fmt::format("the height of {} mm is outside the cut: must be from 0 "
                               "to axial_depth_mm = {} mm, above the tip of the cutter",
                               mm(reading.height), mm(a_p)));
    }
    if (along_wall && reading.x && beyond(*reading.x, wall->length)) {
      problems.add(reading.line, 1,
                   fmt::format("x = {} mm is outside the wall: must be from 0 to "
                               "length_mm = {} mm",
                               mm(*reading.x), mm(wall->length)));
    }
  }
  return problems.lines;
}

}  // namespace trochoid::inputs
