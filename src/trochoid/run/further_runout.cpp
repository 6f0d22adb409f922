#include <trochoid/run/identify.h>

#include <trochoid/base/units.h>
#include <trochoid/identification/channel_fit.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/identification/resonance.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

using identification::ChannelData;
using identification::ChannelRequest;
using identification::Fit;
using identification::FoundKind;
using identification::FurtherUnknown;
using results::IdentifyResult;

/// Forces in x, y and z of the runs, each laid over its true angle.
std::vector<ChannelData> data_of(const IdentifyResult& r, const Fit& fit) {
  std::vector<ChannelData> out;
  for (std::size_t k = 0; k < r.runs.size(); ++k) {
    const identification::Run& run = r.runs[k];
    ChannelData& one = out.emplace_back(
        ChannelData{.cut = run.cut, .angle = run.angle, .value = {}, .sd = {1, 1, 1}});
    for (double& angle : one.angle) angle += fit.phase[k];
    for (const auto& F : run.force)
      one.value.insert(one.value.end(), F.begin(), F.end());
  }
  return out;
}

force::Sensor table() {
  return {.channels = {{force::ChannelAxis::x},
                       {force::ChannelAxis::y},
                       {force::ChannelAxis::z}}};
}

/// Whether a cutter can show axial offsets next to radial ones: at one lead angle all along
/// they do the same.
bool has_a_corner(const geometry::Cutter& cutter) {
  return cutter.profile.R > 0.0 || cutter.profile.alpha != 0.0;
}

/// Whether the edges turn so far along the cut that a tilt shows next to an eccentricity.
bool turns_far(const force::Setup& setup) {
  constexpr double far = 2.0;  // [rad]
  return 2 * setup.cut.a_p * std::abs(std::tan(setup.cutter.helix)) >
         far * setup.cutter.profile.D;
}

/// Whether resonances of the dynamometer were found in the records.
bool rings(const Fit& fit) {
  return std::ranges::any_of(fit.resonances, [](const auto& one) { return !!one; });
}

/// Whether a record may tell more of the runout at all: one tool, all forces, no given
/// response, and more left than noise, or resonances that may stand for what is missing.
bool may_tell_more(const cases::Case& given, const IdentifyResult& r, const Fit& fit) {
  const bool all_forces =
      std::ranges::all_of(r.runs, [](const identification::Run& run) {
        return run.measured == std::array<bool, 3>{true, true, true};
      });
  const bool given_response = given.dynamometer && !given.dynamometer->frf.name.empty();
  return fit.ok && all_forces && fit.groups.size() < 2 && !given_response &&
         (rings(fit) || fit.options.response.empty()) &&
         chip::feels_runout(fit.chip.model) && !force::form(fit.law).power &&
         asks_for_more_runout(given) &&
         (rings(fit) || !identification::leaves_noise_alone(r.runs, fit));
}

/// Whether all unknowns of a kind would be told: each by an angle of its own, and to a tenth
/// of the feed.
bool are_told(const std::vector<FurtherUnknown>& all, bool tilt, double length,
              double radius) {
  constexpr double least_angle = 10 * unit::deg;
  constexpr double most_error = 0.1;  // of the feed per tooth
  bool any = false;
  for (const FurtherUnknown& one : all) {
    const FoundKind kind = one.unknown.kind;
    const bool of_tilt = kind == FoundKind::tilt_x || kind == FoundKind::tilt_y;
    if (of_tilt != tilt || (!tilt && kind != FoundKind::axial_offset)) continue;
    any = true;
    const double error = tilt ? one.se * radius : one.se;
    if (!(one.angle > least_angle) || !(error < most_error * length)) return false;
  }
  return any;
}

/// By how much further unknowns must explain more than chance would.
constexpr double clearly_more = 16.0;
constexpr double worth_widening = 1.02;

/// @param more  unknowns that the second fit has more
bool explains_more(const Fit& without, const Fit& with, double more) {
  if (!with.ok || !(with.freedom > 0.0)) return false;
  const double gain = without.channels->weighted_rss - with.channels->weighted_rss;
  const double chance = with.channels->weighted_rss / with.freedom;
  return gain > clearly_more * more * chance;
}

/// Whether all axial offsets of a fit are told to a tenth of the feed.
bool tells_axial_offsets(const Fit& fit, double length) {
  constexpr double most_error = 0.1;
  const auto& se = fit.channels->axial_offsets_se;
  return fit.ok && !se.empty() &&
         std::ranges::all_of(se, [&](const std::optional<double>& error) {
           return error.value_or(0.0) < most_error * length;
         });
}

/// What was found of the channels as a fit of the runs, like the one that it takes the place of.
Fit as_fit_of_runs(const Fit& was, Fit fit) {
  fit.options = was.options;
  for (std::size_t k = 0; k < fit.phase.size(); ++k) fit.phase[k] += was.phase[k];
  fit.chance = was.chance;
  for (const std::vector<double>& values : fit.channels->fitted) {
    auto& force = fit.fitted.emplace_back(values.size() / 3);
    for (std::size_t i = 0; i < values.size(); ++i) force[i / 3][i % 3] = values[i];
  }
  fit.channels->fitted.clear();
  return fit;
}

