#include <fmt/core.h>
#include <trochoid/base/units.h>
#include <trochoid/inputs/record_file_columns.h>

#include <algorithm>
#include <numbers>

namespace trochoid::inputs {

namespace {

enum class Quantity { force, time, angle, other };

struct Unit {
  std::string_view name;
  Quantity quantity;
  double factor;
};

/// Units that we convert, and common others, so that `F1_V` is not taken for newtons.
constexpr std::array units = {
    Unit{"N", Quantity::force, 1.0},
    Unit{"kN", Quantity::force, 1e3},
    Unit{"mN", Quantity::force, 1e-3},
    Unit{"daN", Quantity::force, 10.0},
    Unit{"lbf", Quantity::force, 4.4482216152605},
    Unit{"s", Quantity::time, 1.0},
    Unit{"sec", Quantity::time, 1.0},
    Unit{"ms", Quantity::time, 1e-3},
    Unit{"us", Quantity::time, 1e-6},
    Unit{"\xC2\xB5s", Quantity::time, 1e-6},
    Unit{"\xCE\xBCs", Quantity::time, 1e-6},
    Unit{"\xB5s", Quantity::time, 1e-6},
    Unit{"deg", Quantity::angle, unit::deg},
    Unit{"\xC2\xB0", Quantity::angle, unit::deg},
    Unit{"\xB0", Quantity::angle, unit::deg},
    Unit{"rad", Quantity::angle, 1.0},
    Unit{"rev", Quantity::angle, 2.0 * std::numbers::pi},
    Unit{"V", Quantity::other, 0.0},
    Unit{"mV", Quantity::other, 0.0},
    Unit{"pC", Quantity::other, 0.0},
    Unit{"g", Quantity::other, 0.0},
    Unit{"Nm", Quantity::other, 0.0},
    Unit{"mm", Quantity::other, 0.0},
    Unit{"um", Quantity::other, 0.0},
    Unit{"Hz", Quantity::other, 0.0},
    Unit{"min", Quantity::other, 0.0},
    Unit{"lb", Quantity::other, 0.0},
    Unit{"kgf", Quantity::other, 0.0},
};

const Unit* find_unit(std::string_view name) {
  const auto* const at = std::find_if(units.begin(), units.end(),
                                      [&](const Unit& u) { return u.name == name; });
  return at == units.end() ? nullptr : at;
}

std::string_view right_units(Quantity quantity) {
  switch (quantity) {
    case Quantity::force:
      return "N, kN, mN, daN or lbf";
    case Quantity::time:
      return "s, ms or us";
    default:
      return "deg, rad or rev";
  }
}

std::string_view noun(Quantity quantity) {
  switch (quantity) {
    case Quantity::force:
      return "force";
    case Quantity::time:
      return "time";
    default:
      return "angle";
  }
}

std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == ' ' || c == '_' || c == '-') continue;
    out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return out;
}

using NameList = std::span<const std::string_view>;

bool is_one_of(std::string_view text, NameList list) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

using namespace std::string_view_literals;
constexpr std::array time_names = {"time"sv, "t"sv};
constexpr std::array angle_names = {"angle"sv, "phi"sv, "spindleangle"sv};
constexpr std::array force_names = {
    std::array{"fx"sv, "forcex"sv, "channel1"sv},
    std::array{"fy"sv, "forcey"sv, "channel2"sv},
    std::array{"fz"sv, "forcez"sv, "channel3"sv},
};
constexpr std::size_t usual = 2;  // the rest of force_names is second choice

