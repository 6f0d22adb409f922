#include <fmt/core.h>
#include <trochoid/base/units.h>
#include <trochoid/files/csv_columns.h>

#include <algorithm>
#include <array>

namespace trochoid::files {

namespace {

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
    Unit{"Newton", Quantity::force, 1.0},  // as measuring programs write it out
    Unit{"Newtons", Quantity::force, 1.0},
    Unit{"Nm", Quantity::moment, 1.0},
    Unit{"N.m", Quantity::moment, 1.0},
    Unit{"N-m", Quantity::moment, 1.0},
    Unit{"N*m", Quantity::moment, 1.0},
    Unit{"N m", Quantity::moment, 1.0},
    Unit{"N\xC2\xB7m", Quantity::moment, 1.0},
    Unit{"Ncm", Quantity::moment, 1e-2},
    Unit{"Nmm", Quantity::moment, 1e-3},
    Unit{"kNm", Quantity::moment, 1e3},
    Unit{"W", Quantity::power, 1.0},
    Unit{"kW", Quantity::power, 1e3},
    Unit{"s", Quantity::time, 1.0},
    Unit{"sec", Quantity::time, 1.0},
    Unit{"Seconds", Quantity::time, 1.0},
    Unit{"seconds", Quantity::time, 1.0},
    Unit{"second", Quantity::time, 1.0},
    Unit{"Second", Quantity::time, 1.0},
    Unit{"msec", Quantity::time, 1e-3},
    Unit{"usec", Quantity::time, 1e-6},
    Unit{"ms", Quantity::time, 1e-3},
    Unit{"us", Quantity::time, 1e-6},
    Unit{"\xC2\xB5s", Quantity::time, 1e-6},
    Unit{"\xCE\xBCs", Quantity::time, 1e-6},
    Unit{"\xB5s", Quantity::time, 1e-6},
    Unit{"deg", Quantity::angle, unit::deg},
    Unit{"\xC2\xB0", Quantity::angle, unit::deg},
    Unit{"\xB0", Quantity::angle, unit::deg},
    Unit{"rad", Quantity::angle, 1.0},
    Unit{"rev", Quantity::angle, unit::turn},
    Unit{"m", Quantity::length, 1.0},
    Unit{"mm", Quantity::length, unit::mm},
    Unit{"um", Quantity::length, unit::um},
    Unit{"\xC2\xB5m", Quantity::length, unit::um},
    Unit{"\xCE\xBCm", Quantity::length, unit::um},
    Unit{"\xB5m", Quantity::length, unit::um},
    Unit{"micron", Quantity::length, unit::um},
    Unit{"microns", Quantity::length, unit::um},
    Unit{"MM", Quantity::length, unit::mm},
    Unit{"cm", Quantity::length, 1e-2},
    Unit{"nm", Quantity::length, 1e-9},
    Unit{"in", Quantity::length, unit::inch},
    Unit{"IN", Quantity::length, unit::inch},
    Unit{"inch", Quantity::length, unit::inch},
    Unit{"inches", Quantity::length, unit::inch},
    Unit{"Inch", Quantity::length, unit::inch},
    Unit{"\"", Quantity::length, unit::inch},
    Unit{"\"\"", Quantity::length, unit::inch},  // as quoted fields have it
    Unit{"thou", Quantity::length, unit::thou},
    Unit{"mil", Quantity::length, unit::thou},
    Unit{"mils", Quantity::length, unit::thou},
    Unit{"uin", Quantity::length, 1e-6 * unit::inch},
    Unit{"V", Quantity::other, 0.0},
    Unit{"Volt", Quantity::other, 0.0},
    Unit{"Volts", Quantity::other, 0.0},
    Unit{"mV", Quantity::other, 0.0},
    Unit{"pC", Quantity::other, 0.0},
    Unit{"g", Quantity::other, 0.0},
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
    case Quantity::moment:
      return "Nm, Ncm, Nmm or kNm";
    case Quantity::power:
      return "W or kW";
    case Quantity::time:
      return "s, ms or us";
    case Quantity::length:
      return "mm, um, m, in or thou";
    default:
      return "deg, rad or rev";
  }
}

std::string_view noun(Quantity quantity) {
  switch (quantity) {
    case Quantity::force:
      return "force";
    case Quantity::moment:
      return "moment";
    case Quantity::power:
      return "power";
    case Quantity::time:
      return "time";
    case Quantity::length:
      return "length";
    default:
      return "angle";
  }
}

