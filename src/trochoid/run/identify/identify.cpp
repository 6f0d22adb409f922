#include <trochoid/run/identify/identify.h>
#include <trochoid/run/shared/heading.h>

#include <trochoid/base/units.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/run/identify/dynamometer.h>
#include <trochoid/run/identify/fit_options.h>
#include <trochoid/run/identify/fits.h>
#include <trochoid/run/identify/likely_causes.h>
#include <trochoid/run/identify/warnings.h>
#include <trochoid/run/shared/records.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

using identification::AxesChoice;
using identification::Fit;
using results::IdentifyResult;

/// A fit that leaves less of the force (rms) reads its channels rightly.
constexpr double too_good_to_doubt = 0.005;
/// Evaluations after which only what an answer needs is still computed: some ten seconds
/// of one core.
constexpr std::int64_t most_of_fits = 100'000'000;
/// One that leaves more may be of another cut.
constexpr double worth_a_look = 0.2;

std::optional<results::OffsetSweep> offset_sweep(
    const inputs::Case& given, std::span<const identification::Run> runs,
    const std::vector<Fit>& fits, const Progress& progress) {
  if (!given.identify.sweep) {
    return std::nullopt;
  }
  results::OffsetSweep sweep{.offset = base::values(*given.identify.sweep)};
  for (const Fit& fit : fits) {
    if (!fit.ok) {
      continue;
    }
    progress(fmt::format("sweeping the offset, {}", chip::name_of(fit.chip.model)));
    auto rms = identification::sweep(given.setup, given.law, runs, fit, sweep.offset);
    if (rms.size() == sweep.offset.size()) {
      sweep.curves.push_back({fit.chip.model, std::move(rms)});
    }
  }
  return sweep;
}

/// The record over one turn, in bins about as fine as its samples.
signal::OneRevolution folded(const identification::Run& run) {
  const double turns = std::abs(run.angle.back() - run.angle.front()) / unit::turn;
  if (run.angle.back() <= run.angle.front()) {
    return {};
  }
  const double per_turn = static_cast<double>(run.angle.size()) / std::max(turns, 1.0);
  std::array<std::vector<double>, 3> channels;
  for (const auto& F : run.force) {
    for (std::size_t q = 0; q < 3; ++q) {
      channels[q].push_back(F[q]);
    }
  }
  return signal::fold(channels, run.angle,
                      static_cast<int>(std::clamp(per_turn, 36.0, 360.0)));
}

std::vector<results::RecordSummary> summaries(
    const std::vector<MeasuredRun>& measured) {
  std::vector<results::RecordSummary> all;
  all.reserve(measured.size());
  for (const MeasuredRun& one : measured) {
    all.push_back(
        {one.file, one.run.angle.size(), one.Omega, one.Omega_se, one.run.cut.Omega});
  }
  return all;
}

/// A stated form of the runout that another one beats.
void warn_form(const std::optional<results::RunoutForm>& form,
               std::vector<base::Warning>& warnings) {
  if (form && form->stated && form->better != form->first) {
    warnings.push_back(
        {"runout_form",
         fmt::format(
             "Another form of the runout explains the record clearly better: {}. "
             "The coefficients are biased by it: try runout = \"{}\" or \"auto\" "
             "in [identify].",
             form->why, identification::name_of(form->better))});
  }
}

void warn_axes(const AxesChoice& axes, std::vector<base::Warning>& warnings) {
  if (!axes.signs_clear) {
    warnings.push_back(
        {"axes_signs",
         "Several readings of the channels fit the record equally well and were told "
         "apart by K_tc, K_rc, K_ac > 0, but these coefficients are not all clearly "
         "positive: check the axes of the dynamometer."});
  }
  if (axes.next_rms < 1.5 * axes.rms) {
    warnings.push_back(
        {"axes_close",
         fmt::format(
             "The next best reading of the channels is only {:.2f} times worse: "
             "check the axes of the dynamometer.",
             axes.next_rms / axes.rms)});
  }
}

/// The work on one case: what was read, and what is known of it so far.
struct Identification {
  const inputs::Case& given;
  const Progress& progress;
  base::Stop stop;
  std::vector<MeasuredRun> measured = {};
  std::vector<std::string> left_out = {};  ///< what there was no time for
  IdentifyResult r = {};

  /// What the reader of the records noted is less urgent than what the fit says.
  void put_notes_last() {
    std::stable_partition(r.heading.warnings.begin(), r.heading.warnings.end(),
                          [](const base::Warning& warning) {
                            return warning.code != "part_of_record" &&
                                   warning.code != "part_used" &&
                                   warning.code != "unit_assumed" &&
                                   warning.code != "last_row_left_out";
                          });
  }

  IdentifyResult failed(const std::string& why) {
    put_notes_last();
    r.heading.ok = false;
    r.heading.message = why;
    return std::move(r);
  }

  void add_causes() {
    if (stop.wanted()) {
      left_out.emplace_back("the search for likely causes");
      return;
    }
    const auto causes = likely_causes(given, measured, r.channels, progress);
    auto& warnings = r.heading.warnings;
    const bool after_verdict =
        !warnings.empty() && warnings.front().code == "do_not_use";
    warnings.insert(warnings.begin() + (after_verdict ? 1 : 0), causes.begin(),
                    causes.end());
  }

  /// @return why there are no axes; empty: there are
  std::string find_axes() {
    const inputs::Dynamometer dynamometer =
        given.dynamometer.value_or(inputs::Dynamometer{});
    r.channels = dynamometer.matrix;
    if (!dynamometer.automatic) {
      return "";
    }
    const AxesChoice axes =
        identification::find_axes(axes_problem(given), channels_of(measured),
                                  [&](double part) { progress(axes_progress(part)); });
    if (!axes.ok) {
      if (std::isfinite(axes.rms)) {
        add_causes();
      }
      return axes.message;
    }
    warn_axes(axes, r.heading.warnings);
    r.channels = axes.matrix;
    r.axes = axes;
    return "";
  }

