#include <trochoid/files/transmission_file.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/files/csv_table.h>
#include <trochoid/files/frf_table.h>
#include <trochoid/files/uff58.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace trochoid::files {

namespace {

using signal::Transmission;

constexpr TableKind transmission_kind{.noun = "the response of a dynamometer",
                                      .files = "a universal file (UFF58) or a table",
                                      .row = "line",
                                      .example = "freq_Hz,H11_re,H11_im"};

constexpr int response_type = 4;  ///< function type of a set 58
constexpr int force = 13;         ///< type of an axis of a set 58
/// A static response that differs more than this from 1 is worth a word.
constexpr double calibrated = 0.1;

/// Which entries of the matrix a file gives.
using Given = std::array<bool, 9>;

Transmission::Matrix rigid() {
  return {1, 0, 0, 0, 1, 0, 0, 0, 1};
}

/// The column of that name, whatever the case of its letters.
std::optional<std::size_t> column(const FrfTable& table, const std::string& name) {
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    if (small_letters(table.names[i]) == name) return i;
  }
  return std::nullopt;
}

/// Two columns that make a complex number.
struct Pair {
  std::size_t first = 0;
  std::size_t second = 0;
  bool polar = false;

  [[nodiscard]] std::complex<double> of(const std::vector<double>& row) const {
    return polar ? std::polar(row[first], row[second] * unit::deg)
                 : std::complex<double>(row[first], row[second]);
  }
};

std::optional<Pair> pair(const FrfTable& table, const std::string& prefix) {
  const auto re = column(table, prefix + "re");
  const auto im = column(table, prefix + "im");
  if (re && im) return Pair{*re, *im, false};
  const auto mag = column(table, prefix + "mag");
  const auto phase = column(table, prefix + "phase_deg");
  if (mag && phase) return Pair{*mag, *phase, true};
  return std::nullopt;
}

std::array<std::optional<Pair>, 9> pairs(const FrfTable& table) {
  std::array<std::optional<Pair>, 9> out;
  for (std::size_t k = 0; k < 9; ++k) {
    out[k] = pair(table, fmt::format("h{}{}_", k / 3 + 1, k % 3 + 1));
  }
  if (const auto all = pair(table, "")) {
    for (const std::size_t k : {0U, 4U, 8U}) {
      if (!out[k]) out[k] = all;
    }
  }
  return out;
}

void check_order(const Transmission& t, const std::vector<std::size_t>& lines,
                 Problems& problems) {
  for (std::size_t i = 0; i < t.omega.size() && !problems.full(); ++i) {
    if (t.omega[i] < 0.0 || (i > 0 && t.omega[i] <= t.omega[i - 1])) {
      problems.add(lines[std::min(i, lines.size() - 1)], 1,
                   fmt::format("the frequency {:g} Hz: frequencies must be 0 or more, "
                               "and increase",
                               t.omega[i] / unit::Hz));
    }
  }
}

Given from_table(const std::string& text, Transmission& out, Problems& problems) {
  const FrfTable table = read_frf_table(text, problems);
  Given given{};
  if (!problems.lines.empty()) return given;
  const auto f = column(table, "freq_hz");
  const auto columns = pairs(table);
  const bool some = std::ranges::any_of(columns, [](const auto& p) { return !!p; });
  if (!f || !some) {
    problems.add(
        table.names_line, 1,
        "no columns freq_Hz, and H11_re and H11_im (channel 1 over a force "
        "along it; H12: over one along channel 2), or H11_mag and "
        "H11_phase_deg; re and im alone are right where all channels are alike");
    return given;
  }
  for (const auto& row : table.rows) {
    out.omega.push_back(row[*f] * unit::Hz);
    Transmission::Matrix& H = out.H.emplace_back(rigid());
    for (std::size_t k = 0; k < 9; ++k) {
      given[k] = columns[k].has_value();
      if (given[k]) H[k] = columns[k]->of(row);
    }
  }
  check_order(out, table.lines, problems);
  return given;
}

