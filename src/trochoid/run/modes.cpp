#include <trochoid/run/commands.h>
#include <trochoid/run/modes.h>

#include <trochoid/base/units.h>
#include <trochoid/run/mode_words.h>
#include <trochoid/run/tap_response.h>
#include <trochoid/run/vibration.h>
#include <trochoid/structure/identify_shapes.h>

#include <fmt/core.h>

#include <algorithm>
#include <complex>
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

results::ModesResult modes(const inputs::Case& given) {
  const inputs::FrfTables& frf = *given.machine.frf;
  inputs::FrfFile file = frf.response.get();
  results::ModesResult r{.heading = heading_of(given),
                         .kind = file.response.kind,
                         .description = std::move(file.description),
                         .body = frf.body,
                         .axis = frf.axis};
  base::add(r.heading.warnings, std::move(file.notes));
  structure::ModesOptions options = options_of(frf);
  if (file.tap) {
    r.tap = signal::frequency_response(*file.tap, frf.tap);
    add_tap_warnings(*r.tap, r.heading.warnings);
    options.window_decay = r.tap->decay;
    if (frf.band.empty()) {
      options.from = first_coherent(*r.tap) * (1 - 1e-12);
    }
    file.response = response_of(*r.tap, r.kind);
  }
  if (r.tap && !r.tap->fault.empty()) {
    r.fit.reason = r.tap->fault;
  } else {
    r.fit = structure::identify_modes(file.response, options);
  }
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
  if (const auto complex = structure::complex_check(r.fit, r.kind)) {
    add_complex_warning(*complex, r.heading.warnings);
  }
  std::vector<ModeWords> words;
  for (const structure::FittedMode& mode : r.fit.modes) {
    words.push_back({mode.omega, mode.zeta});
  }
  r.heading.message =
      fmt::format("{}. {} ({} lines).", mode_words(words),
                  unexplained_power(r.fit.explained), r.fit.omega.size());
  return r;
}

}  // namespace trochoid::run
