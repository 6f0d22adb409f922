#include <trochoid/files/frf_uff.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/files/frf_checks.h>
#include <trochoid/files/tap_columns.h>
#include <trochoid/files/uff58.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace trochoid::files {

namespace {

constexpr int frequency_response = 4;  ///< function type of a set 58

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
      "the file has {} measured function{} ({}), and no frequency response (data set "
      "58 with function type 4): export the FRF from the analyser",
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
    problems.add(
        1, 1,
        fmt::format("the file has {} frequency responses: choose one by "
                    "--dataset, or dataset = in [frf]; they are fitted together "
                    "where all are of one point, along x and y, a direct one "
                    "and a cross one among them{}",
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

/// One set as a response.
FrfFile taken(const Uff58& set, const FrfSource& source, Problems& problems) {
  FrfFile out;
  out.description = described(set);
  if (set.y.size() < set.promised) {
    problems.add(set.line, 1,
                 fmt::format("the head of this set speaks of {} points, the data end "
                             "after {}: the file is cut off",
                             set.promised, set.y.size()));
  }
  if (!set.complex_valued()) {
    problems.add(set.line, 1,
                 "this frequency response has real values: its phase is lost, and "
                 "with it the damping");
  }
  const double factor =
      settle_unit({unit_text(set), set.line, 1}, source, out, problems);
  for (std::size_t i = 0; i < set.y.size(); ++i) {
    out.response.omega.push_back(set.x[i] * unit::Hz);
    out.response.H.push_back(factor * set.y[i]);
  }
  check_order(out.response.omega, {set.line}, 1, problems);
  return out;
}

/// What else a file holds is not read.
void note_others(const UffFile& file, FrfFile& out) {
  if (!file.others.empty()) {
    out.notes.push_back({"sets_passed_over",
                         fmt::format("The file has {} data sets of other kinds, which "
                                     "were not read.",
                                     file.others.size())});
  }
}

/// x or y, from the number of a direction; none: another one.
std::optional<structure::Axis> direction_of(int direction) {
  switch (std::abs(direction)) {
    case 1:
      return structure::Axis::x;
    case 2:
      return structure::Axis::y;
    default:
      return std::nullopt;
  }
}

/// Whether responses may share their modes: one point, x and y joined, none twice.
bool belong_together(const std::vector<const Uff58*>& sets) {
  bool direct = false;
  bool cross = false;
  bool both = false;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const Uff58& a = *sets[i];
    const auto motion = direction_of(a.response_direction);
    const auto force = direction_of(a.reference_direction);
    if (!motion || !force || a.response_node != sets[0]->response_node ||
        a.reference_node != sets[0]->response_node) {
      return false;
    }
    direct = direct || *motion == *force;
    cross = cross || *motion != *force;
    both = both || *motion != direction_of(sets[0]->response_direction);
    for (std::size_t k = 0; k < i; ++k) {
      if (motion == direction_of(sets[k]->response_direction) &&
          force == direction_of(sets[k]->reference_direction)) {
        return false;
      }
    }
  }
  return sets.size() > 1 && direct && (cross || !both);
}

}  // namespace

std::vector<DirectedFrf> directed_frfs_from_uff(const std::string& text,
                                                const std::string& name,
                                                const FrfSource& source) {
  Problems problems{name, {}};
  const UffFile file = read_uff(text, name);
  std::vector<const Uff58*> sets;
  for (const Uff58& set : file.sets) {
    if (set.function_type == frequency_response) {
      sets.push_back(&set);
    }
  }
  if (!belong_together(sets)) {
    return {};
  }
  std::vector<DirectedFrf> out;
  for (const Uff58* set : sets) {
    out.push_back({.motion = *direction_of(set->response_direction),
                   .force = *direction_of(set->reference_direction),
                   .file = taken(*set, source, problems)});
    if ((set->response_direction < 0) != (set->reference_direction < 0)) {
      for (auto& H : out.back().file.response.H) {
        H = -H;
      }
    }
  }
  if (!problems.lines.empty()) throw base::InputError(problems.lines);
  note_others(file, out.front().file);
  return out;
}

FrfFile frf_from_uff(const std::string& text, const std::string& name,
                     const FrfSource& source) {
  Problems problems{name, {}};
  const UffFile file = read_uff(text, name);
  FrfFile out;
  if (holds_tap(file)) {
    out = tap_file(tap_columns(file), source, problems);
  } else if (const Uff58* set = chosen(file, source, problems)) {
    out = taken(*set, source, problems);
  }
  if (!problems.lines.empty()) throw base::InputError(problems.lines);
  note_others(file, out);
  return out;
}

}  // namespace trochoid::files
