#include <trochoid/run/shared_modes.h>

#include <trochoid/base/units.h>
#include <trochoid/run/commands.h>
#include <trochoid/run/mode_words.h>
#include <trochoid/run/modes.h>
#include <trochoid/run/tap_response.h>
#include <trochoid/run/vibration.h>

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace trochoid::run {

namespace {

using cases::Axis;
using structure::DirectedResponse;
using Warnings = std::vector<base::Warning>;

/// A response as its file has it.
struct Source {
  files::DirectedFrf frf;
  std::vector<double> band;  ///< [Hz]; empty: all
};

std::vector<Source> sources_of(const cases::Case& given, const cases::FrfTables& frf) {
  std::vector<Source> out;
  if (!frf.source.file.name.empty()) {
    if (frf.source.dataset == 0) {
      for (const files::DirectedFrf& one : frf.directed.get()) {
        out.push_back({one, frf.band});
      }
    }
    if (out.empty()) {
      out.push_back({{frf.axis, frf.axis, frf.response.get()}, frf.band});
    }
    return out;
  }
  for (const cases::MeasuredFrf& one : given.machine.measured_frfs) {
    out.push_back({{one.axis, one.force_axis.value_or(one.axis), one.response.get()},
                   one.band.empty() ? frf.band : one.band});
  }
  return out;
}

/// Lines above 0 Hz and inside a band.
structure::FrequencyResponse in_band(const structure::FrequencyResponse& response,
                                     const std::vector<double>& band, double from) {
  structure::FrequencyResponse out{.kind = response.kind,
                                   .noise_bandwidth = response.noise_bandwidth};
  for (std::size_t i = 0; i < response.omega.size(); ++i) {
    const double omega = response.omega[i];
    const double f = omega / unit::Hz;
    // A line at the end of the band belongs to it, whatever rounding did to it.
    const bool inside = band.size() == 2
                            ? f >= band[0] * (1 - 1e-12) && f <= band[1] * (1 + 1e-12)
                            : omega >= from * (1 - 1e-12);
    if (omega > 0 && inside) {
      out.omega.push_back(omega);
      out.H.push_back(response.H[i]);
    }
  }
  return out;
}

/// One response for the fit; from blows in time where its file holds those.
/// @return why there is none; empty: there is one
std::string add_response(Source& source, const cases::FrfTables& frf,
                         std::vector<DirectedResponse>& all, results::ModesResult& r) {
  files::FrfFile& file = source.frf.file;
  const std::string name =
      fmt::format("{}{}", name_of(source.frf.motion), name_of(source.frf.force));
  DirectedResponse one{.name = name};
  std::string fault;
  double from = 0.0;
  if (file.tap) {
    const signal::TapResponse tap = signal::frequency_response(*file.tap, frf.tap);
    Warnings own;
    add_tap_warnings(tap, own);
    for (base::Warning& warning : own) {
      warning.message = fmt::format("Response {}: {}", name, warning.message);
    }
    base::add(r.heading.warnings, std::move(own));
    file.response = response_of(tap, file.response.kind);
    one.decay = tap.decay;
    from = first_coherent(tap);
    fault = tap.fault.empty() ? "" : fmt::format("response {}: {}", name, tap.fault);
  }
  one.response = in_band(file.response, source.band, from);
  r.responses.push_back({.name = name,
                         .motion = source.frf.motion,
                         .force = source.frf.force,
                         .description = std::move(file.description)});
  base::add(r.heading.warnings, std::move(file.notes));
  all.push_back(std::move(one));
  return fault;
}

/// Directions as numbers from 0: x and y, or the only one.
void number_directions(const results::ModesResult& r,
                       std::vector<DirectedResponse>& all) {
  const bool only_one =
      std::all_of(r.responses.begin(), r.responses.end(), [&](const auto& one) {
        return one.motion == r.responses.front().motion &&
               one.force == r.responses.front().motion;
      });
  for (std::size_t q = 0; q < all.size(); ++q) {
    all[q].motion = only_one ? 0 : static_cast<std::size_t>(r.responses[q].motion);
    all[q].force = only_one ? 0 : static_cast<std::size_t>(r.responses[q].force);
  }
}

structure::ModesOptions shared_options(const cases::FrfTables& frf) {
  structure::ModesOptions options{.count = frf.modes};
  if (frf.residual_terms != cases::ResidualTerms::choose) {
    options.residual_terms = frf.residual_terms == cases::ResidualTerms::yes;
  }
  if (frf.shapes != cases::Shapes::choose) {
    options.complex_shapes = frf.shapes == cases::Shapes::complex;
  }
  return options;
}

}  // namespace

bool modes_are_shared(const cases::Case& given) {
  const auto& frf = given.machine.frf;
  if (!frf || frf->source.file.name.empty() || frf->shapes == cases::Shapes::complex) {
    return true;
  }
  return frf->source.dataset == 0 && !frf->directed.get().empty();
}

results::ModesResult shared_modes(const cases::Case& given,
                                  std::optional<structure::ModesFit> known) {
  const cases::FrfTables frf = given.machine.frf.value_or(cases::FrfTables{});
  results::ModesResult r{.heading = heading_of(given)};
  r.shared = true;
  r.body = frf.source.file.name.empty() ? given.machine.measured_frfs.front().body
                                        : frf.body;
  std::vector<DirectedResponse> all;
  std::string fault;
  for (Source& source : sources_of(given, frf)) {
    const std::string own = add_response(source, frf, all, r);
    fault = fault.empty() ? own : fault;
  }
  number_directions(r, all);
  if (fault.empty()) {
    r.fit = known ? *std::move(known)
                  : structure::identify_shapes(all, shared_options(frf));
  } else {
    r.fit.reason = fault;
    for (const DirectedResponse& one : all) {
      r.fit.responses.push_back({.kind = one.response.kind,
                                 .omega = one.response.omega,
                                 .H = one.response.H});
    }
  }
  r.heading.ok = r.fit.ok;
  if (!r.fit.ok) {
    r.heading.message = r.fit.reason;
    return r;
  }
  add_modes_warnings(r, r.heading.warnings);
  double worst = 1.0;
  for (const structure::FittedResponse& one : r.fit.responses) {
    worst = std::min(worst, one.explained);
  }
  r.heading.message =
      fmt::format("{}, with {} shapes. {}, of the worst of {} response{}.",
                  mode_words(r.fit.modes), r.fit.complex_shapes ? "complex" : "real",
                  unexplained_power(worst), all.size(), all.size() == 1 ? "" : "s");
  return r;
}

}  // namespace trochoid::run
