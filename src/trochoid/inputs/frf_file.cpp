#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/inputs/csv_table.h>
#include <trochoid/inputs/frf_file.h>
#include <trochoid/inputs/frf_table.h>
#include <trochoid/inputs/mat.h>
#include <trochoid/inputs/tap_columns.h>
#include <trochoid/inputs/tdms.h>
#include <trochoid/inputs/uff58.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <sstream>

namespace trochoid::inputs {

namespace {

using namespace std::string_view_literals;
using structure::ResponseKind;

constexpr int frequency_response = 4;  ///< function type of a set 58

constexpr TableKind frf_kind{.noun = "a frequency response",
                             .files = "a universal file (UFF58) or a table",
                             .row = "line",
                             .example = "freq_Hz,re_m/N,im_m/N"};

/// One column of a table, by what its name begins with.
struct Found {
  std::size_t index = 0;
  std::string unit;  ///< the rest of the name
};

char small(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// The column whose name is one of these, alone or before a unit.
std::optional<Found> column(const FrfTable& table,
                            std::span<const std::string_view> names,
                            Problems& problems) {
  std::optional<Found> found;
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    std::string text = table.names[i];
    std::transform(text.begin(), text.end(), text.begin(), small);
    for (const std::string_view name : names) {
      if (text.substr(0, name.size()) != name) continue;
      const bool ends = text.size() == name.size() ||
                        " _[(/"sv.find(text[name.size()]) != std::string_view::npos;
      if (!ends) continue;
      if (found) {
        problems.add(table.names_line, table.name_columns[i],
                     fmt::format("columns {} and {} could both be {}: leave out, or "
                                 "rename, the one that is not meant",
                                 found->index + 1, i + 1, names.front()));
        return found;
      }
      found = {i, table.names[i].substr(std::min(name.size() + 1, text.size()))};
      break;
    }
  }
  return found;
}

constexpr std::array frequency_names = {"freq"sv, "frequency"sv, "f"sv, "hz"sv};
constexpr std::array real_names = {"re"sv, "real"sv};
constexpr std::array imaginary_names = {"im"sv, "imag"sv, "imaginary"sv};
constexpr std::array magnitude_names = {"mag"sv, "magnitude"sv, "abs"sv, "amplitude"sv};
constexpr std::array phase_names = {"phase"sv, "angle"sv, "arg"sv};

/// Where the three numbers of a line stand, and in which units.
struct Columns {
  std::size_t frequency = 0;
  std::size_t first = 1;
  std::size_t second = 2;
  bool polar = false;
  double phase_unit = 1.0;
  std::string unit;  ///< of the response; empty: not said
  std::size_t unit_column = 1;
};

std::string names_in_words(const FrfTable& table) {
  std::string text;
  for (const std::string& name : table.names) {
    text += (text.empty() ? "" : ", ") + excerpt(name);
  }
  return text;
}

bool positional(const FrfTable& table, Problems& problems) {
  if (!table.names.empty()) return false;
  if (table.rows.front().size() != 3) {
    problems.add(table.lines.front(), 1,
                 fmt::format("rows of {} numbers without a row of names: without names "
                             "a row must be frequency in Hz, real part, imaginary part",
                             table.rows.front().size()));
  }
  return true;
}

Columns find_columns(const FrfTable& table, Problems& problems) {
  Columns out;
  if (positional(table, problems)) return out;
  const auto f = column(table, frequency_names, problems);
  const auto re = column(table, real_names, problems);
  const auto im = column(table, imaginary_names, problems);
  const auto mag = column(table, magnitude_names, problems);
  const auto phase = column(table, phase_names, problems);
  out.polar = mag && phase && !(re && im);
  if (!f || !((re && im) || out.polar)) {
    problems.add(table.names_line, 1,
                 fmt::format("no columns are named freq_Hz, and re and im, or mag and "
                             "phase_deg: the columns are {}",
                             names_in_words(table)));
    return out;
  }
  out.frequency = f->index;
  out.first = out.polar ? mag->index : re->index;
  out.second = out.polar ? phase->index : im->index;
  out.unit = out.polar ? mag->unit : re->unit;
  out.unit_column = table.name_columns[out.first];
  if (out.polar) {
    const bool radians = phase->unit.find("rad") != std::string::npos;
    if (!radians && phase->unit.find("deg") == std::string::npos) {
      problems.add(table.names_line, table.name_columns[phase->index],
                   "the phase says no unit: phase_deg or phase_rad is right");
    }
    out.phase_unit = radians ? 1.0 : unit::deg;
  }
  const auto begin = f->unit.find_first_not_of(" [(/_");
  if (begin != std::string::npos && f->unit.substr(begin, 2) != "Hz") {
    problems.add(
        table.names_line, table.name_columns[f->index],
        fmt::format("the unit {} of the frequency: Hz is right", excerpt(f->unit)));
  }
  return out;
}

constexpr std::string_view say_kind =
    "say what was measured: --kind receptance (displacement over force), mobility "
    "(velocity) or accelerance (acceleration), or kind = in [frf]";

/// Kind and factor from what the file and the user say.
double settle_unit(const std::string& text, std::size_t line, std::size_t at,
                   const FrfSource& source, FrfFile& out, Problems& problems) {
  const auto unit = response_unit(text);
  const bool silent = text.find_first_not_of(" ()[]/_") == std::string::npos;
  if (!unit && !silent) {
    problems.add(line, at,
                 fmt::format("the unit {} is no unit of a response: m/N, mm/N, um/N, "
                             "m/s/N, (m/s^2)/N and g/N are",
                             excerpt(text)));
    return 1.0;
  }
  if (unit && source.kind && *source.kind != unit->kind) {
    problems.add(line, at,
                 fmt::format("the unit {} is not that of the kind that was said: leave "
                             "out the kind, or correct one of the two",
                             excerpt(text)));
  }
  if (!unit && !source.kind) {
    problems.add(line, at, fmt::format("the file says no unit: {}", say_kind));
  }
  if (!unit) {
    out.notes.push_back({"unit_assumed",
                         "The response says no unit; it was taken in SI: m, m/s or "
                         "m/s^2 over N."});
  }
  out.response.kind =
      unit ? unit->kind : source.kind.value_or(ResponseKind::receptance);
  return unit ? unit->factor : 1.0;
}

void check_order(const std::vector<double>& omega,
                 const std::vector<std::size_t>& lines, std::size_t at,
                 Problems& problems) {
  for (std::size_t i = 0; i < omega.size() && !problems.full(); ++i) {
    const std::size_t line = i < lines.size() ? lines[i] : lines.front();
    if (omega[i] < 0) {
      problems.add(
          line, at,
          fmt::format("the frequency {:g} Hz is negative", omega[i] / unit::Hz));
    } else if (i > 0 && omega[i] <= omega[i - 1]) {
      problems.add(
          line, at,
          fmt::format("the frequency {:g} Hz does not come after {:g} Hz: they "
                      "must increase",
                      omega[i] / unit::Hz, omega[i - 1] / unit::Hz));
    }
  }
}

FrfFile from_table(const std::string& text, const std::string& name,
                   const FrfSource& source) {
  Problems problems{name, {}};
  FrfFile out;
  const FrfTable table = read_frf_table(text, problems);
  const auto stop = [&] {
    if (!problems.lines.empty()) throw base::InputError(problems.lines);
  };
  stop();
  if (is_tap(table.names)) {
    FrfFile tap = tap_file(tap_columns(table), source, problems);
    stop();
    return tap;
  }
  const Columns columns = find_columns(table, problems);
  stop();
  const double factor = settle_unit(columns.unit, table.names_line, columns.unit_column,
                                    source, out, problems);
  for (const auto& row : table.rows) {
    out.response.omega.push_back(row[columns.frequency] * unit::Hz);
    const double a = row[columns.first];
    const double b = row[columns.second];
    out.response.H.push_back(factor * (columns.polar
                                           ? a * std::polar(1.0, b * columns.phase_unit)
                                           : std::complex<double>(a, b)));
  }
  check_order(out.response.omega, table.lines, 1, problems);
  stop();
  return out;
}

/// What the function type of a set says.
std::string function_name(int type) {
  constexpr std::array names = {"of no type",         "time record",
                                "auto spectrum",      "cross spectrum",
                                "frequency response", "transmissibility",
                                "coherence",          "auto correlation",
                                "cross correlation",  "power spectral density"};
  return type >= 0 && static_cast<std::size_t>(type) < names.size()
             ? names[static_cast<std::size_t>(type)]
             : fmt::format("function type {}", type);
}

std::string described(const Uff58& set) {
  const auto direction = [](int d) {
    constexpr std::array names = {"", "x", "y", "z"};
    const int size = std::abs(d);
    return size >= 1 && size <= 3
               ? std::string(d < 0 ? "-" : "+") + names[static_cast<std::size_t>(size)]
               : std::string();
  };
  return fmt::format("{}, point {}{} for a force at {}{}", excerpt(set.id[0]),
                     set.response_node, direction(set.response_direction),
                     set.reference_node, direction(set.reference_direction));
}

/// What the axes of a set say about its unit; empty: nothing.
std::string unit_text(const Uff58& set) {
  const auto silent = [](const UffAxis& axis) {
    return axis.unit.empty() || axis.unit == "NONE";
  };
  if (!silent(set.ordinate)) {
    const bool whole = response_unit(set.ordinate.unit).has_value();
    return whole || silent(set.denominator)
               ? set.ordinate.unit
               : "(" + set.ordinate.unit + ")/" + set.denominator.unit;
  }
  switch (set.ordinate.type) {
    case 8:
      return "m/N";
    case 11:
      return "m/s/N";
    case 12:
      return "m/s2/N";
    default:
      return {};
  }
}

/// What a file without a frequency response holds instead, and what would help.
std::string without_response(const UffFile& file) {
  if (file.sets.empty()) {
    return fmt::format(
        "no measured function is in this universal file{}: a frequency response is a "
        "data set 58 (or 58b) with function type 4. Export the FRF, not the geometry",
        file.others.empty()
            ? std::string()
            : fmt::format(", only {} data set{} of other kinds (the first is a {})",
                          file.others.size(), file.others.size() == 1 ? "" : "s",
                          file.others.front()));
  }
  std::string held;
  for (const Uff58& set : file.sets) {
    const std::string name = function_name(set.function_type);
    if (held.find(name) == std::string::npos) {
      held += (held.empty() ? "" : ", ") + name;
    }
  }
  return fmt::format(
      "the file holds {} measured function{} ({}), and no frequency response (data set 58 "
      "with function type 4): export the FRF from the analyser",
      file.sets.size(), file.sets.size() == 1 ? "" : "s", held);
}

/// The set that is meant.
const Uff58* chosen(const UffFile& file, const FrfSource& source, Problems& problems) {
  std::vector<const Uff58*> responses;
  std::string list;
  for (const Uff58& set : file.sets) {
    if (set.function_type == frequency_response) {
      responses.push_back(&set);
      if (responses.size() <= 12) {
        list += fmt::format("; {}: {}", responses.size(), described(set));
      }
    }
  }
  if (responses.empty()) {
    problems.add(1, 1, without_response(file));
    return nullptr;
  }
  const auto wanted = static_cast<std::size_t>(std::max(source.dataset, 0));
  if (wanted > responses.size() || (wanted == 0 && responses.size() > 1)) {
    problems.add(1, 1,
                 fmt::format("the file holds {} frequency responses: choose one by "
                             "--dataset, or dataset = in [frf]{}",
                             responses.size(), list));
    return nullptr;
  }
  return responses[wanted == 0 ? 0 : wanted - 1];
}

/// Whether there is a force in time, and no response that an analyser made of it.
bool holds_tap(const UffFile& file) {
  const bool response = std::any_of(
      file.sets.begin(), file.sets.end(),
      [](const Uff58& set) { return set.function_type == frequency_response; });
  const std::vector<TapColumn> columns = tap_columns(file);
  return !response && std::any_of(columns.begin(), columns.end(),
                                  [](const auto& c) { return c.name == "force"; });
}

FrfFile from_uff(const std::string& text, const std::string& name,
                 const FrfSource& source) {
  Problems problems{name, {}};
  const UffFile file = read_uff(text, name);
  FrfFile out;
  if (holds_tap(file)) {
    out = tap_file(tap_columns(file), source, problems);
  } else if (const Uff58* set = chosen(file, source, problems)) {
    out.description = described(*set);
    if (set->y.size() < set->promised) {
      problems.add(set->line, 1,
                   fmt::format("the head of this set speaks of {} points, the data end "
                               "after {}: the file is cut off",
                               set->promised, set->y.size()));
    }
    if (!set->complex_valued()) {
      problems.add(set->line, 1,
                   "this frequency response has real values: its phase is lost, and "
                   "with it the damping");
    }
    const double factor =
        settle_unit(unit_text(*set), set->line, 1, source, out, problems);
    for (std::size_t i = 0; i < set->y.size(); ++i) {
      out.response.omega.push_back(set->x[i] * unit::Hz);
      out.response.H.push_back(factor * set->y[i]);
    }
    check_order(out.response.omega, {set->line}, 1, problems);
  }
  if (!problems.lines.empty()) throw base::InputError(problems.lines);
  if (!file.others.empty()) {
    out.notes.push_back(
        {"sets_passed_over",
         fmt::format("The file holds {} data sets of other kinds, which "
                     "were passed over.",
                     file.others.size())});
  }
  return out;
}

/// Blows in a binary file: its table must hold a force.
FrfFile from_numbers(const NumericTable& table, const std::string& name,
                     const FrfSource& source) {
  Problems problems{name, {}};
  FrfFile out = tap_file(tap_columns(table), source, problems);
  if (!problems.lines.empty()) throw base::InputError(problems.lines);
  out.notes.insert(out.notes.end(), table.notes.begin(), table.notes.end());
  return out;
}

FrfFile from_tdms(const std::string& text, const std::string& name,
                  const FrfSource& source) {
  std::istringstream in(text);
  return from_numbers(tdms_table(in, name), name, source);
}

FrfFile from_mat(const std::string& text, const std::string& name,
                 const FrfSource& source) {
  std::istringstream in(text);
  return from_numbers(mat5_table(in, name), name, source);
}

/// A format that a response may have.
struct Reader {
  bool (*recognises)(std::string_view);  ///< the beginning of a file
  decltype(&from_table) read;
};

/// All of them: the first that recognises a file reads it, and the last takes any text.
constexpr std::array readers{Reader{is_uff, from_uff}, Reader{is_tdms, from_tdms},
                             Reader{is_mat, from_mat},
                             Reader{[](std::string_view) { return true; }, from_table}};

}  // namespace

FrfFile read_frf(const std::string& text, const std::string& name,
                 const FrfSource& source) {
  return std::find_if(readers.begin(), readers.end(),
                      [&](const Reader& reader) { return reader.recognises(text); })
      ->read(text, name, source);
}

FrfFile read_frf(const FrfSource& source) {
  auto in = open_table(source.file, source.location, frf_kind);
  const std::string text{std::istreambuf_iterator<char>(in),
                         std::istreambuf_iterator<char>()};
  return read_frf(text, source.file.string(), source);
}

}  // namespace trochoid::inputs