bool is_known_name(std::string_view text) {
  const auto name = plain(text);
  return is_one_of(name, time_names) || is_one_of(name, angle_names) ||
         std::any_of(force_names.begin(), force_names.end(),
                     [&](const auto& list) { return is_one_of(name, list); });
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::string_view without_brackets(std::string_view text) {
  if (text.size() >= 2 && ((text.front() == '[' && text.back() == ']') ||
                           (text.front() == '(' && text.back() == ')'))) {
    text = text.substr(1, text.size() - 2);
  }
  return without_blanks(text);
}

struct Name {
  std::string_view base;
  std::optional<std::string_view> unit;
};

Name split_name(std::string_view text) {
  if (!text.empty() && (text.back() == ']' || text.back() == ')')) {
    const auto open = text.rfind(text.back() == ']' ? '[' : '(');
    if (open != std::string_view::npos) {
      return {without_blanks(text.substr(0, open)),
              without_brackets(text.substr(open))};
    }
  }
  if (const auto slash = text.rfind('/'); slash != std::string_view::npos) {
    return {without_blanks(text.substr(0, slash)),
            without_blanks(text.substr(slash + 1))};
  }
  const auto mark = text.rfind('_');
  if (mark != std::string_view::npos) {
    const auto unit = text.substr(mark + 1);
    if (find_unit(unit) != nullptr || is_known_name(text.substr(0, mark))) {
      return {text.substr(0, mark), unit};
    }
  }
  return {text, std::nullopt};
}

/// One search through a head.
struct Search {
  const RecordHead& head;
  Problems& problems;
  std::vector<base::Warning>& notes;
};

std::string all_names(const RecordHead& head) {
  std::string text;
  for (std::size_t i = 0; i < head.names.size() && i < 12; ++i) {
    text += (i == 0 ? "" : ", ") + excerpt(head.names[i].text);
  }
  return head.names.size() > 12 ? text + ", ..." : text;
}

/// Index of the only column that passes; problems name several, and none if needed.
template <class Passes>
std::optional<std::size_t> only_column(const Search& search, Passes passes,
                                       std::string_view wanted) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < search.head.names.size(); ++i) {
    if (!passes(search.head.names[i].text)) continue;
    if (found) {
      search.problems.add(
          search.head.names_line, search.head.names[i].column,
          fmt::format("columns {} and {} could both be {}: say in the case file which "
                      "one is meant",
                      *found + 1, i + 1, wanted));
      return found;
    }
    found = i;
  }
  return found;
}

/// A column named in the case file: as written, else whatever the case of its letters,
/// else without the unit.
std::optional<std::size_t> named_column(const Search& search, const std::string& name) {
  const auto shown = excerpt(name);
  const auto exact = [&](std::string_view text) { return text == name; };
  const auto folded = [&](std::string_view text) { return plain(text) == plain(name); };
  const auto base = [&](std::string_view text) {
    return plain(split_name(text).base) == plain(name);
  };
  if (const auto at = only_column(search, exact, shown)) return at;
  if (const auto at = only_column(search, folded, shown)) return at;
  if (const auto at = only_column(search, base, shown)) return at;
  search.problems.add(search.head.names_line, 1,
                      fmt::format("there is no column {}: the columns are {}", shown,
                                  all_names(search.head)));
  return std::nullopt;
}

std::optional<std::size_t> usual_column(const Search& search, NameList names) {
  const auto passes = [&](std::string_view text) {
    return is_one_of(plain(split_name(text).base), names);
  };
  return only_column(search, passes, excerpt(names.front()));
}

void report_unit(const Search& search, std::size_t index, Quantity quantity,
                 std::string_view text) {
  const bool in_row =
      index < search.head.units.size() && !search.head.units[index].text.empty();
  const auto& field = in_row ? search.head.units[index] : search.head.names[index];
  search.problems.add(
      in_row ? search.head.units_line : search.head.names_line, field.column,
      fmt::format("the unit {} of column {} is not one of {}: {} is right",
                  excerpt(text), excerpt(search.head.names[index].text), noun(quantity),
                  right_units(quantity)));
}

