#include <trochoid/run/commands.h>
#include <trochoid/run/modes.h>

#include <trochoid/base/units.h>
#include <trochoid/run/mode_words.h>
#include <trochoid/run/shared_modes.h>
#include <trochoid/run/tap_response.h>
#include <trochoid/run/vibration.h>
#include <trochoid/structure/delay.h>

#include <fmt/core.h>

#include <utility>

namespace trochoid::run {

namespace {

/// Orders that the diagram of stabilisation shows beyond the modes that were found.
constexpr int orders_beyond = 6;

structure::ModesOptions options_of(const cases::FrfTables& frf) {
  structure::ModesOptions options{.count = frf.modes};
  if (frf.residual_terms != cases::ResidualTerms::choose) {
    options.residual_terms = frf.residual_terms == cases::ResidualTerms::yes;
  }
  if (frf.band.size() == 2) {
    // A line at the end of the band belongs to it, whatever rounding did to it.
    options.from = frf.band[0] * unit::Hz * (1 - 1e-12);
    options.to = frf.band[1] * unit::Hz * (1 + 1e-12);
  }
  return options;
}

/// Take out a delay between force and response.
void settle_delay(const structure::FrequencyResponse& response,
                  const structure::ModesOptions& options, results::ModesResult& r) {
  auto delayed = structure::delayed_fit(response, options, r.fit);
  if (!delayed) return;
  add_delay_warning(delayed->delay, {}, r.heading.warnings);
  r.fit = std::move(delayed->fit);
}

}  // namespace

results::ModesResult modes(const cases::Case& given) {
  const cases::FrfTables& frf = *given.machine.frf;
  files::FrfFile file = frf.response.get();
  const structure::ResponseKind kind = file.response.kind;
  results::ModesResult r{.heading = heading_of(given), .body = frf.body};
  r.responses = {{.motion = frf.axis,
                  .force = frf.axis,
                  .description = std::move(file.description)}};
  base::add(r.heading.warnings, std::move(file.notes));
  structure::ModesOptions options = options_of(frf);
  if (file.tap) {
    r.tap = signal::frequency_response(*file.tap, frf.tap);
    add_tap_warnings(*r.tap, r.heading.warnings);
    options.window_decay = r.tap->decay;
    if (frf.band.empty()) {
      options.from = first_coherent(*r.tap) * (1 - 1e-12);
    }
    file.response = response_of(*r.tap, kind);
  }
  if (r.tap && !r.tap->fault.empty()) {
    r.fit.reason = r.tap->fault;
    r.fit.responses = {{.kind = kind}};
  } else {
    r.fit = structure::identify_modes(file.response, options);
    settle_delay(file.response, options, r);
  }
  const structure::FittedResponse& one = r.fit.responses.front();
  if (one.omega.size() > 1) {
    const int highest = static_cast<int>(r.fit.modes.size()) + orders_beyond;
    r.poles = structure::stabilisation({.kind = kind, .omega = one.omega, .H = one.H},
                                       highest);
  }
  r.heading.ok = r.fit.ok;
  if (!r.fit.ok) {
    r.heading.message = r.fit.reason;
    return r;
  }
  add_modes_warnings(r, r.heading.warnings);
  if (auto complex = structure::complex_check(r.fit)) {
    // Real modes of a complex one are no answer: there are too many of them.
    if (complex->complex() && !r.tap && frf.modes == 0 &&
        frf.shapes == cases::Shapes::choose) {
      complex->fit.complex_evidence = complex->evidence;
      return shared_modes(given, std::move(complex->fit));
    }
    add_complex_warning(*complex, r.heading.warnings);
  }
  r.heading.message = fmt::format("{}. {} ({} lines).", mode_words(r.fit.modes),
                                  unexplained_power(one.explained), one.omega.size());
  return r;
}

}  // namespace trochoid::run