/// What the answer so far is: the fit of the runs, with its phases and runout.
struct Base {
  Fit fit;
  std::optional<Fit> best;  ///< of the channels, near it; empty: nothing more was told
  ChannelRequest request;
};

Base base_of(const Fit& fit) {
  return {.fit = fit,
          .best = std::nullopt,
          .request = {.chip_model = fit.chip.model,
                      .runout = fit.options.runout,
                      .fit_channel_offsets = fit.options.fit_channel_offsets,
                      .near_given = true}};
}

/// @brief Radial and axial offsets looked for together and from far away, where more than
/// noise is left or a tilt had to help: what fits best without axial offsets may lie in
/// another valley.
/// @return the base of the valley that was found, if it explains clearly more, or as much
///         without the tilt
std::optional<Base> other_valley(const cases::Case& given, const IdentifyResult& r,
                                 const Base& near) {
  const geometry::Cutter& cutter = given.setup.cutter;
  const bool of_offsets = identification::finds_offsets(near.request.runout) &&
                          !identification::finds_eccentricity(near.request.runout);
  if (!has_a_corner(cutter) || !of_offsets) return std::nullopt;
  const bool instead = rings(near.fit);
  const bool tilted = near.request.tilt;
  if (near.best && !tilted &&
      identification::leaves_noise_alone(r.runs,
                                         as_fit_of_runs(near.fit, *near.best))) {
    return std::nullopt;
  }
  force::Setup setup = given.setup;
  setup.runout = near.fit.runout;
  setup.cut = r.runs.front().cut;
  const Fit before =
      near.best ? *near.best
                : identification::fit_channels(setup, near.fit.law, table(),
                                               data_of(r, near.fit), near.request);
  Base out = near;
  std::ranges::fill(out.fit.phase, 0.0);
  out.request.axial_offsets = true;
  out.request.tilt = false;
  out.request.near_given = false;
  Fit found = identification::fit_channels(setup, near.fit.law, table(),
                                           data_of(r, out.fit), out.request);
  const bool better = tilted ? !explains_more(found, before, 2.0)
                             : explains_more(before, found, cutter.teeth() - 1.0);
  if (!tells_axial_offsets(found, setup.cut.f_z) || !better) {
    return std::nullopt;
  }
  // In place of resonances only where nothing is left for them.
  if (instead &&
      !identification::leaves_noise_alone(r.runs, as_fit_of_runs(out.fit, found))) {
    return std::nullopt;
  }
  out.request.near_given = true;
  out.fit.phase = found.phase;
  out.fit.runout = found.runout;
  setup.runout = found.runout;
  out.best = identification::fit_channels(setup, near.fit.law, table(),
                                          data_of(r, out.fit), out.request);
  return out;
}

/// Axial offsets and tilt added where they are told, each from where the last one ended.
Base near_the_answer(const cases::Case& given, const IdentifyResult& r,
                     const Fit& fit) {
  const std::vector<ChannelData> data = data_of(r, fit);
  Base out = base_of(fit);
  force::Setup setup = given.setup;
  setup.runout = fit.runout;
  setup.cut = data.front().cut;
  const double radius = 0.5 * setup.cutter.profile.D;
  for (const bool tilt : {false, true}) {
    if (!tilt && !has_a_corner(setup.cutter)) continue;
    ChannelRequest more = out.request;
    (tilt ? more.tilt : more.axial_offsets) = true;
    const auto told =
        identification::further_unknowns(setup, fit.law, table(), data, more);
    if (!are_told(told, tilt, setup.cut.f_z, radius)) continue;
    const Fit before = out.best ? *out.best
                                : identification::fit_channels(setup, fit.law, table(),
                                                               data, out.request);
    Fit with = identification::fit_channels(setup, fit.law, table(), data, more);
    const double unknowns = tilt ? 2.0 : given.setup.cutter.teeth() - 1.0;
    if (!explains_more(before, with, unknowns)) continue;
    out.request = more;
    setup.runout = with.runout;
    out.best = std::move(with);
  }
  return out;
}

}  // namespace

bool asks_for_more_runout(const cases::Case& given) {
  return !given.identify.runout && given.setup.cutter.teeth() > 1 &&
         (has_a_corner(given.setup.cutter) || turns_far(given.setup));
}

std::optional<Fit> fit_with_more_runout(const cases::Case& given,
                                        const IdentifyResult& r, const Fit& fit) {
  if (!may_tell_more(given, r, fit)) return std::nullopt;
  Base base = rings(fit) ? base_of(fit) : near_the_answer(given, r, fit);
  if (auto other = other_valley(given, r, base)) base = *std::move(other);
  if (!base.best) return std::nullopt;
  force::Setup setup = given.setup;
  setup.runout = base.best->runout;
  setup.cut = r.runs.front().cut;
  Fit found = as_fit_of_runs(base.fit, *std::move(base.best));
  base.request.widening = identification::interval_widening(
      r.runs, found.fitted, static_cast<int>(found.found.unknowns.size()));
  if (base.request.widening < worth_widening) return found;
  return as_fit_of_runs(
      base.fit, identification::fit_channels(setup, fit.law, table(),
                                             data_of(r, base.fit), base.request));
}

}  // namespace trochoid::run
