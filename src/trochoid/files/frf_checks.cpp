#include <trochoid/files/frf_checks.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <string_view>

namespace trochoid::files {

namespace {

using structure::ResponseKind;

constexpr std::string_view say_kind =
    "say what was measured: --kind receptance (displacement over force), mobility "
    "(velocity) or accelerance (acceleration), or kind = in [frf]";

}  // namespace

double settle_unit(const UnitText& said, const FrfSource& source, FrfFile& out,
                   Problems& problems) {
  const std::string& text = said.text;
  const auto unit = response_unit(text);
  const bool silent = text.find_first_not_of(" ()[]/_") == std::string::npos;
  if (!unit && !silent) {
    problems.add(said.line, said.column,
                 fmt::format("the unit {} is no unit of a response: m/N, mm/N, um/N, "
                             "m/s/N, (m/s^2)/N and g/N are",
                             excerpt(text)));
    return 1.0;
  }
  if (unit && source.kind && *source.kind != unit->kind) {
    problems.add(said.line, said.column,
                 fmt::format("the unit {} does not fit the given kind: leave out the "
                             "kind, or correct one of the two",
                             excerpt(text)));
  }
  if (!unit && !source.kind) {
    problems.add(said.line, said.column,
                 fmt::format("the file says no unit: {}", say_kind));
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

}  // namespace trochoid::files