  /// Warnings, and before everything else whether the numbers may be used at all.
  void judge() {
    const Fit& chosen = r.fits[*r.chosen];
    r.reasons_against = identification::reasons_against(chosen);
    add_fit_warnings(given, r.fits, chosen, r.heading.warnings);
    warn_form(r.runout_form, r.heading.warnings);
    if (!r.reasons_against.empty()) {
      r.heading.warnings.insert(
          r.heading.warnings.begin(),
          {"do_not_use", identification::do_not_use(r.reasons_against)});
      add_causes();
    } else if (chosen.unexplained.in_band > too_good_to_doubt && stop.wanted()) {
      left_out.emplace_back("a look at other readings of the channels");
    } else if (chosen.unexplained.in_band > too_good_to_doubt) {
      const auto found = look_at_channels(given, measured, r.channels, progress);
      auto& warnings = r.heading.warnings;
      warnings.insert(warnings.begin(), found.begin(), found.end());
      if (chosen.unexplained.in_band > worth_a_look) {
        const auto other = look_at_cut(given, measured, r.channels);
        warnings.insert(warnings.begin(), other.begin(), other.end());
      }
    }
    if (r.reasons_against.empty()) {
      r.reasons_for_care = reasons_for_care(r.heading.warnings);
    }
    r.heading.message = results::identification_sentence(r);
    put_notes_last();
    add_left_out();
  }

  /// What there was no time for is said after the verdict.
  void add_left_out() {
    if (left_out.empty()) return;
    auto& warnings = r.heading.warnings;
    const bool after_verdict =
        !warnings.empty() && warnings.front().code == "do_not_use";
    warnings.insert(
        warnings.begin() + (after_verdict ? 1 : 0),
        stop.spent()
            ? base::Warning{"work_limit", fmt::format("These records take much work; "
                                                      "--anyway does also: {}.",
                                                      fmt::join(left_out, "; "))}
            : base::Warning{"time_limit", fmt::format("The time was up, left out: {}.",
                                                      fmt::join(left_out, "; "))});
  }

  void add_curves() {
    force::Setup setup = given.setup;
    setup.chip = r.fits[*r.chosen].chip;
    setup.runout = r.fits[*r.chosen].runout;
    r.curve = force::chip_curve(setup, force::representative_height(setup));
    for (const identification::Run& run : r.runs) {
      r.folded.push_back(folded(run));
    }
    if (given.identify.sweep && stop.wanted()) {
      left_out.emplace_back("sweep_um");
    } else {
      r.sweep = offset_sweep(given, r.runs, r.fits, progress);
    }
  }

  /// What the eccentricity of the chosen fit means at the machine.
  void add_clocking() {
    const Fit& fit = r.fits[*r.chosen];
    if (!fit.eccentricity_se || !fit.angle_se) return;
    const double rho = fit.runout.eccentricity;
    const double lambda = fit.runout.angle;
    results::Clocking c{.present = {{rho * std::cos(lambda), rho * std::sin(lambda)},
                                    fit.eccentricity_covariance},
                        .height = 0.5 * given.setup.cut.a_p};
    c.longest_tooth =
        identification::longest_tooth(given.setup.cutter, fit.runout, c.height);
    if (const auto& before = given.identify.previous_clamping) {
      c.separation = identification::separate(
          identification::offset_of(
              before->eccentricity, before->angle,
              before->eccentricity_se.value_or(*fit.eccentricity_se),
              before->angle_se.value_or(*fit.angle_se)),
          c.present, before->turned);
      if (!given.identify.phase &&
          geometry::equally_pitched(given.setup.cutter.pitch)) {
        r.heading.warnings.push_back(
            {"teeth_renumbered",
             "previous_clamping: with phase_deg = \"free\" the fit chooses which of the "
             "equal teeth is tooth 1. If that is another one than before, what is said "
             "of tool and holder is wrong: give phase_deg as a number."});
      }
    }
    r.clocking = c;
  }

  IdentifyResult answer() {
    r.heading = heading_of(given);
    r.edge_length = given.setup.edge_length;
    progress("reading the measurements");
    measured = measured_runs(given, r.heading.warnings);
    if (const std::string why = find_axes(); !why.empty()) {
      return failed(why);
    }
    r.runs = identification::on_tool(channels_of(measured), r.channels);
    r.records = summaries(measured);
    for (MeasuredRun& one : measured) r.overviews.push_back(std::move(one.overview));
    Known known{std::nullopt,
                measured_responses(given, r.runs, r.channels, r.heading.warnings)};
    if (r.axes) known.start = r.axes->start;
    Fits found = all_fits(given, r.runs, known, progress, stop);
    r.fits = std::move(found.fits);
    r.views = std::move(found.views);
    r.runout_form = std::move(found.runout_form);
    left_out = std::move(found.left_out);
    r.chosen = chosen_fit(r.fits);
    if (!r.chosen) {
      if (r.fits.back().rms > 0) {  // equations that could be solved, to no avail
        add_causes();
      }
      return failed(r.fits.back().message);
    }
    add_curves();
    add_clocking();
    judge();
    return std::move(r);
  }
};

}  // namespace

IdentifyResult identify(const inputs::Case& given, const Progress& progress,
                        base::Stop stop) {
  if (stop.left == nullptr) {
    stop.left = std::make_shared<std::atomic<std::int64_t>>(most_of_fits);
    stop.grace = most_of_fits;
  }
  return Identification{given, progress, std::move(stop)}.answer();
}

}  // namespace trochoid::run
