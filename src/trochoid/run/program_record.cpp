#include <trochoid/run/program.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/geometry/edge.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/numerics/median.h>
#include <trochoid/signal/axes.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trochoid::run {

namespace {

/// A record that agrees less is not of this program: as it was programmed, with one factor
/// for all feeds, and with one for each line. Free feeds fit almost any record a little.
constexpr double least_correlation = 0.85;
constexpr double least_with_factor = 0.9;
constexpr double least_line_by_line = 0.95;
/// The record has the whole program, or little beside what it has of it.
constexpr double whole_program = 0.95;
constexpr double least_of_whole = 0.8;
/// A shorter record cannot be laid over a program.
constexpr double least_turns = 10.0;
/// A clock that differs more is said.
constexpr double same_clock = 0.005;
/// Feeds and coefficients that differ more from the case are said.
constexpr double same_feed = 0.03;
constexpr double same_coefficient = 0.01;

/// What the channels read: three forces, or one that is power or torque.
engagement::Reads reads_of(const cases::Case& given) {
  if (!given.identify.by_channels) return engagement::Reads::forces;
  return given.dynamometer->sensor.channels.front().axis == force::ChannelAxis::power
             ? engagement::Reads::power
             : engagement::Reads::torque;
}

/// Forces on the tool in the axes of the program, or the one channel there is.
std::vector<std::array<double, 3>> values_of(const cases::Case& given,
                                             const signal::Record& record,
                                             std::vector<std::string>& problems) {
  std::vector<std::array<double, 3>> out;
  if (given.identify.by_channels) {
    const double sign = given.dynamometer->sensor.channels.front().sign;
    for (const double one : record.channel[0]) out.push_back({sign * one, 0.0, 0.0});
    return out;
  }
  if (!std::ranges::all_of(record.measured, [](bool there) { return there; })) {
    problems.push_back(
        fmt::format("{}: a channel is missing; a record of a program needs x, y and z",
                    record.file));
  }
  signal::Matrix3 axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (given.dynamometer) axes = given.dynamometer->matrix;
  auto force = signal::force_on_tool(record.channel, axes);
  if (!force) problems.push_back("dynamometer.matrix: it cannot be inverted");
  return force ? *std::move(force) : std::move(out);
}

/// The record over the time.
engagement::Recorded recorded_of(const cases::Case& given) {
  const cases::Measurement& m = given.measurements.front();
  const signal::Record& record = m.record.get();
  std::vector<std::string> problems;
  if (record.time.empty()) {
    problems.push_back(
        fmt::format("{}: it has no times; a record of a program needs them, or "
                    "sample_rate_Hz in [[measurement]]",
                    record.file));
  }
  const auto values = values_of(given, record, problems);
  if (!problems.empty()) throw base::InputError(std::move(problems));
  engagement::Recorded out{.reads = reads_of(given)};
  for (std::size_t i = 0; i < record.time.size(); ++i) {
    const double t = record.time[i];
    if (t < m.from.value_or(t) || t > m.to.value_or(t)) continue;
    out.time.push_back(t);
    out.value.push_back(values[i]);
    if (!record.line.empty()) {
      out.line.push_back(static_cast<int>(std::lround(record.line[i])));
    }
  }
  return out;
}

/// A record over its program, by its times or by the lines that it has. Where no place is
/// found, the correlation is 0.
struct Placed {
  std::optional<engagement::LineNumbers> numbers;
  engagement::LaidOver over;
  double start = 0.0;   ///< where all feeds were slower: of the program [s]
  double slower = 1.0;  ///< by this factor
  double least = least_correlation;

