#include <trochoid/run/commands.h>

#include <trochoid/base/units.h>
#include <trochoid/identification/fit.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/run/identify.h>
#include <trochoid/run/wall.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace trochoid::run {

namespace {

using identification::Knowledge;
using results::PlanResult;
using results::PlanWallResult;
using surface::WallTrial;

/// Of the peak force of [cut], where nothing else tells the noise.
constexpr double assumed_force_noise = 0.02;
/// Of a mean of a channel in [cut], likewise.
constexpr double assumed_mean_noise = 0.01;
/// Freedom of standard deviations that are stated.
constexpr double well_known = 1e6;

std::vector<geometry::Engagement> planned_engagements(const cases::Plan& plan) {
  std::vector<geometry::Engagement> out;
  for (const cases::PlannedEngagement kind : plan.engagements) {
    if (kind == cases::PlannedEngagement::slot) {
      out.emplace_back(geometry::Slot{});
      continue;
    }
    for (const double a_e : plan.radial_depths) {
      if (kind == cases::PlannedEngagement::up) {
        out.emplace_back(geometry::UpMilling{a_e});
      } else {
        out.emplace_back(geometry::DownMilling{a_e});
      }
    }
  }
  return out;
}

/// Every combination that is to be looked at.
identification::CutRequest request_of(const cases::Case& given) {
  const cases::Plan& plan = given.plan;
  identification::CutRequest out{
      .cuts = {}, .quantities = plan.quantities, .max_force = plan.max_force};
  for (const geometry::Engagement& engagement : planned_engagements(plan)) {
    for (const double a_p : plan.axial_depths) {
      for (const double f_z : plan.feeds) {
        out.cuts.push_back({engagement, a_p, f_z, given.setup.cut.Omega});
      }
    }
  }
  return out;
}

void warn_of_untold(const Knowledge& known, PlanResult& r) {
  if (const auto untold = identification::untold_coefficients(known); !untold.empty()) {
    r.heading.warnings.push_back(
        {"not_planned",
         fmt::format("No cut tells {} by the channels that are measured: they are left "
                     "out.",
                     fmt::join(untold, ", "))});
  }
}

/// What the measurements tell.
/// @return why nothing can be planned from them; empty: it can
std::string learn_from_records(const cases::Case& given, const Progress& progress,
                               Knowledge& known, PlanResult& r) {
  const results::IdentifyResult found = identify(given, progress);
  r.heading.warnings = found.heading.warnings;
  if (!found.chosen) {
    return "the measurements so far have no answer to start from: " +
           found.heading.message;
  }
  if (!found.reasons_against.empty()) {
    return "the measurements so far give no numbers to plan with. " +
           identification::do_not_use(found.reasons_against);
  }
  const identification::Fit& fit = found.fits[*found.chosen];
  known = identification::knowledge_of(given.setup, given.law, found.runs, fit);
  if (fit.groups.size() > 1) {
    r.group = identification::label_of_group(fit.groups.back().name);
  }
  warn_of_untold(known, r);
  r.noise_from = "records";
  for (const results::RecordSummary& record : found.records) {
    r.files.push_back(record.file);
  }
  r.factor_before = fit.interval_factor;
  return "";
}

void warn_nothing_measured(PlanResult& r) {
  r.heading.warnings.push_back(
      {"nothing_measured",
       "The case has no measurement: cuts are compared as if each were the first, "
       "about the coefficients and the runout of the case."});
}

void start_from_coefficients(const cases::Case& given, Knowledge& known,
                             PlanResult& r) {
  identification::Trial& trial = known.trial;
  trial = {.setup = given.setup,
           .law = given.law,
           .options = fit_options(given, given.setup.chip.model),
           .samples_per_turn = given.plan.samples_per_rev};
  trial.noise = assumed_force_noise * identification::peak_in_plane(trial);
  r.noise_from = "assumed";
  warn_nothing_measured(r);
}

/// A channel as files name it.
std::string text_of(const force::Channel& channel) {
  return (channel.sign < 0 ? "-" : "") + std::string(force::name_of(channel.axis));
}

/// Whether means of channels are planned: they were measured, or there is a power meter alone.
bool plans_means(const cases::Case& given) {
  if (!given.identify.by_channels || !given.dynamometer) return false;
  const auto& channels = given.dynamometer->sensor.channels;
  const auto is_power = [](const force::Channel& one) {
    return one.axis == force::ChannelAxis::power;
  };
  return !channels.empty() &&
         (!given.measurements.empty() || std::ranges::all_of(channels, is_power));
}

/// What the case or its means say of the standard deviation of the next mean.
std::vector<double> sd_of_means(const cases::Case& given,
                                const identification::Trial& trial, PlanResult& r) {
  const std::size_t channels = given.dynamometer->sensor.channels.size();
  std::vector<double> sd(channels, 0.0);
  double count = 0.0;
  for (const cases::Measurement& m : given.measurements) {
    if (m.mean_sd.empty()) continue;
    count += 1.0;
    for (std::size_t k = 0; k < channels; ++k) sd[k] += m.mean_sd[k];
  }
  r.noise_from = "records";
  if (count > 0.0) {
    for (double& s : sd) s /= count;
    return sd;
  }
  r.noise_from = "given";
  if (!given.dynamometer->channel_sd.empty()) return given.dynamometer->channel_sd;
  r.noise_from = "assumed";
  const std::vector<double> K = force::coefficients(trial.law);
  const std::vector<double> columns =
      force::channel_means(trial.setup, trial.law, given.dynamometer->sensor, 1e-6);
  for (std::size_t k = 0; k < channels; ++k) {
    double mean = 0.0;
    for (std::size_t c = 0; c < K.size(); ++c) mean += columns[k * K.size() + c] * K[c];
    sd[k] = std::max(assumed_mean_noise * std::abs(mean), 1e-9);
  }
  return sd;
}

/// Coefficients by the means and the prior, and what both tell (I-30).
/// @return why nothing can be planned from them; empty: it can
std::string learn_from_means(const cases::Case& given, const Progress& progress,
                             Knowledge& known, PlanResult& r) {
  identification::Trial& trial = known.trial;
  trial = {.setup = given.setup,
           .law = given.law,
           .options = fit_options(given, given.setup.chip.model),
           .samples_per_turn = given.plan.samples_per_rev};
  trial.options.runout = identification::RunoutUnknowns::fixed;
  trial.options.fit_exponents = false;
  r.factor_before = base::normal_interval;
  if (given.measurements.empty()) {
    warn_nothing_measured(r);
  } else {
    const results::IdentifyResult found = identify(given, progress);
    r.heading.warnings = found.heading.warnings;
    if (!found.chosen) {
      return "the means so far have no answer to start from: " + found.heading.message;
    }
    const identification::Fit& fit = found.fits[*found.chosen];
    std::vector<double> K;
    for (const auto& one : fit.coefficients) K.push_back(one ? one->value : 0.0);
    trial.law = force::with_coefficients(fit.law, K);
    trial.setup.chip = fit.chip;
    r.factor_before = fit.interval_factor;
  }
  trial.means = {given.dynamometer->sensor, {}};
  trial.means->sd = sd_of_means(given, trial, r);
  const auto size =
      identification::parameter_names(trial.setup, trial.law, trial.options).size();
  known.information = identification::information_of(given.identify.prior, size);
  for (const cases::Measurement& m : given.measurements) {
    identification::Trial one = trial;
    one.setup.cut = m.cut;
    if (!m.mean_sd.empty()) one.means->sd = m.mean_sd;
    known.information = sum(known.information, information_of(one));
  }
  known.freedom = well_known;
  for (const auto& channel : trial.means->sensor.channels) {
    r.channels.push_back(text_of(channel));
  }
  r.mean_sd = trial.means->sd;
  warn_of_untold(known, r);
  return "";
}

PlanResult no_plan(PlanResult r, const std::string& why) {
  r.heading.ok = false;
  r.heading.message = why;
  return r;
}

/// @return whether there is a cut to recommend
bool take_plan(identification::CutPlan plan, PlanResult& r) {
  r.quantities = std::move(plan.quantities);
  r.cuts = std::move(plan.cuts);
  r.left_out = std::move(plan.left_out);
  r.parameters = plan.parameters;
  r.log_determinant = plan.log_determinant;
  r.factor_after = plan.factor;
  return !r.cuts.empty();
}

/// Of a reading where nothing tells the noise: a good measuring machine [m].
constexpr double assumed_reading_noise = 1.0 * unit::um;

WallTrial trial_of(const cases::Case& given) {
  WallTrial trial{.setting = wall_setting(given),
                  .feedback = wall_feedback(given),
                  .form = given.plan.wall.form.value_or(surface::PlannedForm::offset),
                  .noise = assumed_reading_noise};
  trial.setting.bodies =
      surface::bodies_solved_once(wall_dimensions(given), given.setup.cut.a_p);
  return trial;
}

/// @return why nothing can be told from what was measured; empty: it can
std::string learn_from_readings(const cases::Case& given, WallTrial& trial,
                                std::vector<surface::Reading>& measured,
                                PlanWallResult& r) {
  MeasuredWall wall = measured_wall(given);
  trial.setting.setup.runout.eccentricity = 0.0;
  const surface::Calibration c =
      surface::calibrate(trial.setting, wall.readings, wall.datum, wall_fit(given));
  if (!c.ok) {
    return "the readings tell no coefficients to plan from: " + c.message;
  }
  trial = surface::expected_after(std::move(trial), c);
  measured = std::move(wall.readings);
  r.noise_from = "readings";
  r.measured = measured.size();
  for (const cases::SurfaceMeasurement& m : given.machine.surface_measurements) {
    r.files.push_back(m.source.file.path);
  }
  return "";
}

/// Coefficients, runout and noise.
/// @return why there is no plan about these; empty: there is
std::string settle_expectation(const cases::Case& given, WallTrial& trial,
                               std::vector<surface::Reading>& measured,
                               PlanWallResult& r) {
  auto& offsets = trial.setting.setup.runout.radial_offsets;
  if (std::any_of(offsets.begin(), offsets.end(), [](double s) { return s != 0; })) {
    r.heading.warnings.push_back(
        {"offsets_not_used",
         "[runout] radial_offsets_mm are not used: a wall tells an eccentricity."});
  }
  offsets.clear();
  r.noise_from = "assumed";
  if (!given.machine.surface_measurements.empty()) {
    if (std::string why = learn_from_readings(given, trial, measured, r);
        !why.empty()) {
      return why;
    }
  }
  if (given.plan.wall.noise) {
    trial.noise = *given.plan.wall.noise;
    r.noise_from = "given";
  }
  const std::vector<double> K = force::coefficients(trial.setting.law);
  if (!(K[0] > 0.0) || !(K[1] > 0.0)) {
    return "a plan needs a tangential and a radial cutting coefficient above 0, as "
           "expected: values of a similar material are enough";
  }
  if (!(trial.noise > 0.0)) {
    return "the readings have no noise to plan by: give noise_um";
  }
  return "";
}

/// Of what more might be cut; empty: nothing.
std::string at_the_edge(const surface::PlannedCutting& c) {
  if (!c.best) return {};
  const bool feed = c.cells[*c.best].f_z == c.feeds.back();
  const bool depth = c.cells[*c.best].a_e == c.radial_depths.back();
  return feed && depth ? "larger feeds or radial depths"
         : feed        ? "larger feeds"
         : depth       ? "larger radial depths"
                       : "";
}

void warn_of_readings(double shortfall, PlanWallResult& r) {
  auto& warnings = r.heading.warnings;
  if (!r.why_no_runout.empty()) {
    warnings.push_back(
        {"no_runout_seen",
         fmt::format("No way to measure shows the runout: {}.", r.why_no_runout)});
  }
  if (r.designs[*r.chosen].enough) return;
  warnings.push_back(
      {"not_enough",
       !std::isfinite(shortfall)
           ? "No way to measure tells the runout: readings at more places along the "
             "feed might."
           : fmt::format(
                 "The best way to measure is {:.2g} times too wide: it takes some "
                 "{:.3g} times as many readings, or a cut that tells more.",
                 shortfall, shortfall * shortfall)});
}

void warn_of_cutting(const cases::Case& given, PlanWallResult& r) {
  const auto add = [&](const char* code, std::string message) {
    r.heading.warnings.push_back({code, std::move(message)});
  };
  if (!r.cutting.limit) {
    add("no_error_limit",
        "[plan] has no largest_error_um: the map has no limit, and no cut is named.");
  }
  if (const std::string more = at_the_edge(r.cutting); !more.empty()) {
    add("edge_of_map", "The best cut lies at the edge of the map: " + more +
                           " may keep the error as well.");
  }
  const auto left_out = std::count_if(r.cutting.cells.begin(), r.cutting.cells.end(),
                                      [](const auto& cell) { return !cell.ok; });
  if (left_out > 0) {
    add("no_steady_state",
        fmt::format("{} of {} cuts of the map have no steady state: the deflection "
                    "does not settle.",
                    left_out, r.cutting.cells.size()));
  }
  const cases::Wall* wall = given.machine.wall ? &*given.machine.wall : nullptr;
  if (wall != nullptr && r.cutting.stated.peak > wall->thickness / 2) {
    add("thick_deflection",
        "The error of the stated cut is more than half of the wall's thickness: a "
        "thin plate bends in proportion to the force only below that.");
  }
}

/// Which readings, and what they tell of other cuts and walls.
/// @return why there are none; empty: there are
std::string compare_readings(const cases::Case& given, const WallTrial& trial,
                             std::span<const surface::Reading> measured,
                             const Progress& progress, PlanWallResult& r) {
  const cases::WallPlan& plan = given.plan.wall;
  progress("Comparing readings");
  surface::ReadingsPlan found = surface::plan_readings(
      trial,
      surface::wall_designs(plan.spreads, plan.heights, plan.per_height,
                            trial.setting.setup.cutter.teeth()),
      {r.wanted, r.wanted_runout}, measured, wall_position(given));
  r.why_no_runout = std::move(found.why_no_runout);
  r.designs = std::move(found.designs);
  r.chosen = found.chosen;
  r.so_far = found.so_far;
  r.more = std::move(found.more);
  if (!r.chosen) {
    return fmt::format(
        "none of the ways to measure tells the coefficients apart: cut deeper or wider, "
        "with a helix{}",
        trial.form == surface::PlannedForm::none
            ? ""
            : ", or see to it that less of the form of the readings is unknown");
  }
  warn_of_readings(found.shortfall, r);
  progress("Other cuts and walls");
  r.changes =
      surface::plan_changes(trial, r.designs[*r.chosen].design, wall_dimensions(given));
  return "";
}

/// @return why there is no plan; empty: there is one
std::string make_plan(const cases::Case& given, const Progress& progress,
                      PlanWallResult& r) {
  WallTrial trial = trial_of(given);
  std::vector<surface::Reading> measured;
  if (std::string why = settle_expectation(given, trial, measured, r); !why.empty()) {
    return why;
  }
  r.law = trial.setting.law;
  r.eccentricity = trial.setting.setup.runout.eccentricity;
  r.noise = trial.noise;
  try {
    if (std::string why = compare_readings(given, trial, measured, progress, r);
        !why.empty()) {
      return why;
    }
  } catch (const std::domain_error& error) {
    return error.what();
  }
  progress("Mapping the error over feed and radial depth");
  const cases::WallPlan& plan = given.plan.wall;
  r.cutting = surface::plan_cutting(trial.setting, wall_dimensions(given),
                                    {.feeds = given.plan.feeds,
                                     .radial_depths = given.plan.radial_depths,
                                     .feedback = trial.feedback,
                                     .mean = plan.limited == cases::LimitedError::mean,
                                     .limit = plan.largest_error});
  warn_of_cutting(given, r);
  return "";
}

}  // namespace

