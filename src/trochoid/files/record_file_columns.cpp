#include <trochoid/files/csv_columns.h>
#include <trochoid/files/record_file_columns.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::files {

namespace {

using namespace std::string_view_literals;
constexpr std::array time_names = {"time"sv,
                                   "t"sv,
                                   "zeit"sv,
                                   "temps"sv,
                                   "tiempo"sv,
                                   "tempo"sv,
                                   "tijd"sv,
                                   "xaxis"sv,
                                   "xvalue"sv,
                                   "\xE6\x97\xB6\xE9\x97\xB4"sv,  // in Chinese
                                   "\xCA\xB1\xBC\xE4"sv};         // the same in GBK
constexpr std::array angle_names = {"angle"sv, "phi"sv, "spindleangle"sv};
constexpr std::array force_names = {
    std::array{"fx"sv, "forcex"sv, "channel1"sv},
    std::array{"fy"sv, "forcey"sv, "channel2"sv},
    std::array{"fz"sv, "forcez"sv, "channel3"sv},
};
constexpr std::size_t usual = 2;  // the rest of the names is second choice

constexpr std::string_view advice = "say in the case file which one is meant";
constexpr std::string_view by_number =
    "; or name the columns by their numbers: columns = [\"2\", \"3\", \"4\"] and "
    "time_column = \"1\" in the case file";

bool is_known_name(std::string_view name) {
  const auto among = [&](NameList list) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  return among(time_names) || among(angle_names) ||
         std::any_of(force_names.begin(), force_names.end(), among);
}

/// What helps with names that a case file cannot spell.
std::string_view numbers_help(const ColumnSearch& search) {
  const auto foreign = [](const Field& field) {
    return std::ranges::any_of(
        field.text, [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
  };
  return std::ranges::any_of(search.head.names, foreign)
             ? "; their numbers, from \"1\" on, name them, too"
             : "";
}

/// A column named in the case file: as written, else whatever the case of its letters,
/// else without the unit, else by its number, the first being 1.
std::optional<std::size_t> named_column(const ColumnSearch& search,
                                        const std::string& name) {
  const auto shown = excerpt(name);
  const auto exact = [&](std::string_view text) { return text == name; };
  const auto folded = [&](std::string_view text) { return plain(text) == plain(name); };
  const auto base = [&](std::string_view text) {
    return base_name(search, text) == plain(name);
  };
  if (const auto at = only_column(search, exact, shown)) return at;
  if (const auto at = only_column(search, folded, shown)) return at;
  if (const auto at = only_column(search, base, shown)) return at;
  const bool digits = !name.empty() && name.size() < 5 &&
                      name.find_first_not_of("0123456789") == std::string::npos;
  const std::size_t number = digits ? std::stoul(name) : 0;
  if (number >= 1 && number <= search.head.names.size()) return number - 1;
  search.problems.add(search.head.names_line, 1,
                      fmt::format("there is no column {}: the columns are {}{}", shown,
                                  all_names(search.head), numbers_help(search)));
  return std::nullopt;
}

std::optional<TableColumn> find_axis(const ColumnSearch& search,
                                     const std::string& given, NameList names,
                                     Quantity quantity) {
  if (!given.empty()) {
    const auto at = named_column(search, given);
    return at ? std::optional(column_at(search, *at, quantity)) : std::nullopt;
  }
  // Names of other tongues and programs are second choice.
  const std::size_t first = std::min(usual, names.size());
  auto at = usual_column(search, names.first(first));
  if (!at) at = usual_column(search, names.subspan(first));
  return at ? std::optional(column_at(search, *at, quantity)) : std::nullopt;
}

/// @param channel  from 0
TableColumn force_column(const ColumnSearch& search, const RecordSource& source,
                         std::size_t at, std::size_t channel) {
  if (source.scale.empty()) return column_at(search, at, Quantity::force);
  return {at, source.scale[channel], std::string(search.head.names[at].text)};
}

/// Whether a force may be there by another name, such as `Fz at 1`, `Fz1` or `run/Fz`.
bool begins_some_name(const ColumnSearch& search, std::string_view force) {
  return std::ranges::any_of(search.head.names, [&](const auto& name) {
    const std::string_view text = name.text;
    return plain(text.substr(text.rfind('/') + 1)).starts_with(force);
  });
}

/// A name without what is written before it in letters beyond ASCII, as `(cutting force)Fx`.
std::string_view ascii_end(std::string_view text) {
  const auto last = std::find_if(text.rbegin(), text.rend(), [](char c) {
    return static_cast<unsigned char>(c) >= 0x80;
  });
  return text.substr(static_cast<std::size_t>(text.rend() - last));
}

std::optional<std::size_t> foreign_column(const ColumnSearch& search, NameList names) {
  const auto passes = [&](std::string_view text) {
    const std::string end = base_name(search, ascii_end(text));
    return std::find(names.begin(), names.end(), end) != names.end();
  };
  return only_column(search, passes, excerpt(names.front()));
}

std::array<std::optional<std::size_t>, 3> usual_forces(const ColumnSearch& search) {
  std::array<std::optional<std::size_t>, 3> found;
  if (lacks_names(search, "angle_deg,Fx_N,Fy_N,Fz_N")) {
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
  if (!found[0] && !found[1] && !found[2]) {
    for (std::size_t i = 0; i < 3; ++i) {
      found[i] = foreign_column(search, NameList(force_names[i]).first(usual));
    }
  }
  constexpr std::array shown = {"Fx", "Fy", "Fz"};
  if (!found[0] && !found[1] && !found[2]) {
    search.problems.add(
        search.head.names_line, 1,
        fmt::format(
            "no column is named Fx, Fy or Fz: the columns are {}; columns = "
            "[...] in the case file names the three forces, time_column the time{}",
            all_names(search.head), numbers_help(search)));
    return found;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    // One that several columns could be has a problem of its own.
    if (found[i] || !search.problems.lines.empty()) continue;
    if (begins_some_name(search, force_names[i].front())) {
      search.problems.add(
          search.head.names_line, 1,
          fmt::format("no column is named {}, for example {}_N: the columns are {}; "
                      "columns = [...] in the case file names the three forces",
                      shown[i], shown[i], all_names(search.head)));
      continue;
    }
    search.notes.push_back(
        {"channel_missing",
         fmt::format("no column is named {}, for example {}_N: the fit goes without "
                     "channel {}. The columns are {}; columns = [...] in the case file "
                     "names the forces, and \"\" one that was not measured.",
                     shown[i], shown[i], i + 1, all_names(search.head))});
  }
  return found;
}

}  // namespace

bool names_force(std::string_view name) {
  const TableHead head{.names = {{name, 1}}, .paths = true};
  Problems problems;
  std::vector<base::Warning> notes;
  const ColumnSearch search{head, problems, notes, is_known_name, advice};
  return std::any_of(force_names.begin(), force_names.end(), [&](NameList names) {
    return usual_column(search, names).has_value();
  });
}

RecordColumns find_columns(const TableHead& head, const RecordSource& source,
                           Problems& problems, std::vector<base::Warning>& notes) {
  const ColumnSearch search{head,   problems, notes,    is_known_name,
                            advice, 0.0,      by_number};
  RecordColumns columns;
  columns.count = head.names.size();
  std::array<std::optional<std::size_t>, 3> forces;
  if (source.columns.empty()) {
    forces = usual_forces(search);
  } else {
    for (std::size_t i = 0; i < 3; ++i) {
      if (source.columns[i].empty()) continue;  // not measured
      forces[i] = named_column(search, source.columns[i]);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!forces[i]) continue;
    const auto before = std::span(forces).first(i);
    if (std::find(before.begin(), before.end(), forces[i]) != before.end()) {
      problems.add(head.names_line, head.names[*forces[i]].column,
                   "one column is to serve as two forces: "
                   "three different ones are needed");
      continue;
    }
    columns.force[i] = force_column(search, source, *forces[i], i);
  }
  columns.time = find_axis(search, source.time_column, time_names, Quantity::time);
  if (!source.pulse_column.empty()) {
    const auto at = named_column(search, source.pulse_column);
    if (at) columns.pulse = TableColumn{*at, 1.0, std::string(head.names[*at].text)};
    return columns;  // the angle follows from it
  }
  // Who names a time wants the angle from it, whatever else the file holds.
  const bool by_time = !source.time_column.empty() || source.sample_rate.has_value();
  if (!by_time || !source.angle_column.empty()) {
    columns.angle =
        find_axis(search, source.angle_column, angle_names, Quantity::angle);
  }
  return columns;
}

}  // namespace trochoid::files
