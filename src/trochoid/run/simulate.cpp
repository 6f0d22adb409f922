#include <trochoid/run/simulate.h>

#include <trochoid/base/units.h>
#include <trochoid/force/closed_form.h>
#include <trochoid/run/commands.h>
#include <trochoid/run/records.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace trochoid::run {

namespace {

using Warnings = std::vector<base::Warning>;

/// A removed volume this much above what there is means a wrong chip model.
constexpr double volume_slack = 1e-3;

void warn_heights(const cases::Case& given, Warnings& warnings) {
  for (const double z : given.sampling.edge_heights) {
    if (z > given.setup.cut.a_p) {
      warnings.push_back(
          {"height_above_cut",
           fmt::format("edge_heights_mm: {:g} mm lies above the axial depth; the chip "
                       "there is what a deeper cut would give.",
                       z / unit::mm)});
    }
  }
}

/// @param serrated  at a height one tooth cuts, and another one higher up: as it should be
void warn_idle_teeth(const force::Engagement& engagement, bool serrated,
                     Warnings& warnings) {
  const auto idle = [](const force::ToothEngagement& tooth) {
    return tooth.arcs.empty();
  };
  if (std::all_of(engagement.teeth.begin(), engagement.teeth.end(), idle)) {
    warnings.push_back(
        {"no_cut", fmt::format("No tooth cuts anything at {:g} mm above the tip.",
                               engagement.height / unit::mm)});
    return;
  }
  if (serrated) return;
  for (std::size_t j = 0; j < engagement.teeth.size(); ++j) {
    if (idle(engagement.teeth[j])) {
      warnings.push_back(
          {"idle_tooth",
           fmt::format("Tooth {} cuts nothing at {:g} mm above the tip: the runout "
                       "keeps it behind what the others leave.",
                       j + 1, engagement.height / unit::mm)});
    }
  }
}

/// The chips of a turn against the material there is (C-8).
void warn_volume(const cases::Case& given, const chip::Removal& removal,
                 Warnings& warnings) {
  if (removal.available <= 0) {
    return;
  }
  const double ratio = removal.removed / removal.available;
  if (std::abs(ratio - 1) > volume_slack) {
    const chip::ChipModel& model = given.setup.chip;
    const bool exact =
        model.model == chip::Model::trochoidal && model.lookback == chip::Lookback::all;
    warnings.push_back(
        {"volume",
         fmt::format(
             "The chips of one turn add up to {:.4f} times the feed times the width "
             "of cut. {}",
             ratio,
             exact ? "At this feed the cusps between the turns are no longer small."
                   : "Only model = \"trochoidal\" with lookback = \"all\" conserves "
                     "the material.")});
  }
}

/// Whether the samples are of turns, and not of a part of one.
bool whole_turns(const cases::Sampling& sampling) {
  return sampling.angles.empty() &&
         sampling.revolutions == std::floor(sampling.revolutions);
}

}  // namespace

std::vector<double> sampled_angles(const cases::Sampling& sampling) {
  if (!sampling.angles.empty()) {
    return sampling.angles;
  }
  const auto count = static_cast<std::size_t>(
      std::max(1L, std::lround(sampling.samples_per_rev * sampling.revolutions)));
  std::vector<double> phi(count);
  for (std::size_t i = 0; i < count; ++i) {
    phi[i] = sampling.start +
             static_cast<double>(i) * (360.0 / sampling.samples_per_rev) * unit::deg;
  }
  return phi;
}