namespace {

/// What is known, and how exact the next measurement is.
/// @return why nothing can be planned; empty: it can
std::string learn(const cases::Case& given, const Progress& progress, Knowledge& known,
                  PlanResult& r) {
  if (plans_means(given)) return learn_from_means(given, progress, known, r);
  if (given.measurements.empty()) {
    start_from_coefficients(given, known, r);
  } else if (std::string why = learn_from_records(given, progress, known, r);
             !why.empty()) {
    return why;
  }
  known.trial.samples_per_turn = given.plan.samples_per_rev;
  known.trial.turns = given.plan.turns;
  known.trial.noise = given.plan.noise.value_or(known.trial.noise);
  if (given.plan.noise) r.noise_from = "given";
  r.noise = known.trial.noise;
  return r.noise > 0.0
             ? ""
             : "there is neither force nor noise to compare cuts by: give noise_N";
}

}  // namespace

PlanResult plan(const cases::Case& given, const Progress& progress) {
  PlanResult r;
  r.heading = heading_of(given);
  r.diameter = given.setup.cutter.profile.D;
  r.turns = given.plan.turns;
  r.samples_per_rev = given.plan.samples_per_rev;
  Knowledge known;
  if (const std::string why = learn(given, progress, known, r); !why.empty()) {
    return no_plan(std::move(r), why);
  }
  const identification::CutRequest request = request_of(given);
  progress("comparing cuts");
  const bool found = take_plan(identification::next_cut(known, request), r);
  if (r.quantities.empty()) {
    return no_plan(std::move(r),
                   "none of the quantities of [plan] is looked for by the fit");
  }
  r.looked_at = request.cuts.size();
  if (!found) {
    return no_plan(std::move(r),
                   fmt::format("none of the {} cuts of [plan] can be recommended: {}",
                               request.cuts.size(), r.left_out.front().reason));
  }
  if (!given.plan.max_force) {
    r.heading.warnings.push_back(
        {"no_force_limit",
         "[plan] has no max_force_N: heavier cuts tell more as a rule, so that the best "
         "one is among the heaviest."});
  }
  r.heading.message = results::next_cut_sentence(r);
  return r;
}

PlanWallResult plan_wall(const cases::Case& given, const Progress& progress) {
  const cases::WallPlan& plan = given.plan.wall;
  PlanWallResult r;
  r.heading = heading_of(given);
  r.form = plan.form.value_or(surface::PlannedForm::offset);
  r.wanted = plan.wanted.value_or(10.0) / 100;
  r.wanted_runout = plan.wanted_runout.value_or(1.0 * unit::um);
  r.a_p = given.setup.cut.a_p;
  const std::string why = make_plan(given, progress, r);
  r.heading.ok = why.empty();
  r.heading.message = r.heading.ok ? results::wall_plan_sentence(r) : why;
  return r;
}

}  // namespace trochoid::run