bool is_one_of(std::string_view text, NameList list) {
  return std::find(list.begin(), list.end(), text) != list.end();
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

Name split_name(std::string_view text, const ColumnSearch& search) {
  if (!text.empty() && (text.back() == ']' || text.back() == ')')) {
    const auto open = text.rfind(text.back() == ']' ? '[' : '(');
    // In a binary file `F(:,1)` is a column of a matrix.
    const bool index =
        search.head.paths && text.find(':', open) != std::string_view::npos;
    if (open != std::string_view::npos && !index) {
      return {without_blanks(text.substr(0, open)),
              without_brackets(text.substr(open))};
    }
  }
  if (const auto slash = text.rfind('/'); slash != std::string_view::npos) {
    const auto unit = without_blanks(text.substr(slash + 1));
    if (!search.head.paths || find_unit(unit) != nullptr) {
      return {without_blanks(text.substr(0, slash)), unit};
    }
  }
  const auto mark = text.rfind('_');
  if (mark != std::string_view::npos) {
    const auto unit = text.substr(mark + 1);
    if (find_unit(unit) != nullptr || search.known(plain(text.substr(0, mark)))) {
      return {text.substr(0, mark), unit};
    }
  }
  return {text, std::nullopt};
}

void report_unit(const ColumnSearch& search, std::size_t index, Quantity quantity,
                 std::string_view text) {
  const bool in_row =
      index < search.head.units.size() && !search.head.units[index].text.empty();
  const auto& field = in_row ? search.head.units[index] : search.head.names[index];
  const auto shown = excerpt(search.head.names[index].text);
  search.problems.add(
      in_row ? search.head.units_line : search.head.names_line, field.column,
      quantity == Quantity::number
          ? fmt::format("column {} has the unit {}: it is a plain number without one",
                        shown, excerpt(text))
          : fmt::format("the unit {} of column {} is not one of {}: {} is right{}",
                        excerpt(text), shown, noun(quantity), right_units(quantity),
                        quantity == Quantity::force
                            ? ", or scale = [...] in the case file says how many "
                              "newtons one unit is"
                            : ""));
}

/// Factor to SI from the unit in the name or in the row of units.
double unit_factor(const ColumnSearch& search, std::size_t index, Quantity quantity) {
  const auto name = search.head.names[index].text;
  auto unit = split_name(name, search).unit;
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
  if (quantity == Quantity::number) {
    if (unit) report_unit(search, index, quantity, *unit);
    return 1.0;
  }
  if (!unit && quantity == Quantity::length && search.length_unit > 0.0) {
    return search.length_unit;
  }
  if (!unit && (quantity == Quantity::angle || quantity == Quantity::length)) {
    const bool angle = quantity == Quantity::angle;
    search.problems.add(
        search.head.names_line, search.head.names[index].column,
        fmt::format("column {} says no unit: write it into the name, "
                    "for example {}",
                    excerpt(name), angle ? "angle_deg" : std::string(name) + "_mm"));
    return 1.0;
  }
  if (!unit) {
    search.notes.push_back(
        {"unit_assumed",
         fmt::format("Column {} says no unit; it was taken in {}.", excerpt(name),
                     quantity == Quantity::force    ? "N"
                     : quantity == Quantity::moment ? "Nm"
                     : quantity == Quantity::power  ? "W"
                                                    : "s")});
    return 1.0;
  }
  const Unit* known = find_unit(*unit);
  if (known == nullptr || known->quantity != quantity) {
    report_unit(search, index, quantity, *unit);
    return 1.0;
  }
  return known->factor;
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

bool is_unit(std::string_view text) {
  return find_unit(without_brackets(text)) != nullptr;
}

std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == ' ' || c == '_' || c == '-') continue;
    out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return out;
}

std::string all_names(const TableHead& head) {
  std::string text;
  for (std::size_t i = 0; i < head.names.size() && i < 12; ++i) {
    text += (i == 0 ? "" : ", ") + excerpt(head.names[i].text);
  }
  return head.names.size() > 12 ? text + ", ..." : text;
}

bool lacks_names(const ColumnSearch& search, std::string_view example) {
  const auto& names = search.head.names;
  if (!std::all_of(names.begin(), names.end(), [](const Field& field) {
        return parse_number(field.text).fault != NumberFault::not_a_number;
      })) {
    return false;
  }
  search.problems.add(search.head.names_line, 1,
                      fmt::format("the first row has numbers: a row of names, for "
                                  "example {}, must come before them{}",
                                  example, search.without_names));
  return true;
}

std::string base_name(const ColumnSearch& search, std::string_view text) {
  return plain(split_name(text, search).base);
}

std::optional<std::size_t> only_column(
    const ColumnSearch& search, const std::function<bool(std::string_view)>& passes,
    std::string_view wanted) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < search.head.names.size(); ++i) {
    if (!passes(search.head.names[i].text)) continue;
    if (found) {
      search.problems.add(search.head.names_line, search.head.names[i].column,
                          fmt::format("columns {} and {} could both be {}: {}",
                                      *found + 1, i + 1, wanted, search.advice));
      return found;
    }
    found = i;
  }
  return found;
}

std::optional<std::size_t> usual_column(const ColumnSearch& search, NameList names) {
  const auto passes = [&](std::string_view text) {
    return is_one_of(base_name(search, text), names);
  };
  return only_column(search, passes, excerpt(names.front()));
}

TableColumn column_at(const ColumnSearch& search, std::size_t index,
                      Quantity quantity) {
  return {index, unit_factor(search, index, quantity),
          std::string(search.head.names[index].text)};
}

}  // namespace trochoid::files