std::vector<results::Comparison> compare(const cases::Case& given,
                                         std::vector<base::Warning>& warnings) {
  if (given.identify.by_channels) {
    warnings.push_back(
        {"not_compared",
         "Measurements are compared where the channels are forces in x, y "
         "and z; identify fits any channels."});
    return {};
  }
  const auto measured = measured_runs(given, warnings);
  if (given.dynamometer && given.dynamometer->automatic) {
    warnings.push_back(
        {"not_compared",
         "axes = \"auto\" needs an identification; name the axes to compare here."});
    return {};
  }
  for (const MeasuredRun& one : measured) {
    if (!std::ranges::all_of(one.run.measured, std::identity())) {
      warnings.push_back({"not_compared", one.file +
                                              ": not all three channels were measured; "
                                              "identify fits such a record."});
      return {};
    }
  }
  const auto runs = identification::on_tool(
      channels_of(measured), given.dynamometer.value_or(cases::Dynamometer{}).matrix);
  std::vector<results::Comparison> all;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    all.push_back(
        {measured[r].file, runs[r], measured[r].Omega,
         identification::match_phase(given.setup, given.law, runs[r],
                                     given.identify.phase, given.sampling.tolerance)});
  }
  return all;
}

namespace {

/// What named channels read, at each angle and in the mean.
void add_channels(const cases::Case& given, results::SimulateResult& r) {
  r.sensor = given.dynamometer->sensor;
  if (r.sensor.channels.empty()) return;
  const double tolerance = given.sampling.tolerance;
  const auto loads =
      force::six_loads(given.setup, given.law, r.phi, given.gauge_length, tolerance);
  r.channel_values = force::channel_values(r.sensor, loads, r.phi, r.Omega);
  const auto means = force::channel_means(given.setup, given.law, r.sensor, tolerance);
  const auto K = force::coefficients(given.law);
  for (std::size_t c = 0; c < r.sensor.channels.size(); ++c) {
    r.channel_means.push_back(
        std::inner_product(K.begin(), K.end(), &means[c * K.size()], 0.0));
  }
}

}  // namespace

results::SimulateResult simulate(const cases::Case& given, bool tables) {
  const force::Setup& setup = given.setup;
  const cases::Sampling& sampling = given.sampling;
  const double height = sampling.edge_heights.empty()
                            ? force::representative_height(setup)
                            : sampling.edge_heights.front();
  results::SimulateResult r{
      .heading = heading_of(given),
      .phi = sampled_angles(sampling),
      .Omega = setup.cut.Omega,
      .closed_form_mean = force::closed_form_mean(setup, given.law),
      .gauge_length = given.gauge_length,
      .engagement = force::engagement_at(setup, height)};
  r.loads =
      force::loads(setup, given.law, r.phi, given.gauge_length, sampling.tolerance);
  r.force = force::force_statistics(r.loads);
  if (whole_turns(sampling)) {
    const auto mean = force::mean_force(setup, given.law, sampling.tolerance);
    r.force.mean = mean.value_or(r.force.mean);
  }
  r.moments = force::moment_statistics(r.loads);
  if (given.dynamometer && !given.dynamometer->automatic) {
    r.channels = given.dynamometer->matrix;
    add_channels(given, r);
  }
  if (tables) {
    const std::vector<double> tip = {height};
    r.curve = force::chip_curve(setup, height);
    r.chips =
        force::chip_grid(setup, sampling.edge_angles,
                         sampling.edge_heights.empty() ? tip : sampling.edge_heights);
  }
  r.edges = force::edge_grid(setup, sampling.edge_heights);
  r.exact_mean = force::exact_mean(setup, given.law, sampling.tolerance);
  for (const double z : sampling.edge_heights) {
    r.at_heights.push_back(force::engagement_at(setup, z));
  }
  r.conserves = setup.chip.model == chip::Model::trochoidal;
  Warnings& warnings = r.heading.warnings;
  warn_heights(given, warnings);
  warn_idle_teeth(r.engagement, setup.cutter.serration.has_value(), warnings);
  warn_volume(given, r.engagement.removal, warnings);
  if (setup.cut.f_z == 0) {
    warnings.push_back({"zero_feed", "The feed is zero: nothing is cut."});
  }
  if (!given.measurements.empty()) {
    r.comparison = compare(given, warnings);
  }
  r.heading.message = results::simulation_sentence(r);
  return r;
}

}  // namespace trochoid::run