  /// Whether it is of this program, and where it was laid.
  [[nodiscard]] bool fits() const noexcept {
    const engagement::Alignment& at = over.alignment;
    return std::max(at.correlation, at.whole_correlation) >= least &&
           (at.covered >= whole_program || at.whole_correlation >= least_of_whole);
  }
  /// In the time of the record.
  [[nodiscard]] engagement::Alignment alignment() const noexcept {
    engagement::Alignment out = over.alignment;
    out.start += start;
    out.stretch *= slower;
    return out;
  }
};

/// Other feeds are tried where the programmed ones do not agree so well.
constexpr double good_correlation = 0.995;
/// They are taken where they leave less than this part of what those leave unexplained.
constexpr double clear_part = 0.8;

/// By lines or N numbers: by those with which the record agrees better.
Placed placed(std::span<const engagement::Step> steps, engagement::Recorded recorded,
              const base::Stop& stop) {
  using engagement::LineNumbers;
  const auto at = [&](std::optional<LineNumbers> numbers, engagement::Recorded timed) {
    const auto alignment = engagement::align(steps, timed);
    return Placed{numbers,
                  {std::move(timed), alignment.value_or(engagement::Alignment{})}};
  };
  const auto agrees = [](const Placed& one) {
    return one.over.alignment.whole_correlation;
  };
  if (recorded.line.empty()) {
    Placed as_programmed = at(std::nullopt, std::move(recorded));
    if (as_programmed.over.alignment.correlation > good_correlation &&
        as_programmed.fits()) {
      return as_programmed;
    }
    auto other = engagement::at_other_feed(steps, as_programmed.over.record, stop);
    if (!other) return as_programmed;
    Placed slower = at(std::nullopt, std::move(other->record));
    slower.start = other->start;
    slower.slower = other->slower;
    slower.least = other->line_by_line ? least_line_by_line : least_with_factor;
    const bool clearly = 1 - agrees(slower) < clear_part * (1 - agrees(as_programmed));
    return clearly ? std::move(slower) : std::move(as_programmed);
  }
  const auto by = [&](LineNumbers numbers) {
    return at(numbers, engagement::by_lines(steps, recorded, numbers));
  };
  Placed lines = by(LineNumbers::line);
  Placed blocks = by(LineNumbers::block);
  return agrees(blocks) > agrees(lines) ? std::move(blocks) : std::move(lines);
}

double size_of(const std::array<double, 3>& F) {
  return std::hypot(F[0], F[1], F[2]);
}

/// How large the record is beside what was computed.
void compare(std::span<const engagement::Step> steps, results::ProgramRecord& out) {
  std::vector<double> means;
  std::vector<double> peaks;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const engagement::StepRecord& one = out.recorded.steps[i];
    const engagement::TurnForces& F = steps[i].forces;
    if (!one.there || !(F.peak_xy > 0)) continue;
    means.push_back(size_of(one.mean) / size_of(mean_of(steps[i], out.reads)));
    peaks.push_back(one.peak_xy / F.peak_xy);
  }
  out.covered = means.size();
  if (means.empty()) return;
  out.mean_ratio = numerics::median(std::move(means));
  out.peak_ratio = numerics::median(std::move(peaks));
}

/// A record over the rows of a program, and the tool whose cuts are looked at.
struct OwnCuts {
  const engagement::Job& job;
  std::span<const engagement::Step> steps;
  const engagement::LaidOver& over;
  std::size_t place;  ///< of the tool in the job

  [[nodiscard]] const engagement::Tool& tool() const { return job.tools[place]; }
};

void add_coefficients(const OwnCuts& own, results::ProgramRecord& out) {
  const auto fit =
      engagement::fit_means(own.job, own.steps, own.over, out.recorded, own.place);
  if (!fit) return;
  const force::Law& law = own.tool().law;
  const auto quantities = force::coefficient_quantities(law);
  const std::vector<double> stated = force::coefficients(law);
  for (std::size_t k = 0; k < quantities.size(); ++k) {
    out.coefficients.push_back(
        {quantities[k].key, quantities[k].unit, stated[k], fit->K[k], fit->se[k]});
  }
  out.fitted_steps = fit->steps;
  out.factor = fit->factor;
  out.rms = fit->rms;
}

