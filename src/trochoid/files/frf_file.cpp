#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/files/csv_table.h>
#include <trochoid/files/frf_checks.h>
#include <trochoid/files/frf_file.h>
#include <trochoid/files/frf_table.h>
#include <trochoid/files/frf_uff.h>
#include <trochoid/files/mat.h>
#include <trochoid/files/tap_columns.h>
#include <trochoid/files/tdms.h>
#include <trochoid/files/uff58.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <sstream>

namespace trochoid::files {

namespace {

using namespace std::string_view_literals;
using structure::ResponseKind;

constexpr TableKind frf_kind{.noun = "a frequency response",
                             .files = "a universal file (UFF58) or a table",
                             .row = "line",
                             .example = "freq_Hz,re_m/N,im_m/N"};

/// One column of a table, by what its name begins with.
struct Found {
  std::size_t index = 0;
  std::string unit;  ///< the rest of the name
};

/// The column whose name is one of these, alone or before a unit.
std::optional<Found> column(const FrfTable& table,
                            std::span<const std::string_view> names,
                            Problems& problems) {
  std::optional<Found> found;
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    const auto unit = unit_after(table.names[i], names);
    if (!unit) continue;
    if (found) {
      problems.add(table.names_line, table.name_columns[i],
                   fmt::format("columns {} and {} could both be {}: leave out, or "
                               "rename, the one that is not meant",
                               found->index + 1, i + 1, names.front()));
      return found;
    }
    found = {i, *unit};
  }
  return found;
}

constexpr std::array frequency_names = {"freq"sv, "frequency"sv, "f"sv, "hz"sv};
constexpr std::array real_names = {"re"sv, "real"sv};
constexpr std::array imaginary_names = {"im"sv, "imag"sv, "imaginary"sv};
constexpr std::array magnitude_names = {"mag"sv, "magnitude"sv, "abs"sv, "amplitude"sv};
constexpr std::array phase_names = {"phase"sv, "angle"sv, "arg"sv};

/// Where the three numbers of a line stand, and in which units.
struct FrfColumns {
  std::size_t frequency = 0;
  std::size_t first = 1;
  std::size_t second = 2;
  bool polar = false;
  bool decibels = false;  ///< of the magnitude
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

/// The unit that decibels are over: of `dB re 1 m/N)` m/N.
std::string reference_of(std::string text) {
  std::erase_if(text,
                [](char c) { return c == ' ' || c == '[' || c == ']' || c == '_'; });
  for (const std::string_view word : {"rel."sv, "ref."sv, "ref"sv, "re"sv, "1"sv}) {
    if (text.starts_with(word)) text = text.substr(word.size());
  }
  if (std::ranges::count(text, ')') > std::ranges::count(text, '(')) text.pop_back();
  return text;
}

FrfColumns find_columns(const FrfTable& table, Problems& problems) {
  FrfColumns out;
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
                             "phase_deg (of hammer blows in time: time_s, force_N, and "
                             "a response such as acc_g): the columns are {}",
                             names_in_words(table)));
    return out;
  }
  out.frequency = f->index;
  out.first = out.polar ? mag->index : re->index;
  out.second = out.polar ? phase->index : im->index;
  out.unit = out.polar ? mag->unit : re->unit;
  if (const auto begin = out.unit.find("dB"); out.polar && begin != std::string::npos) {
    out.decibels = true;
    out.unit = reference_of(out.unit.substr(begin + 2));
  }
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
  const FrfColumns columns = find_columns(table, problems);
  stop();
  const double factor = settle_unit(
      {columns.unit, table.names_line, columns.unit_column}, source, out, problems);
  for (const auto& row : table.rows) {
    out.response.omega.push_back(row[columns.frequency] * unit::Hz);
    const double a =
        columns.decibels ? std::pow(10.0, row[columns.first] / 20) : row[columns.first];
    const double b = row[columns.second];
    out.response.H.push_back(factor * (columns.polar
                                           ? a * std::polar(1.0, b * columns.phase_unit)
                                           : std::complex<double>(a, b)));
  }
  check_order(out.response.omega, table.lines, 1, problems);
  stop();
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
struct FrfReader {
  bool (*recognises)(std::string_view);  ///< the beginning of a file
  decltype(&from_table) read;
};

/// All of them: the first that recognises a file reads it, and the last takes any text.
constexpr std::array frf_readers{
    FrfReader{is_uff, frf_from_uff}, FrfReader{is_tdms, from_tdms},
    FrfReader{is_mat, from_mat},
    FrfReader{[](std::string_view) { return true; }, from_table}};

}  // namespace

FrfFile read_frf(const std::string& text, const std::string& name,
                 const FrfSource& source) {
  return std::find_if(frf_readers.begin(), frf_readers.end(),
                      [&](const FrfReader& reader) { return reader.recognises(text); })
      ->read(text, name, source);
}

std::vector<DirectedFrf> read_directed_frfs(const FrfSource& source) {
  const std::string text = bytes_of(source.file, frf_kind);
  return is_uff(text) ? directed_frfs_from_uff(text, source.file.path, source)
                      : std::vector<DirectedFrf>();
}

FrfFile read_frf(const FrfSource& source) {
  FrfFile file = read_frf(bytes_of(source.file, frf_kind), source.file.path, source);
  if (!source.scale.empty() && !file.tap) {
    throw base::InputError({source.file.path +
                            ": scale is for hammer blows in time, and this is a "
                            "frequency response: leave it out"});
  }
  return file;
}

}  // namespace trochoid::files
