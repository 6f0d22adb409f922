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

/// What a column is called that a channel may read, in the order of ChannelAxis; names of
/// rotating dynamometers and sensory tool holders among them.
constexpr std::array<std::array<std::string_view, 4>, 11> names_by_axis = {{
    {"fx", "forcex"},
    {"fy", "forcey"},
    {"fz", "forcez"},
    {"fu", "fx'", "fxrot", "forceu"},
    {"fv", "fy'", "fyrot", "forcev"},
    {"torque", "mz", "mz'", "mt"},
    {"mx", "bendingmomentx", "bendingx"},
    {"my", "bendingmomenty", "bendingy"},
    {"mu", "mx'", "bendingmomentu", "bendingmomentx"},
    {"mv", "my'", "bendingmomentv", "bendingmomenty"},
    {"power", "p", "spindlepower", "pc"},
}};
constexpr std::array<std::string_view, 11> shown_by_axis = {
    "Fx", "Fy", "Fz", "Fu", "Fv", "torque", "Mx", "My", "Mu", "Mv", "power"};
/// As `simulate` writes them.
constexpr std::array channel_names = {"channel1"sv, "channel2"sv, "channel3"sv,
                                      "channel4"sv, "channel5"sv, "channel6"sv,
                                      "channel7"sv, "channel8"sv};

using force::ChannelAxis;

NameList names_of(ChannelAxis axis) {
  const auto& names = names_by_axis[static_cast<std::size_t>(axis)];
  const auto* const end = std::ranges::find(names, std::string_view());
  return {names.begin(), end};
}

std::string_view shown(ChannelAxis axis) {
  return shown_by_axis[static_cast<std::size_t>(axis)];
}

/// What the channels of a record read.
std::vector<ChannelAxis> axes_of(const RecordSource& source) {
  if (!source.axes.empty()) return source.axes;
  return {ChannelAxis::x, ChannelAxis::y, ChannelAxis::z};
}

Quantity quantity_of(ChannelAxis axis) {
  switch (force::unit_of(axis)) {
    case force::ChannelUnit::newton:
      return Quantity::force;
    case force::ChannelUnit::newton_metre:
      return Quantity::moment;
    case force::ChannelUnit::watt:
      break;
  }
  return Quantity::power;
}

constexpr std::size_t usual = 2;  // names of time: the rest is second choice

constexpr std::string_view advice = "say in the case file which one is meant";
constexpr std::string_view by_number =
    "; or name the columns by their numbers: columns = [\"2\", \"3\", \"4\"] and "
    "time_column = \"1\" in the case file";

bool is_known_name(std::string_view name) {
  const auto among = [&](NameList list) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  const auto among_axis = [&](const auto& names) {
    return !name.empty() && std::ranges::find(names, name) != names.end();
  };
  return among(time_names) || among(angle_names) || among(channel_names) ||
         std::ranges::any_of(names_by_axis, among_axis);
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
  if (source.scale.empty()) {
    return column_at(search, at, quantity_of(axes_of(source)[channel]));
  }
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

/// `Fx, Fy or Fz`
std::string any_of(const std::vector<ChannelAxis>& axes) {
  std::string text;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    text += i == 0 ? "" : i + 1 < axes.size() ? ", " : " or ";
    text += shown(axes[i]);
  }
  return text;
}

using Places = std::vector<std::optional<std::size_t>>;

/// Columns that one of three ways finds, the first that finds any.
Places places_of(const ColumnSearch& search, const std::vector<ChannelAxis>& axes) {
  const auto found_by = [&](const auto& find) {
    Places found;
    for (std::size_t i = 0; i < axes.size(); ++i) found.push_back(find(i));
    return found;
  };
  const auto any = [](const Places& found) {
    return std::ranges::any_of(found, [](const auto& one) { return one.has_value(); });
  };
  Places found =
      found_by([&](std::size_t i) { return usual_column(search, names_of(axes[i])); });
  if (!any(found)) {
    found = found_by([&](std::size_t i) {
      return usual_column(search, NameList(channel_names).subspan(i, 1));
    });
  }
  if (!any(found)) {
    found = found_by(
        [&](std::size_t i) { return foreign_column(search, names_of(axes[i])); });
  }
  return found;
}