/// Forces over the angle in steady cuts tell the runout, too.
void add_fit(const OwnCuts& own, const cases::Case& given,
             results::ProgramRecord& out) {
  using identification::RunoutUnknowns;
  const engagement::Idle& idle = out.recorded.idle;
  out.cuts = engagement::steady_cuts(own.job, own.steps, own.over, idle, own.place);
  if (out.cuts.empty()) return;
  const auto unknowns = chip::feels_runout(own.tool().chip.model)
                            ? given.identify.runout.value_or(RunoutUnknowns::offsets)
                            : RunoutUnknowns::none;
  out.fit = engagement::fit_forces(out.cuts, own.tool(), unknowns, idle,
                                   own.job.options.stop);
  out.edge_length = own.tool().edge_length;
}

/// How far each tooth reaches beyond the mean of all at the tip [m].
std::vector<double> reaches_of(const geometry::Cutter& cutter,
                               const geometry::Runout& runout) {
  const std::vector<double> psi = geometry::tooth_angles(cutter);
  std::vector<geometry::EdgePosition> teeth(psi.size());
  geometry::edge_positions(runout, psi, cutter.profile.D / 2, 0.0, teeth);
  double mean = 0.0;
  for (const auto& tooth : teeth) mean += tooth.R / static_cast<double>(teeth.size());
  std::vector<double> out;
  out.reserve(teeth.size());
  for (const auto& tooth : teeth) out.push_back(tooth.R - mean);
  return out;
}

/// Largest difference of the reach of a tooth; equal teeth can be numbered from any.
double difference_of(const std::vector<double>& a, const std::vector<double>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t shift = 0; shift < a.size(); ++shift) {
    double most = 0.0;
    for (std::size_t j = 0; j < a.size(); ++j) {
      most = std::max(most, std::abs(a[(j + shift) % a.size()] - b[j]));
    }
    least = std::min(least, most);
  }
  return least;
}

/// Whether the forces in steady cuts tell numbers that one may use.
bool is_reliable(const results::ProgramRecord& record) {
  return record.fit && record.fit->ok &&
         identification::reasons_against(*record.fit).empty();
}

void warn_of_fit(const results::ProgramRecord& record,
                 std::vector<base::Warning>& warnings) {
  if (!record.fit || !record.fit->ok || is_reliable(record)) return;
  warnings.push_back(
      {"do_not_use", fmt::format("{}, the forces in its steady cuts: {}", record.file,
                                 identification::do_not_use(
                                     identification::reasons_against(*record.fit)))});
}

void warn_of_runout(const results::ProgramRecord& record, const engagement::Tool& tool,
                    std::vector<base::Warning>& warnings) {
  if (!is_reliable(record) || !chip::feels_runout(tool.chip.model)) return;
  const identification::Fit& fit = *record.fit;
  double se = fit.eccentricity_se.value_or(0.0);
  for (const auto& one : fit.radial_offsets_se) se = std::max(se, one.value_or(0.0));
  const std::vector<double> found = reaches_of(tool.cutter, fit.runout);
  const std::vector<double> stated = reaches_of(tool.cutter, tool.runout);
  if (!(se > 0) || difference_of(found, stated) <= fit.interval_factor * se) return;
  const auto in_um = [](const std::vector<double>& all) {
    std::vector<std::string> out;
    out.reserve(all.size());
    for (const double one : all) out.push_back(fmt::format("{:+.3g}", one / unit::um));
    return out;
  };
  warnings.push_back(
      {"other_runout",
       fmt::format(
           "{}: its forces tell another runout than the case: the teeth stand "
           "{} um off their mean (stated: {}). material.toml has what was found: "
           "include it in the case.",
           record.file, fmt::join(in_um(found), ", "),
           fmt::join(in_um(stated), ", "))});
}

/// What the record tells best: the forces over the angle count the runout, too.
std::vector<results::RecordCoefficient> best_coefficients(
    const results::ProgramRecord& record, const force::Law& stated) {
  if (!is_reliable(record)) return record.coefficients;
  std::vector<results::RecordCoefficient> out;
  const auto quantities = force::coefficient_quantities(stated);
  const std::vector<double> K = force::coefficients(stated);
  for (std::size_t k = 0; k < quantities.size(); ++k) {
    out.push_back({quantities[k].key, quantities[k].unit, K[k], K[k], std::nullopt});
    if (const auto& one = record.fit->coefficients[k]) {
      out.back().found = one->value;
      out.back().se = one->se;
    }
  }
  return out;
}

