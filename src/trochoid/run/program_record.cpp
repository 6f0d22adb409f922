#include <trochoid/run/program.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/numerics/median.h>
#include <trochoid/signal/axes.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::run {

namespace {

/// A record that agrees less is not of this program.
constexpr double least_correlation = 0.5;
/// A clock that differs more is said.
constexpr double same_clock = 0.005;

/// Forces on the tool over the time; axes of the table are those of the program.
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
  if (!std::ranges::all_of(record.measured, [](bool there) { return there; })) {
    problems.push_back(
        fmt::format("{}: a channel is missing; a record of a program needs x, y and z",
                    record.file));
  }
  signal::Matrix3 axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (given.dynamometer) axes = given.dynamometer->matrix;
  auto force = signal::force_on_tool(record.channel, axes);
  if (!force) {
    problems.push_back("dynamometer.matrix: it cannot be inverted");
  }
  if (!problems.empty()) throw base::InputError(std::move(problems));
  engagement::Recorded out;
  for (std::size_t i = 0; i < record.time.size(); ++i) {
    const double t = record.time[i];
    if (t < m.from.value_or(t) || t > m.to.value_or(t)) continue;
    out.time.push_back(t);
    out.force.push_back((*force)[i]);
    if (!record.line.empty()) {
      out.line.push_back(static_cast<int>(std::lround(record.line[i])));
    }
  }
  return out;
}

/// A record over its program, by its times or by the lines that it has.
struct LaidOver {
  std::optional<engagement::LineNumbers> numbers;
  engagement::Recorded recorded;
  std::optional<engagement::Alignment> alignment;

  [[nodiscard]] double correlation() const noexcept {
    return alignment ? alignment->correlation : 0.0;
  }
};

/// By lines or N numbers: by those with which the forces agree better.
LaidOver laid_over(std::span<const engagement::Step> steps,
                   engagement::Recorded recorded) {
  using engagement::LineNumbers;
  if (recorded.line.empty()) {
    const auto alignment = engagement::align(steps, recorded);
    return {std::nullopt, std::move(recorded), alignment};
  }
  const auto by = [&](LineNumbers numbers) {
    auto timed = engagement::by_lines(steps, recorded, numbers);
    const auto alignment = engagement::align(steps, timed);
    return LaidOver{numbers, std::move(timed), alignment};
  };
  LaidOver lines = by(LineNumbers::line);
  LaidOver blocks = by(LineNumbers::block);
  return blocks.correlation() > lines.correlation() ? std::move(blocks)
                                                    : std::move(lines);
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
    means.push_back(size_of(one.mean) / size_of(F.mean));
    peaks.push_back(one.peak_xy / F.peak_xy);
  }
  out.covered = means.size();
  if (means.empty()) return;
  out.mean_ratio = numerics::median(std::move(means));
  out.peak_ratio = numerics::median(std::move(peaks));
}

void add_coefficients(const engagement::Job& job, std::size_t tool,
                      std::span<const engagement::Step> steps,
                      results::ProgramRecord& out) {
  const auto fit = engagement::fit_means(job, steps, out.recorded, tool);
  if (!fit) return;
  const force::Law& law = job.tools[tool].law;
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

void warn_of_record(const results::ProgramRecord& record,
                    std::vector<base::Warning>& warnings) {
  if (std::abs(record.alignment.stretch - 1) > same_clock) {
    warnings.push_back(
        {"record_stretch",
         fmt::format("{}: the machine took {:.3f} times as long as the program: a feed "
                     "override, or accelerations that [machine] does not have.",
                     record.file, record.alignment.stretch)});
  }
  std::vector<std::string> other;
  for (const results::RecordCoefficient& one : record.coefficients) {
    if (!one.se || std::abs(one.found - one.stated) <= record.factor * *one.se)
      continue;
    other.push_back(fmt::format("{} ({:.4g} stated, {:.4g} +- {:.2g} found)", one.key,
                                one.stated / one.unit, one.found / one.unit,
                                record.factor * *one.se / one.unit));
  }
  if (!other.empty()) {
    warnings.push_back(
        {"other_coefficients",
         fmt::format("{}: its mean forces tell other coefficients than the case: {}.",
                     record.file, fmt::join(other, ", "))});
  }
  if (!record.recorded.idle.found) {
    warnings.push_back(
        {"no_air", fmt::format("{}: the program has too little air to tell what the "
                               "channels read where nothing cuts.",
                               record.file)});
  }
}

}  // namespace

std::optional<results::ProgramRecord> record_of(const engagement::Job& job,
                                                const cases::Case& given,
                                                std::span<const std::size_t> own,
                                                std::span<const engagement::Step> steps,
                                                std::vector<base::Warning>& warnings) {
  if (given.measurements.empty()) return std::nullopt;
  const LaidOver record = laid_over(steps, recorded_of(given));
  results::ProgramRecord out{.file = given.measurements.front().source.file.name,
                             .numbers = record.numbers};
  if (record.correlation() < least_correlation) {
    warnings.push_back(
        {"record_does_not_fit",
         fmt::format("{}: its forces do not fit this program (correlation {:.2f}). "
                     "Check the axes of the dynamometer, and that the record is of "
                     "this program.",
                     out.file, record.correlation())});
    return std::nullopt;
  }
  out.alignment = *record.alignment;
  out.recorded = engagement::over_steps(steps, record.recorded, *record.alignment);
  compare(steps, out);
  if (!own.empty()) add_coefficients(job, own.front(), steps, out);
  warn_of_record(out, warnings);
  return out;
}

}  // namespace trochoid::run
