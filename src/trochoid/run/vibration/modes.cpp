#include <trochoid/run/vibration/modes.h>

#include <trochoid/base/units.h>
#include <trochoid/run/vibration/warnings.h>

#include <fmt/core.h>

#include <utility>

namespace trochoid::run {

namespace {

/// Orders that the diagram of stabilisation shows beyond the modes that were found.
constexpr int orders_beyond = 6;

structure::ModesOptions options_of(const inputs::FrfTables& frf) {
  structure::ModesOptions options{.count = frf.modes};
  if (frf.residual_terms != inputs::ResidualTerms::choose) {
    options.residual_terms = frf.residual_terms == inputs::ResidualTerms::yes;
  }
  if (frf.band.size() == 2) {
    // A line at the end of the band belongs to it, whatever rounding did to it.
    options.from = frf.band[0] * unit::Hz * (1 - 1e-12);
    options.to = frf.band[1] * unit::Hz * (1 + 1e-12);
  }
  return options;
}

}  // namespace

inputs::FrfSource frf_source(const inputs::FrfTables& frf) {
  return {.file = frf.file,
          .location = frf.location,
          .kind = frf.kind,
          .dataset = frf.dataset};
}

results::ModesResult modes(const inputs::Case& given) {
  const inputs::FrfTables& frf = *given.machine.frf;
  inputs::FrfFile file = inputs::read_frf(frf_source(frf));
  results::ModesResult r{
      .heading = {.title = given.title, .case_toml = given.as_understood},
      .kind = file.response.kind,
      .description = std::move(file.description),
      .body = frf.body,
      .axis = frf.axis,
      .fit = structure::identify_modes(file.response, options_of(frf))};
  r.heading.warnings = std::move(file.notes);
  if (r.fit.omega.size() > 1) {
    const int highest = static_cast<int>(r.fit.modes.size()) + orders_beyond;
    r.poles = structure::stabilisation(
        {.kind = r.kind, .omega = r.fit.omega, .H = r.fit.H}, highest);
  }
  r.heading.ok = r.fit.ok;
  if (!r.fit.ok) {
    r.heading.message = r.fit.reason;
    return r;
  }
  add_modes_warnings(r.fit, r.heading.warnings);
  r.heading.message =
      fmt::format("{} mode{} from {} lines.", r.fit.modes.size(),
                  r.fit.modes.size() == 1 ? "" : "s", r.fit.omega.size());
  return r;
}

}  // namespace trochoid::run
