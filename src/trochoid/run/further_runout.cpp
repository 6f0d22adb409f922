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

/// Whether a record may tell more of the runout at all: one tool, all forces, a rigid
/// dynamometer, and more left than noise.
bool may_tell_more(const cases::Case& given, const IdentifyResult& r, const Fit& fit) {
  const bool all_forces =
      std::ranges::all_of(r.runs, [](const identification::Run& run) {
        return run.measured == std::array<bool, 3>{true, true, true};
      });
  return fit.ok && all_forces && fit.groups.size() < 2 &&
         fit.options.response.empty() && chip::feels_runout(fit.chip.model) &&
         !force::form(fit.law).power && asks_for_more_runout(given) &&
         !identification::leaves_noise_alone(r.runs, fit);
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

}  // namespace

bool asks_for_more_runout(const cases::Case& given) {
  return !given.identify.runout && given.setup.cutter.teeth() > 1 &&
         (has_a_corner(given.setup.cutter) || turns_far(given.setup));
}

std::optional<Fit> fit_with_more_runout(const cases::Case& given,
                                        const IdentifyResult& r, const Fit& fit) {
  if (!may_tell_more(given, r, fit)) return std::nullopt;
  const std::vector<ChannelData> data = data_of(r, fit);
  force::Setup setup = given.setup;
  setup.runout = fit.runout;
  setup.cut = data.front().cut;
  ChannelRequest request{.chip_model = fit.chip.model,
                         .runout = fit.options.runout,
                         .fit_channel_offsets = fit.options.fit_channel_offsets,
                         .near_given = true};
  std::optional<Fit> best;
  const double radius = 0.5 * setup.cutter.profile.D;
  for (const bool tilt : {false, true}) {
    if (!tilt && !has_a_corner(setup.cutter)) continue;
    ChannelRequest more = request;
    (tilt ? more.tilt : more.axial_offsets) = true;
    const auto told =
        identification::further_unknowns(setup, fit.law, table(), data, more);
    if (!are_told(told, tilt, setup.cut.f_z, radius)) continue;
    if (!best) {
      best = identification::fit_channels(setup, fit.law, table(), data, request);
    }
    Fit with = identification::fit_channels(setup, fit.law, table(), data, more);
    const double unknowns = tilt ? 2.0 : given.setup.cutter.teeth() - 1.0;
    if (!explains_more(*best, with, unknowns)) continue;
    request = more;
    setup.runout = with.runout;
    best = std::move(with);
  }
  if (!request.axial_offsets && !request.tilt) return std::nullopt;
  Fit found = as_fit_of_runs(fit, *std::move(best));
  request.widening = identification::interval_widening(
      r.runs, found.fitted, static_cast<int>(found.found.unknowns.size()));
  if (request.widening < worth_widening) return found;
  return as_fit_of_runs(
      fit, identification::fit_channels(setup, fit.law, table(), data, request));
}

}  // namespace trochoid::run