/// Whether a set is of force over force.
bool of_forces(const Uff58& set, Problems& problems) {
  const auto fits = [](const UffAxis& axis) {
    return axis.type == force || axis.type == 0 || axis.type == 1;
  };
  if (fits(set.ordinate) && fits(set.denominator)) return true;
  problems.add(set.line, 1,
               "this frequency response is not of force over force: a dynamometer "
               "needs the reading of a channel over the force of the hammer");
  return false;
}

/// @return the place of a set in the matrix; none: its directions name no channels
std::optional<std::size_t> place_of(const Uff58& set, Problems& problems) {
  const int i = std::abs(set.response_direction);
  const int j = std::abs(set.reference_direction);
  if (i >= 1 && i <= 3 && j >= 1 && j <= 3) {
    return static_cast<std::size_t>(3 * (i - 1) + j - 1);
  }
  problems.add(
      set.line, 1,
      fmt::format("directions {} and {} of this frequency response: 1, 2 and 3 "
                  "are channels 1 to 3",
                  set.response_direction, set.reference_direction));
  return std::nullopt;
}

void add_set(const Uff58& set, Transmission& out, Given& given, Problems& problems) {
  const auto place = place_of(set, problems);
  if (!place || !of_forces(set, problems)) return;
  if (set.y.size() < set.promised || set.y.empty() || !set.complex_valued()) {
    problems.add(set.line, 1,
                 "this frequency response is cut off, empty, or has no phase");
    return;
  }
  if (given[*place]) {
    problems.add(set.line, 1, "this pair of directions has been there before");
    return;
  }
  if (out.omega.empty()) {
    for (const double x : set.x) out.omega.push_back(x * unit::Hz);
    out.H.assign(out.omega.size(), rigid());
    check_order(out, {set.line}, problems);
  }
  const bool same_lines = set.x.size() == out.omega.size() &&
                          std::ranges::equal(set.x, out.omega, [](double a, double b) {
                            return std::abs(a * unit::Hz - b) <= 1e-9 * std::abs(b);
                          });
  if (!same_lines) {
    problems.add(set.line, 1,
                 "this frequency response has other frequencies than the first: all of "
                 "them must have the same");
    return;
  }
  const double sign = set.response_direction * set.reference_direction < 0 ? -1.0 : 1.0;
  for (std::size_t i = 0; i < out.H.size(); ++i) out.H[i][*place] = sign * set.y[i];
  given[*place] = true;
}

Given from_uff(const std::string& text, const std::string& name, Transmission& out,
               Problems& problems) {
  Given given{};
  const UffFile file = read_uff(text, name);
  bool any = false;
  for (const Uff58& set : file.sets) {
    if (set.function_type != response_type) continue;
    any = true;
    add_set(set, out, given, problems);
  }
  if (!any) {
    problems.add(1, 1,
                 "the file has no frequency response (data set 58, function type 4)");
  }
  return given;
}

void add_notes(const Given& given, TransmissionFile& out) {
  const Transmission::Matrix first = signal::at(out.transmission, 0.0);
  for (std::size_t c = 0; c < 3; ++c) {
    if (!given[4 * c]) {
      out.notes.push_back(
          {"channel_without_response",
           fmt::format("Channel {} has no response of its own: it is taken as rigid.",
                       c + 1)});
    } else if (std::abs(first[4 * c].real() - 1.0) > calibrated) {
      out.notes.push_back(
          {"response_not_calibrated",
           fmt::format(
               "Channel {} reads {:.3g} of a slow force, not 1: is the response "
               "in N over N? It is used as it stands.",
               c + 1, first[4 * c].real())});
    }
  }
}

}  // namespace

TransmissionFile transmission_of(const std::string& text, const std::string& name) {
  Problems problems{name, {}};
  TransmissionFile out;
  const Given given = is_uff(text) ? from_uff(text, name, out.transmission, problems)
                                   : from_table(text, out.transmission, problems);
  if (!problems.lines.empty()) throw base::InputError(problems.lines);
  add_notes(given, out);
  return out;
}

TransmissionFile read_transmission(const FileRef& file) {
  return transmission_of(bytes_of(file, transmission_kind), file.path);
}

}  // namespace trochoid::files