void warn_of_coefficients(const results::ProgramRecord& record,
                          const force::Law& stated,
                          std::vector<base::Warning>& warnings) {
  const bool fitted = is_reliable(record);
  const double factor = fitted ? record.fit->interval_factor : record.factor;
  const auto best = best_coefficients(record, stated);
  std::vector<std::string> other;
  for (const results::RecordCoefficient& one : best) {
    const double off = std::abs(one.found - one.stated);
    if (!one.se || off <= factor * *one.se ||
        off <= same_coefficient * std::abs(one.stated)) {
      continue;
    }
    other.push_back(fmt::format("{} ({:.4g} stated, {:.4g} +- {:.2g} found)", one.key,
                                one.stated / one.unit, one.found / one.unit,
                                factor * *one.se / one.unit));
  }
  if (other.empty()) return;
  // Power and torque depend on the tangential ones only.
  const bool tangential = record.reads != engagement::Reads::forces;
  const bool all = std::ranges::all_of(best, [&](const auto& one) {
    return one.se.has_value() || (tangential && !one.key.starts_with("K_t"));
  });
  warnings.push_back(
      {"other_coefficients",
       fmt::format("{}: its {} tell other coefficients than the case: {}{}.",
                   record.file, fitted ? "forces" : "means", fmt::join(other, ", "),
                   all ? "" : ", if the others are as stated")});
}

/// Whether some steps took longer than others beside the program.
bool feeds_differ(const results::ProgramRecord& record) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const engagement::StepRecord& one : record.recorded.steps) {
    if (!one.there) continue;
    least = std::min(least, one.stretch);
    most = std::max(most, one.stretch);
  }
  return most > least * (1 + same_feed);
}

/// Lines that took longer or shorter than in the program.
void warn_of_feeds(std::span<const engagement::Step> steps,
                   const results::ProgramRecord& record,
                   std::vector<base::Warning>& warnings) {
  if (!record.numbers && !feeds_differ(record)) return;  // record_stretch tells
  std::vector<std::string> lines;
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const engagement::StepRecord& one = record.recorded.steps[i];
    if (!one.there || steps[i].line == last || std::abs(one.stretch - 1) <= same_feed) {
      continue;
    }
    last = steps[i].line;
    lines.push_back(fmt::format("line {} ({:.3g} times as long)", last, one.stretch));
  }
  if (lines.empty()) return;
  constexpr std::size_t most = 5;
  const std::size_t more = lines.size() - std::min(lines.size(), most);
  lines.resize(std::min(lines.size(), most));
  warnings.push_back(
      {"feed_override",
       fmt::format("{}: the machine did not keep the feeds of the program: {}{}. The "
                   "computed forces belong to the programmed feeds. Coefficients "
                   "are found with the feeds that ran.{}",
                   record.file, fmt::join(lines, ", "),
                   more > 0 ? fmt::format(" and {} more", more) : std::string(),
                   record.numbers
                       ? ""
                       : " Each line got the feed with which the record fits: "
                         "check that it is of this program.")});
}

