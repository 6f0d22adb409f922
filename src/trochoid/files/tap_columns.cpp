#include <trochoid/files/tap_columns.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

namespace trochoid::files {

namespace {

using namespace std::string_view_literals;

constexpr std::array tap_time_names = {"time"sv,  "t"sv,      "zeit"sv,
                                       "temps"sv, "tiempo"sv, "tempo"sv};
constexpr std::array hammer_names = {"force"sv,  "hammer"sv, "f"sv,      "fx"sv,
                                     "fy"sv,     "fz"sv,     "impact"sv, "kraft"sv,
                                     "fuerza"sv, "forza"sv};
constexpr std::array response_names = {"acceleration"sv,
                                       "accelerometer"sv,
                                       "acc"sv,
                                       "accel"sv,
                                       "a"sv,
                                       "velocity"sv,
                                       "vel"sv,
                                       "displacement"sv,
                                       "disp"sv,
                                       "response"sv,
                                       "beschleunigung"sv,
                                       "geschwindigkeit"sv,
                                       "auslenkung"sv,
                                       "weg"sv,
                                       "antwort"sv,
                                       "aceleracion"sv,
                                       "accelerazione"sv};
/// How far a time may be off its even grid, in steps: what few digits leave.
constexpr double slack = 0.6;
constexpr std::size_t least_samples = 64;
constexpr int time_record = 1;  ///< function type of a set 58

/// A name without what stands in brackets at its end, and that.
struct BracketedName {
  std::string_view name;
  std::string_view unit;  ///< empty: no brackets
};

BracketedName bracketed(std::string_view name) {
  name = trimmed(name);
  if (name.empty() || (name.back() != ')' && name.back() != ']')) return {name, {}};
  const bool round = name.back() == ')';
  int depth = 0;
  for (std::size_t i = name.size(); i-- > 0;) {
    if (name[i] == (round ? ')' : ']')) ++depth;
    if (name[i] == (round ? '(' : '[') && --depth == 0) {
      return {trimmed(name.substr(0, i)), name.substr(i + 1, name.size() - i - 2)};
    }
  }
  return {name, {}};
}

/// Whether a word of several letters is one of those.
bool is_word_of(std::string_view word, std::span<const std::string_view> words) {
  const std::string text = small_letters(word);
  return word.size() > 1 && std::ranges::find(words, text) != words.end();
}

/// @brief The unit of a channel that has one of the words in its name: `force_N`, `Force
/// (N)`, `Hammer force [N]`, `tip acc_g`.
/// @return none: it has none of them
std::optional<std::string> unit_in_name(std::string_view name,
                                        std::span<const std::string_view> words) {
  const BracketedName in = bracketed(name);
  std::optional<std::string> rest = unit_after(in.name, words);
  std::string_view left = in.name;
  while (!rest && !left.empty()) {
    const std::size_t end = std::min(left.find_first_of(" _-."), left.size());
    const std::string_view word = left.substr(0, end);
    left = left.substr(std::min(end + 1, left.size()));
    if (is_word_of(word, words)) rest = std::string(left);
  }
  if (!rest) return std::nullopt;
  if (!in.unit.empty()) return std::string(in.unit);
  // A second word says what it is once more: `hammer force`.
  const bool no_unit =
      is_word_of(*rest, hammer_names) || is_word_of(*rest, response_names);
  return no_unit ? std::string() : *rest;
}

std::string unit_of(const TapColumn& column, const std::string& rest) {
  std::string unit = column.unit.empty() ? rest : column.unit;
  std::erase_if(unit, [](char c) { return c == '[' || c == ']' || c == ' '; });
  constexpr std::string_view per = "_per_";  // as in a_m_per_s2
  for (std::size_t at = unit.find(per); at != std::string::npos; at = unit.find(per)) {
    unit.replace(at, per.size(), 1, '/');
  }
  const auto open = std::count(unit.begin(), unit.end(), '(');
  const auto shut = std::count(unit.begin(), unit.end(), ')');
  if (shut > open && unit.ends_with(')')) unit.pop_back();
  if (unit.starts_with('(') && unit.ends_with(')'))
    unit = unit.substr(1, unit.size() - 2);
  return unit;
}

/// Newtons per unit of a force channel.
double force_factor(const TapColumn& column, const std::string& unit, FrfFile& out,
                    Problems& problems) {
  if (unit.empty()) {
    out.notes.push_back(
        {"unit_assumed", "The force says no unit; newtons were assumed."});
    return 1.0;
  }
  for (const auto& [name, factor] : {std::pair{"N"sv, 1.0},
                                     {"kN"sv, 1e3},
                                     {"lbf"sv, 4.4482216152605},
                                     {"lb"sv, 4.4482216152605}}) {
    if (unit == name) return factor;
  }
  problems.add(column.line, column.at,
               fmt::format("the unit {} is no unit of a force: N, kN and lbf are; for "
                           "volts give kind and scale in [frf]",
                           excerpt(unit)));
  return 1.0;
}

/// Rate of a column of times, which must be evenly spaced.
double rate_of(const TapColumn& time, Problems& problems) {
  const std::vector<double>& t = time.values;
  const std::string unit =
      unit_of(time, unit_in_name(time.name, tap_time_names).value_or(""));
  const double factor = unit == "ms" ? 1e-3 : (unit == "us" ? 1e-6 : 1.0);
  if (factor == 1.0 && !unit.empty() && unit != "s") {
    problems.add(time.line, time.at,
                 fmt::format("the unit {} of the time: s is right", excerpt(unit)));
    return 0.0;
  }
  const double step =
      t.size() > 1 ? (t.back() - t.front()) / static_cast<double>(t.size() - 1) : 0.0;
  if (!(step > 0)) {
    problems.add(time.line, time.at, "the times do not increase");
    return 0.0;
  }
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (!(std::abs(t[i] - t.front() - step * static_cast<double>(i)) <= slack * step)) {
      problems.add(time.line + 1 + i, time.at,
                   fmt::format("the times are not evenly spaced: {:g} s is not where a "
                               "step of {:g} s leads",
                               factor * t[i], factor * step));
      return 0.0;
    }
  }
  return 1 / (factor * step);
}

/// The one of several responses that is meant; none: that is not said, or wrong.
const TapColumn* chosen(const std::vector<const TapColumn*>& responses, int dataset,
                        Problems& problems) {
  const auto wanted = static_cast<std::size_t>(std::max(dataset, 0));
  if (responses.size() == 1 && wanted <= 1) {
    return responses.front();
  }
  if (wanted >= 1 && wanted <= responses.size()) {
    return responses[wanted - 1];
  }
  std::string list;
  for (std::size_t i = 0; i < responses.size(); ++i) {
    list += fmt::format("; {}: {}", i + 1, excerpt(responses[i]->name));
  }
  problems.add(1, 1,
               responses.empty()
                   ? std::string("no column is a response: acceleration_m/s2, "
                                 "velocity_m/s or displacement_um, for example")
                   : fmt::format("the file has {} responses: choose one by --dataset, "
                                 "or dataset = in [frf]{}",
                                 responses.size(), list));
  return nullptr;
}

/// What of the columns is what.
struct Roles {
  const TapColumn* time = nullptr;
  const TapColumn* force = nullptr;
  std::vector<const TapColumn*> responses;
};

Roles roles_of(const std::vector<TapColumn>& columns, Problems& problems) {
  Roles roles;
  for (const TapColumn& column : columns) {
    if (unit_in_name(column.name, tap_time_names)) {
      roles.time = roles.time == nullptr ? &column : roles.time;
    } else if (unit_in_name(column.name, hammer_names)) {
      if (roles.force != nullptr) {
        problems.add(
            column.line, column.at,
            fmt::format("columns {} and {} could both be the force: leave out, "
                        "or rename, the one that is not the hammer's",
                        excerpt(roles.force->name), excerpt(column.name)));
      }
      roles.force = &column;
    } else if (unit_in_name(column.name, response_names)) {
      roles.responses.push_back(&column);
    }
  }
  return roles;
}

/// Newtons and SI units that stand for a unit of each column.
struct TapScale {
  double force = 1.0;
  double response = 1.0;
};

/// By what the user says, whatever units the columns name.
TapScale stated_scale(const TapColumn& response, const FrfSource& source, FrfFile& out,
                      Problems& problems) {
  if (!source.kind) {
    problems.add(response.line, response.at,
                 "scale says by how much, and nothing says of what: kind = "
                 "\"accelerance\", \"mobility\" or \"receptance\" is needed as well");
  }
  out.response.kind = source.kind.value_or(structure::ResponseKind::accelerance);
  return {source.scale[0], source.scale[1]};
}

/// Kind and factor of a response, from its unit or from what the user says.
double settle_response(const TapColumn& column, const FrfSource& source, FrfFile& out,
                       Problems& problems) {
  const std::string text =
      unit_of(column, unit_in_name(column.name, response_names).value_or(""));
  const auto unit = response_unit("(" + text + ")/N");
  if (unit && source.kind && *source.kind != unit->kind) {
    problems.add(column.line, column.at,
                 fmt::format("the unit {} does not fit the given kind: leave out the "
                             "kind, or correct one of the two",
                             excerpt(text)));
  }
  if (!unit && !(text.empty() && source.kind)) {
    problems.add(
        column.line, column.at,
        fmt::format("the response {} {}: acceleration_m/s2, acc_g, velocity_m/s "
                    "or displacement_um are right; for volts give kind and scale in "
                    "[frf]",
                    excerpt(column.name),
                    text.empty() ? "says no unit" : "has no unit of motion"));
  }
  if (!unit) {
    out.notes.push_back({"unit_assumed", "The response says no unit; SI was assumed."});
  }
  out.response.kind =
      unit ? unit->kind : source.kind.value_or(structure::ResponseKind::accelerance);
  return unit ? unit->factor : 1.0;
}

// five parameters: both columns with what the user says, and where it goes
TapScale scale_of_units(const Roles& roles, const TapColumn& response,
                        const FrfSource& source, FrfFile& out, Problems& problems) {
  const TapColumn& force = *roles.force;
  const std::string unit =
      unit_of(force, unit_in_name(force.name, hammer_names).value_or(""));
  return {.force = force_factor(force, unit, out, problems),
          .response = settle_response(response, source, out, problems)};
}

}  // namespace