/// Factor to SI from the unit in the name or in the row of units.
double unit_factor(const Search& search, std::size_t index, Quantity quantity) {
  const auto name = search.head.names[index].text;
  auto unit = split_name(name).unit;
  if (index < search.head.units.size()) {
    const auto below = without_brackets(search.head.units[index].text);
    if (unit && !below.empty() && *unit != below) {
      search.problems.add(search.head.units_line, search.head.units[index].column,
                          fmt::format("column {} has the unit {} in its name and {} "
                                      "below: they must agree",
                                      excerpt(name), excerpt(*unit), excerpt(below)));
      return 1.0;
    }
    if (!below.empty()) unit = below;
  }
  if (!unit && quantity == Quantity::angle) {
    search.problems.add(search.head.names_line, search.head.names[index].column,
                        fmt::format("column {} says no unit: write it into the name, "
                                    "for example angle_deg",
                                    excerpt(name)));
    return 1.0;
  }
  if (!unit) {
    search.notes.push_back(
        {"unit_assumed",
         fmt::format("Column {} says no unit; it was taken in {}.", excerpt(name),
                     quantity == Quantity::force ? "N" : "s")});
    return 1.0;
  }
  const Unit* known = find_unit(*unit);
  if (known == nullptr || known->quantity != quantity) {
    report_unit(search, index, quantity, *unit);
    return 1.0;
  }
  return known->factor;
}

RecordColumn column_at(const Search& search, std::size_t index, Quantity quantity) {
  return {index, unit_factor(search, index, quantity),
          std::string(search.head.names[index].text)};
}

std::optional<RecordColumn> find_axis(const Search& search, const std::string& given,
                                      NameList names, Quantity quantity) {
  const auto at =
      given.empty() ? usual_column(search, names) : named_column(search, given);
  if (!at) return std::nullopt;
  return column_at(search, *at, quantity);
}

std::array<std::optional<std::size_t>, 3> usual_forces(const Search& search) {
  std::array<std::optional<std::size_t>, 3> found;
  const auto& names = search.head.names;
  if (std::all_of(names.begin(), names.end(), [](const Field& field) {
        return parse_number(field.text).fault != NumberFault::not_a_number;
      })) {
    search.problems.add(search.head.names_line, 1,
                        "the first row holds numbers: a row of names, for example "
                        "angle_deg,Fx_N,Fy_N,Fz_N, must come before them");
    return found;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    found[i] = usual_column(search, NameList(force_names[i]).first(usual));
  }
  if (!found[0] && !found[1] && !found[2]) {
    for (std::size_t i = 0; i < 3; ++i) {
      found[i] = usual_column(search, NameList(force_names[i]).subspan(usual));
    }
  }
  constexpr std::array shown = {"Fx", "Fy", "Fz"};
  for (std::size_t i = 0; i < 3; ++i) {
    if (found[i]) continue;
    search.problems.add(
        search.head.names_line, 1,
        fmt::format("no column is named {}, for example {}_N: the columns are {}; "
                    "columns = [...] in the case file names the three forces",
                    shown[i], shown[i], all_names(search.head)));
  }
  return found;
}

}  // namespace

bool is_unit_row(std::span<const Field> row) {
  bool any = false;
  for (const auto& field : row) {
    if (field.text.empty()) continue;
    any = true;
    if (parse_number(field.text).fault != NumberFault::not_a_number) return false;
    const char c = field.text.front();
    if ((c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.') return false;
  }
  return any;
}

RecordColumns find_columns(const RecordHead& head, const Measurement& measurement,
                           Problems& problems, std::vector<base::Warning>& notes) {
  const Search search{head, problems, notes};
  RecordColumns columns;
  columns.count = head.names.size();
  std::array<std::optional<std::size_t>, 3> forces;
  if (measurement.columns.empty()) {
    forces = usual_forces(search);
  } else {
    for (std::size_t i = 0; i < 3; ++i) {
      forces[i] = named_column(search, measurement.columns[i]);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!forces[i]) continue;
    const auto before = std::span(forces).first(i);
    if (std::find(before.begin(), before.end(), forces[i]) != before.end()) {
      problems.add(head.names_line, head.names[*forces[i]].column,
                   "one column is to serve as two forces: three different ones are "
                   "needed");
      continue;
    }
    columns.force[i] = column_at(search, *forces[i], Quantity::force);
  }
  columns.time = find_axis(search, measurement.time_column, time_names, Quantity::time);
  // Who names a time wants the angle from it, whatever else the file holds.
  const bool by_time =
      !measurement.time_column.empty() || measurement.sample_rate.has_value();
  if (!by_time || !measurement.angle_column.empty()) {
    columns.angle =
        find_axis(search, measurement.angle_column, angle_names, Quantity::angle);
  }
  return columns;
}

}  // namespace trochoid::inputs