Places usual_forces(const ColumnSearch& search, const std::vector<ChannelAxis>& axes) {
  if (lacks_names(search, "angle_deg,Fx_N,Fy_N,Fz_N")) {
    return Places(axes.size());
  }
  Places found = places_of(search, axes);
  if (std::ranges::none_of(found, [](const auto& one) { return one.has_value(); })) {
    search.problems.add(
        search.head.names_line, 1,
        fmt::format("no column is named {}: the columns are {}; columns = "
                    "[...] in [[measurement]] names the {}, time_column the time{}",
                    any_of(axes), all_names(search.head),
                    axes.size() == 3 ? "three forces" : "channels",
                    numbers_help(search)));
    return found;
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    // One that several columns could be has a problem of its own.
    if (found[i] || !search.problems.lines.empty()) continue;
    if (axes[i] > ChannelAxis::z ||
        begins_some_name(search, names_of(axes[i]).front())) {
      search.problems.add(
          search.head.names_line, 1,
          fmt::format(
              "no column is named {0}, for example {0}_{1}: the columns are {2}; "
              "columns = [...] in [[measurement]] names the {3}",
              shown(axes[i]), force::name_of(force::unit_of(axes[i])),
              all_names(search.head), axes.size() == 3 ? "three forces" : "channels"));
      continue;
    }
    search.notes.push_back(
        {"channel_missing",
         fmt::format(
             "no column is named {}, for example {}_N: the fit goes without "
             "channel {}. The columns are {}; columns = [...] in [[measurement]] "
             "names the forces, and \"\" one that was not measured.",
             shown(axes[i]), shown(axes[i]), i + 1, all_names(search.head))});
  }
  return found;
}

}  // namespace

bool names_force(std::string_view name) {
  const TableHead head{.names = {{name, 1}}, .paths = true};
  Problems problems;
  std::vector<base::Warning> notes;
  const ColumnSearch search{head, problems, notes, is_known_name, advice};
  for (std::size_t i = 0; i < 3; ++i) {
    if (usual_column(search, names_of(static_cast<ChannelAxis>(i))) ||
        usual_column(search, NameList(channel_names).subspan(i, 1))) {
      return true;
    }
  }
  return false;
}

RecordColumns find_columns(const TableHead& head, const RecordSource& source,
                           Problems& problems, std::vector<base::Warning>& notes) {
  const ColumnSearch search{head,   problems, notes,    is_known_name,
                            advice, 0.0,      by_number};
  RecordColumns columns;
  columns.count = head.names.size();
  const auto axes = axes_of(source);
  Places forces(axes.size());
  if (source.columns.empty()) {
    forces = usual_forces(search, axes);
  } else {
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (source.columns[i].empty()) continue;  // not measured
      forces[i] = named_column(search, source.columns[i]);
    }
  }
  columns.force.resize(std::max<std::size_t>(axes.size(), 3));
  for (std::size_t i = 0; i < axes.size(); ++i) {
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
  const auto as_it_stands = [&](const std::string& name) -> std::optional<TableColumn> {
    const auto at = name.empty() ? std::nullopt : named_column(search, name);
    if (!at) return std::nullopt;
    return TableColumn{*at, 1.0, std::string(head.names[*at].text)};
  };
  columns.line = as_it_stands(source.line_column);
  if (!source.pulse_column.empty()) {
    columns.pulse = as_it_stands(source.pulse_column);
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

void keep_channels(const RecordColumns& columns, signal::Record& record) {
  record.further.resize(columns.force.size() - 3);
  record.further_column.resize(record.further.size());
  for (std::size_t i = 0; i < columns.force.size(); ++i) {
    const auto& column = columns.force[i];
    if (i < 3) {
      record.measured[i] = column.has_value();
      if (column) record.channel_column[i] = column->name;
    } else if (column) {
      record.further_column[i - 3] = column->name;
    }
  }
}

}  // namespace trochoid::files