/// The record is not of this program, or it cannot be told where it is.
base::Warning does_not_fit(const Placed& record, const std::string& file,
                           std::span<const engagement::Step> steps) {
  const engagement::Recorded& given = record.over.record;
  const double length =
      given.time.size() > 1 ? given.time.back() - given.time.front() : 0.0;
  const auto cuts = std::ranges::find_if(
      steps, [](const engagement::Step& step) { return step.a_p > 0; });
  if (cuts != steps.end() && length * cuts->spindle < least_turns * unit::turn) {
    return {
        "record_does_not_fit",
        fmt::format("{}: it has fewer than ten turns of the spindle: too few to find "
                    "where it lies over the program.",
                    file)};
  }
  const engagement::Alignment& at = record.over.alignment;
  const bool elsewhere = at.correlation >= record.least;
  return {
      "record_does_not_fit",
      fmt::format(
          "{}: its {} not fit this program (correlation {:.2f}{}). Check the axes of the "
          "dynamometer, and that the record is of this program{}.{}",
          file, given.reads == engagement::Reads::forces ? "forces do" : "channel does",
          at.correlation,
          elsewhere ? fmt::format(" where both are; of the whole record {:.2f}",
                                  at.whole_correlation)
          : record.least > least_correlation
              ? fmt::format(", and with other feeds {} is needed", record.least)
              : std::string(),
          elsewhere ? " alone (from_s and to_s leave the rest out)" : "",
          record.numbers ? ""
                         : " Feeds that the operator changed often need a column with "
                           "the line that ran (line_column).")};
}

/// Other places agree nearly as well: equal passes, of which the record has a part.
void warn_of_places(const Placed& record, const std::string& file,
                    std::vector<base::Warning>& warnings) {
  const engagement::Alignment& at = record.over.alignment;
  if (record.numbers || !std::isfinite(at.other_start)) return;
  const double other = record.over.clock_at((at.other_start - at.start) / at.stretch);
  warnings.push_back(
      {"record_ambiguous",
       fmt::format(
           "{}: the program may start at {:.2f} s or at {:.2f} s of it: both agree "
           "about as well. Which step had which force is not known for certain. "
           "A record with the air before and after the program tells.",
           file, record.alignment().start, other)});
}

void warn_of_record(const results::ProgramRecord& record,
                    std::vector<base::Warning>& warnings) {
  if (std::abs(record.alignment.stretch - 1) > same_clock) {
    warnings.push_back(
        {"record_stretch",
         fmt::format(
             "{}: the feed moves took {:.3f} times as long as in the program: a feed "
             "override, or accelerations that [machine] does not have. The "
             "computed forces belong to the programmed feeds. Coefficients are found with "
             "the feeds that ran.",
             record.file, record.alignment.stretch)});
  }
  if (!record.recorded.idle.found) {
    warnings.push_back(
        {"no_air", fmt::format("{}: the program has too little air to tell what the "
                               "channels read where nothing cuts.",
                               record.file)});
  } else if (const double spindle = record.recorded.speed_without_air; spindle > 0) {
    warnings.push_back(
        {"no_air", fmt::format("{}: at {:.4g} rpm the program has too little air to "
                               "tell what the spindle takes there. The cuts at this "
                               "speed are left out.",
                               record.file, spindle / unit::rpm)});
  }
}

}  // namespace

std::optional<results::ProgramRecord> record_of(const engagement::Job& job,
                                                const cases::Case& given,
                                                std::span<const std::size_t> own,
                                                std::span<const engagement::Step> steps,
                                                std::vector<base::Warning>& warnings) {
  if (given.measurements.empty()) return std::nullopt;
  const Placed record = placed(steps, recorded_of(given), job.options.stop);
  const engagement::LaidOver& over = record.over;
  results::ProgramRecord out{.file = given.measurements.front().source.file.name,
                             .numbers = record.numbers,
                             .alignment = record.alignment(),
                             .reads = over.record.reads};
  if (!record.fits()) {
    warnings.push_back(does_not_fit(record, out.file, steps));
    return std::nullopt;
  }
  warn_of_places(record, out.file, warnings);
  out.recorded = engagement::over_steps(steps, over);
  compare(steps, out);
  if (!own.empty()) {
    const OwnCuts cuts{job, steps, over, own.front()};
    add_coefficients(cuts, out);
    add_fit(cuts, given, out);
    warn_of_fit(out, warnings);
    warn_of_runout(out, cuts.tool(), warnings);
    warn_of_coefficients(out, cuts.tool().law, warnings);
  }
  warn_of_record(out, warnings);
  warn_of_feeds(steps, out, warnings);
  return out;
}

}  // namespace trochoid::run