bool is_tap(const std::vector<std::string>& names) {
  const auto any = [&](std::span<const std::string_view> words) {
    return std::any_of(names.begin(), names.end(), [&](const auto& name) {
      return unit_in_name(name, words).has_value();
    });
  };
  return any(tap_time_names) && any(hammer_names);
}

std::vector<TapColumn> tap_columns(const FrfTable& table) {
  std::vector<TapColumn> out;
  for (std::size_t k = 0; k < table.names.size(); ++k) {
    out.push_back({.name = table.names[k],
                   .line = table.names_line,
                   .at = table.name_columns[k]});
    for (const auto& row : table.rows) out.back().values.push_back(row[k]);
  }
  return out;
}

std::vector<TapColumn> tap_columns(const NumericTable& table) {
  std::vector<TapColumn> out;
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const NumericColumn& column = table.columns[k];
    const bool wanted = unit_in_name(column.name, tap_time_names) ||
                        unit_in_name(column.name, hammer_names) ||
                        unit_in_name(column.name, response_names);
    if (wanted && column.count >= least_samples) {
      out.push_back({.name = column.name,
                     .unit = column.unit,
                     .sample_rate = column.sample_rate,
                     .values = table.values(k)});
    }
  }
  return out;
}

std::vector<TapColumn> tap_columns(const UffFile& file) {
  std::vector<TapColumn> out;
  for (const Uff58& set : file.sets) {
    if (set.function_type != time_record || !set.even) continue;
    TapColumn column{
        .sample_rate = set.abscissa_increment > 0 ? 1 / set.abscissa_increment : 0.0,
        .line = set.line};
    const bool silent = set.ordinate.unit.empty() || set.ordinate.unit == "NONE";
    switch (set.ordinate.type) {
      case 8:
        column = {"displacement", silent ? "m" : set.ordinate.unit, column.sample_rate};
        break;
      case 9:
      case 13:
        column = {"force", silent ? "N" : set.ordinate.unit, column.sample_rate};
        break;
      case 11:
        column = {"velocity", silent ? "m/s" : set.ordinate.unit, column.sample_rate};
        break;
      case 12:
        column = {"acceleration", silent ? "m/s2" : set.ordinate.unit,
                  column.sample_rate};
        break;
      default:
        continue;
    }
    column.line = set.line;
    for (const auto& y : set.y) column.values.push_back(y.real());
    out.push_back(std::move(column));
  }
  return out;
}

