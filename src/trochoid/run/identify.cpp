#include <trochoid/run/identify.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/fits.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/identification/resonance.h>
#include <trochoid/run/commands.h>
#include <trochoid/run/records.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

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
    const cases::Case& given, std::span<const identification::Run> runs,
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
void warn_form(const std::optional<identification::RunoutForm>& form,
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

/// A reading that leaves less, but with signs that no cut has.
base::Warning passed_over(const AxesChoice& axes, const force::Law& law) {
  const identification::PassedOver& other = *axes.passed_over;
  const auto names = signal::axes_names(other.matrix);
  const auto K = force::coefficient_quantities(law);
  std::vector<std::string> values;
  for (std::size_t q = 0; q < other.K.size(); ++q) {
    values.push_back(fmt::format("{} {:.4g}", K[q].key, other.K[q] / K[q].unit));
  }
  return {
      "axes_by_signs",
      fmt::format("Read as {}, {}, {} of the force on the tool the channels would "
                  "leave {:.2f} times less, but with {}, which no cut has: the "
                  "reading that was chosen has the signs of a cut. Check the axes of "
                  "the dynamometer.",
                  names[0], names[1], names[2], axes.rms / other.rms,
                  fmt::join(values, ", "))};
}

void warn_axes(const AxesChoice& axes, const force::Law& law,
               std::vector<base::Warning>& warnings) {
  if (axes.passed_over) warnings.push_back(passed_over(axes, law));
  if (axes.mirrored) {
    warnings.push_back(
        {"axes_mirrored",
         "On a lead angle like this a reading with z the other way round fits as well, "
         "with K_rc and K_ac exchanged: the one with K_rc above K_ac was chosen. Name the "
         "axes of the dynamometer to be sure."});
  } else if (!axes.signs_clear) {
    warnings.push_back(
        {"axes_signs",
         "Several readings of the channels fit the record equally well. K_tc, K_rc, "
         "K_ac > 0 decided between them, but these coefficients are not all clearly "
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

/// What an answer is made of, whatever is found.
struct Task {
  const cases::Case& given;
  const Progress& progress;
  const base::Stop& stop;
  const std::vector<MeasuredRun>& measured;
};

/// What the reader of the records noted is less urgent than what the fit says.
void put_notes_last(std::vector<base::Warning>& warnings) {
  std::stable_partition(
      warnings.begin(), warnings.end(), [](const base::Warning& warning) {
        return warning.code != "part_of_record" && warning.code != "part_used" &&
               warning.code != "unit_assumed" && warning.code != "last_row_left_out";
      });
}

IdentifyResult failed(IdentifyResult r, const std::string& why) {
  put_notes_last(r.heading.warnings);
  r.heading.ok = false;
  r.heading.message = why;
  return r;
}

/// Before all others; where the numbers may not be used, after the word on that.
void put_first(const std::vector<base::Warning>& news,
               std::vector<base::Warning>& warnings) {
  const bool after_verdict = !warnings.empty() && warnings.front().code == "do_not_use";
  warnings.insert(warnings.begin() + (after_verdict ? 1 : 0), news.begin(), news.end());
}

void add_causes(const Task& task, IdentifyResult& r,
                std::vector<std::string>& left_out) {
  if (task.stop.wanted()) {
    left_out.emplace_back("the search for likely causes");
    return;
  }
  put_first(likely_causes(task.given, task.measured, r.channels, task.progress),
            r.heading.warnings);
}

/// @return why there are no axes; empty: there are
std::string find_axes(const Task& task, IdentifyResult& r) {
  const auto dynamometer = task.given.dynamometer.value_or(cases::Dynamometer{});
  r.channels = dynamometer.matrix;
  if (!dynamometer.automatic) {
    return "";
  }
  const AxesChoice axes = identification::find_axes(
      axes_problem(task.given), channels_of(task.measured),
      [&](double part) { task.progress(axes_progress(part)); });
  if (!axes.ok) {
    if (std::isfinite(axes.rms)) {
      std::vector<std::string> nobody_asks;  // there is no answer to leave it out of
      add_causes(task, r, nobody_asks);
    }
    return axes.message;
  }
  warn_axes(axes, task.given.law, r.heading.warnings);
  r.channels = axes.matrix;
  r.axes = axes;
  return "";
}

/// What the dynamometer makes of the force of each run, from the response that the case
/// names; empty: it names none.
/// @param channels  channels = matrix times force on the tool
/// @throws base::InputError where its file is wrong
std::vector<identification::Response> measured_responses(
    const cases::Case& given, std::span<const identification::Run> runs,
    const signal::Matrix3& channels, std::vector<base::Warning>& warnings) {
  if (!given.dynamometer || given.dynamometer->frf.name.empty()) return {};
  const files::TransmissionFile& file = given.dynamometer->response.get();
  warnings.insert(warnings.end(), file.notes.begin(), file.notes.end());
  std::vector<identification::Response> out;
  for (const identification::Run& run : runs) {
    const double holds = file.transmission.omega.back() / run.cut.Omega;
    const int highest = std::min(identification::resolved_harmonics(run),
                                 static_cast<int>(std::min(holds * (1.0 + 1e-9), 1e6)));
    if (highest < given.setup.cutter.teeth()) {
      throw base::InputError({fmt::format(
          "{}: the response ends at {:g} Hz; must reach the passing of the teeth at least, "
          "{:g} Hz",
          given.dynamometer->frf.path, file.transmission.omega.back() / unit::Hz,
          given.setup.cutter.teeth() * run.cut.Omega / unit::Hz)});
    }
    out.push_back(identification::response_on_tool(file.transmission, channels,
                                                   run.cut.Omega, highest));
  }
  return out;
}

/// @throws base::InputError where the file of the response of the dynamometer is wrong
identification::Fits fit_records(const Task& task, IdentifyResult& r) {
  const cases::Identify& asked = task.given.identify;
  const bool rigid = task.given.dynamometer && task.given.dynamometer->rigid;
  identification::FitRequest request{
      .chip_models = asked.chip_models,
      .runout = asked.runout,
      .view_open = !asked.band_harmonics && !rigid,
      .options = fit_options(task.given, asked.chip_models.back())};
  if (r.axes) request.options.start = r.axes->start;
  request.options.response =
      measured_responses(task.given, r.runs, r.channels, r.heading.warnings);
  request.options.stop = task.stop;
  return identification::all_fits(
      task.given.setup, task.given.law, r.runs, request, [&](double part) {
        task.progress({"fitting, one chip model after the other", part});
      });
}

/// Another reading of the channels, or another cut, that fits better than the stated one.
void look_at_alternatives(const Task& task, const Fit& chosen, IdentifyResult& r,
                          std::vector<std::string>& left_out) {
  if (chosen.channels)
    return;  // other readings were judged before axial offsets were added
  if (!(chosen.unexplained.in_band > too_good_to_doubt) ||
      identification::leaves_noise_alone(r.runs, chosen)) {
    return;
  }
  if (task.stop.wanted()) {
    left_out.emplace_back("a look at other readings of the channels");
    return;
  }
  put_first(look_at_channels(task.given, task.measured, r.channels, task.progress),
            r.heading.warnings);
  if (chosen.unexplained.in_band > worth_a_look) {
    put_first(look_at_cut(task.given, task.measured, r.channels), r.heading.warnings);
  }
}

/// Whether the intervals hold a systematic.
bool told(identification::SystematicKind kind,
          const identification::Tolerances& tolerances) {
  using enum identification::SystematicKind;
  switch (kind) {
    case gain:
    case cross_talk:
    case all_gains:
      return tolerances.gain.has_value();
    case turn:
      return tolerances.turn.has_value();
    case axial_depth:
      return tolerances.axial_depth.has_value();
    case radial_depth:
      return tolerances.radial_depth.has_value();
    case feed:
      return tolerances.feed.has_value();
    case delay:
      break;
  }
  return false;
}

/// What no interval holds, and a dynamometer that is not what it says.
void look_for_systematics(const Task& task, const Fit& chosen, IdentifyResult& r,
                          std::vector<std::string>& left_out) {
  if (chosen.channels) return;  // systematics know no axial offsets
  if (task.stop.wanted()) {
    left_out.emplace_back("a look at gains and cross talk");
    return;
  }
  identification::Systematics found =
      identification::systematics(task.given.setup, task.given.law, r.runs, chosen);
  r.not_in_intervals = std::move(found.untold);
  std::erase_if(r.not_in_intervals, [&](const auto& one) {
    return told(one.systematic.kind, task.given.identify.tolerances);
  });
  warn_sensor(found.faults, chosen, r.channels, r.heading.warnings);
}

/// What there was no time for is said after the verdict.
void add_left_out(const std::vector<std::string>& left_out, const base::Stop& stop,
                  std::vector<base::Warning>& warnings) {
  if (left_out.empty()) return;
  const std::string list = fmt::format("{}", fmt::join(left_out, "; "));
  put_first(
      {stop.spent()
           ? base::Warning{"work_limit",
                           fmt::format("These records take much work; --anyway does "
                                       "also: {}.",
                                       list)}
           : base::Warning{"time_limit",
                           fmt::format("The time was up, left out: {}.", list)}},
      warnings);
}

void warn_idle_teeth(const IdentifyResult& r, std::vector<base::Warning>& warnings) {
  for (const std::size_t tooth : r.idle_teeth) {
    warnings.push_back(
        {"idle_tooth",
         fmt::format(
             "Tooth {} cuts nothing: it is too short for the chips that the others "
             "leave. Its offset is a limit: it may be shorter. Look whether it is "
             "broken, and whether the number of teeth is right.",
             tooth + 1)});
  }
}

/// Warnings, and before everything else whether the numbers may be used at all.
void judge(const Task& task, IdentifyResult& r, std::vector<std::string>& left_out) {
  const Fit& chosen = r.fits[*r.chosen];
  auto& warnings = r.heading.warnings;
  r.reasons_against = identification::reasons_against(chosen);
  if (!task.given.setup.cutter.serration) warn_idle_teeth(r, warnings);
  add_fit_warnings(task.given, r.fits, chosen, warnings);
  warn_form(r.runout_form, warnings);
  if (!r.reasons_against.empty()) {
    warnings.insert(warnings.begin(),
                    {"do_not_use", identification::do_not_use(r.reasons_against)});
    add_causes(task, r, left_out);
  } else {
    look_at_alternatives(task, chosen, r, left_out);
    look_for_systematics(task, chosen, r, left_out);
    r.reasons_for_care = identification::poorly_known(chosen);
    std::ranges::copy(reasons_for_care(warnings),
                      std::back_inserter(r.reasons_for_care));
  }
  r.heading.message = results::identification_sentence(r);
  put_notes_last(warnings);
}

void add_curves(const Task& task, IdentifyResult& r,
                std::vector<std::string>& left_out) {
  force::Setup setup = task.given.setup;
  setup.chip = r.fits[*r.chosen].chip;
  setup.runout = r.fits[*r.chosen].runout;
  r.curve = force::chip_curve(setup, force::representative_height(setup));
  r.idle_teeth = force::idle_teeth(*r.curve);
  if (!r.idle_teeth.empty() && !force::edges_alike(setup)) {  // or farther up?
    const auto above = force::idle_teeth(force::chip_curve(setup, setup.cut.a_p));
    std::erase_if(r.idle_teeth, [&](std::size_t tooth) {
      return std::ranges::find(above, tooth) == above.end();
    });
  }
  for (const identification::Run& run : r.runs) {
    r.folded.push_back(folded(run));
  }
  if (task.given.identify.sweep && task.stop.wanted()) {
    left_out.emplace_back("sweep_um");
  } else {
    r.sweep = offset_sweep(task.given, r.runs, r.fits, task.progress);
  }
}

/// What the eccentricity of the chosen fit means at the machine.
void add_clocking(const cases::Case& given, IdentifyResult& r) {
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
    if (!given.identify.phase && geometry::equally_pitched(given.setup.cutter.pitch)) {
      r.heading.warnings.push_back(
          {"teeth_renumbered",
           "previous_clamping: with phase_deg = \"free\" the fit chooses which of the "
           "equal teeth is tooth 1. If that is another one than before, the parts "
           "of tool and holder are wrong: give phase_deg as a number."});
    }
  }
  r.clocking = c;
}

/// Axial offsets and tilt, where the records tell them.
void add_more_runout(const Task& task, IdentifyResult& r,
                     std::vector<std::string>& left_out) {
  if (!asks_for_more_runout(task.given)) return;
  if (task.stop.wanted()) {
    left_out.emplace_back("a look at axial offsets and tilt");
    return;
  }
  auto more = fit_with_more_runout(task.given, r, r.fits[*r.chosen]);
  if (!more) return;
  const bool axial = !more->runout.axial_offsets.empty();
  r.heading.warnings.push_back(
      {"runout_further",
       fmt::format(
           "The record tells {} as well, and explains clearly more with {}: the "
           "answer of the {} chip model has {}.",
           axial && more->runout.tilt > 0 ? "axial offsets and the tilt"
           : axial                        ? "axial offsets"
                                          : "the tilt of the tool",
           axial ? "them" : "it", chip::name_of(more->chip.model),
           axial ? "them" : "it")});
  r.fits[*r.chosen] = *std::move(more);
}

/// From the records, read and laid over the angle, to the answer.
IdentifyResult identified(const Task& task, IdentifyResult r) {
  if (const std::string why = find_axes(task, r); !why.empty()) {
    return failed(std::move(r), why);
  }
  r.runs = identification::on_tool(channels_of(task.measured), r.channels);
  r.records = summaries(task.measured);
  for (const MeasuredRun& one : task.measured) r.overviews.push_back(one.overview);
  identification::Fits found = fit_records(task, r);
  r.fits = std::move(found.fits);
  r.views = std::move(found.views);
  r.runout_form = std::move(found.runout_form);
  std::vector<std::string> left_out = std::move(found.left_out);
  r.chosen = identification::chosen_fit(r.fits);
  if (!r.chosen) {
    if (r.fits.back().rms > 0) {  // equations that could be solved, to no avail
      add_causes(task, r, left_out);
    }
    const std::string why = r.fits.back().message;
    return failed(std::move(r), why);
  }
  add_more_runout(task, r, left_out);
  add_curves(task, r, left_out);
  add_clocking(task.given, r);
  judge(task, r, left_out);
  add_left_out(left_out, task.stop, r.heading.warnings);
  return r;
}

/// Of what fits with offsets leave (rms): one without that leaves less shows that the search
/// with them went astray, for they only add freedom.
constexpr double far_less = 0.7;

bool explains_far_more(const IdentifyResult& without, const IdentifyResult& with) {
  return without.chosen && (!with.chosen || without.fits[*without.chosen].rms <
                                                far_less * with.fits[*with.chosen].rms);
}

/// @brief Whether a fit without offsets may explain so much more than one with them: told by
/// two fits of a rigid dynamometer, where it is clear what the channels read.
bool may_explain_far_more(const Task& without, const IdentifyResult& with) {
  if (!with.chosen || (with.axes && with.axes->next_rms < 2.0 * with.axes->rms)) {
    return true;
  }
  const Fit& found = with.fits[*with.chosen];
  identification::Options options = fit_options(without.given, found.chip.model);
  options.runout = found.options.runout;
  if (with.axes) options.start = with.axes->start;
  const cases::Case& given = without.given;
  const Fit other =
      identification::identify(given.setup, given.law, with.runs, options);
  options.fit_channel_offsets = true;
  options.start = identification::Start{found.runout, found.phase, true};
  const Fit same = identification::identify(given.setup, given.law, with.runs, options);
  return other.ok && (!same.ok || other.rms < far_less * same.rms);
}

IdentifyResult with_advice_on_offsets(IdentifyResult out) {
  if (!out.chosen) {
    out.heading.warnings.push_back(
        {"offsets_not_told",
         "Nothing in the record is free of cutting, so the offsets of the channels are to "
         "be found with the coefficients, and it may not tell both. Record some air before "
         "the cut; where the channels surely read zero without force, say "
         "channel_offsets = \"none\" in [identify]."});
  }
  return out;
}

/// @brief The same with the offsets of the channels as the records allow: where one has no
/// air to read them off, they are found with the coefficients.
IdentifyResult identified_with_offsets(const Task& task, IdentifyResult r) {
  using cases::ChannelOffset;
  if (task.given.identify.channel_offsets != ChannelOffset::automatic ||
      std::ranges::none_of(task.measured, has_offsets_to_find)) {
    return identified(task, std::move(r));
  }
  cases::Case given = task.given;
  given.identify.channel_offsets = ChannelOffset::fit;
  IdentifyResult out = identified({given, task.progress, task.stop, task.measured}, r);
  if (!out.chosen || out.fits[*out.chosen].unexplained.in_band > worth_a_look) {
    given.identify.channel_offsets = ChannelOffset::none;
    const Task without{given, task.progress, task.stop, task.measured};
    if (!may_explain_far_more(without, out)) return out;
    IdentifyResult left_in = identified(without, std::move(r));
    if (!explains_far_more(left_in, out)) return with_advice_on_offsets(std::move(out));
    left_in.heading.warnings.push_back(
        {"offsets_left_in",
         "Nothing in the record is free of cutting, and no good fit was found together "
         "with offsets of the channels: they are left in, and bias the coefficients where "
         "there are any. Record some air before the cut."});
    if (left_in.reasons_against.empty()) {
      left_in.reasons_for_care = reasons_for_care(left_in.heading.warnings);
    }
    left_in.heading.message = results::identification_sentence(left_in);
    return left_in;
  }
  return out;
}

}  // namespace

bool has_offsets_to_find(const MeasuredRun& one) {
  constexpr double fewest_turns = 4.0;
  const std::vector<double>& angle = one.run.angle;
  return !one.offset_taken_out && !angle.empty() &&
         std::abs(angle.back() - angle.front()) > fewest_turns * unit::turn;
}

identification::Options fit_options(const cases::Case& given, chip::Model model) {
  return {
      .chip_model = model,
      .runout = given.identify.runout.value_or(identification::RunoutUnknowns::offsets),
      .phase = given.identify.phase,
      .band_harmonics = given.identify.band_harmonics.value_or(0),
      .fit_channel_offsets =
          given.identify.channel_offsets == cases::ChannelOffset::fit,
      .errors = given.identify.errors,
      .tolerances = given.identify.tolerances};
}

identification::AxesProblem axes_problem(const cases::Case& given) {
  return {given.setup, given.law,
          fit_options(given, given.identify.chip_models.back())};
}

Step axes_progress(double part) {
  return {"finding the axes of the dynamometer", part};
}

IdentifyResult identify(const cases::Case& given, const Progress& progress,
                        base::Stop stop) {
  if (given.identify.by_channels) return identify_channels(given, progress);
  if (stop.left == nullptr) {
    stop.left = std::make_shared<std::atomic<std::int64_t>>(most_of_fits);
    stop.grace = most_of_fits;
  }
  IdentifyResult r;
  r.heading = heading_of(given);
  r.edge_length = given.setup.edge_length;
  progress("reading the measurements");
  const std::vector<MeasuredRun> measured = measured_runs(given, r.heading.warnings);
  return identified_with_offsets({given, progress, stop, measured}, std::move(r));
}

}  // namespace trochoid::run