FrfFile tap_file(std::vector<TapColumn> columns, const FrfSource& source,
                 Problems& problems) {
  FrfFile out;
  const Roles roles = roles_of(columns, problems);
  const TapColumn* response = chosen(roles.responses, source.dataset, problems);
  if (roles.force == nullptr) {
    problems.add(1, 1, "no column is the force of the hammer: force_N, for example");
  }
  if (roles.force == nullptr || response == nullptr) return out;
  const std::size_t n = roles.force->values.size();
  if (response->values.size() != n || n < least_samples) {
    problems.add(
        response->line, response->at,
        fmt::format("{} samples of the force and {} of the response: as many of "
                    "both, and at least {}, are right",
                    n, response->values.size(), least_samples));
    return out;
  }
  signal::TapRecord record;
  record.sample_rate =
      roles.time != nullptr ? rate_of(*roles.time, problems) : roles.force->sample_rate;
  if (roles.time == nullptr && !(record.sample_rate > 0)) {
    problems.add(1, 1,
                 "no column is the time (time_s), and no sampling rate is stated");
  }
  const TapScale scale = source.scale.size() == 2
                             ? stated_scale(*response, source, out, problems)
                             : scale_of_units(roles, *response, source, out, problems);
  for (std::size_t i = 0; i < n; ++i) {
    record.force.push_back(scale.force * roles.force->values[i]);
    record.response.push_back(scale.response * response->values[i]);
  }
  out.description = fmt::format("{} over {}, {} samples at {:g} Hz", response->name,
                                roles.force->name, n, record.sample_rate);
  out.tap = std::move(record);
  return out;
}

}  // namespace trochoid::files
