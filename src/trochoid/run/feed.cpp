#include <trochoid/run/program.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/cases/rules.h>
#include <trochoid/program/read_program.h>
#include <trochoid/program/write_feeds.h>
#include <trochoid/results/file_names.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace trochoid::run {

namespace {

using engagement::WantedFeed;
using results::NewFeeds;

/// A load up to this part of its limit is within it: more is rounding.
constexpr double close_enough = 1 + 1e-9;
constexpr int most_rounds = 4;

/// The peak that `even` makes the others like: of the steps in cut.
double even_peak(std::span<const engagement::Step> steps, double percentile) {
  std::vector<double> peaks;
  for (const engagement::Step& step : steps) {
    if (step.forces.peak_xy > 0) peaks.push_back(step.forces.peak_xy);
  }
  if (peaks.empty()) return engagement::Limits::none;
  const auto last = static_cast<double>(peaks.size() - 1);
  const auto at = static_cast<std::ptrdiff_t>(std::lround(percentile / 100 * last));
  std::ranges::nth_element(peaks, peaks.begin() + at);
  return peaks[static_cast<std::size_t>(at)];
}

/// The totals that are compared before and after.
results::FeedTotals totals_of(const engagement::Totals& all) {
  return {all.time, all.time_in_cut, all.peak_xy.value, all.peak_tooth.value};
}

/// A written program, read as any other.
program::Program read_again(const std::string& text, const cases::Case& given,
                            program::Dialect dialect) {
  program::ReadOptions options = cases::read_options(given.nc);
  options.dialect = dialect;
  return program::read_program(text, options).program;
}

/// The step of the program that a place of the written one belongs to.
WantedFeed& step_at(std::vector<WantedFeed>& wanted, double along) {
  const auto after = std::ranges::partition_point(wanted, [&](const WantedFeed& w) {
    return w.along + 0.5 * (w.to - w.from) < along;
  });
  return after == wanted.end() ? wanted.back() : *after;
}

/// Writes the program with new feeds and runs it.
class Trial {
 public:
  Trial(const engagement::Job& job, const cases::Case& given,
        const engagement::Limits& limits, double least)
      : job_(job), given_(given), limits_(limits), least_(least) {}

  /// Write, read and run it.
  /// @param wanted  slower afterwards where a limit is still broken
  /// @return whether all limits that can be kept are kept
  bool keeps(std::vector<WantedFeed>& wanted, NewFeeds& out) {
    std::vector<WantedFeed> slower = wanted;
    const bool kept = run(wanted, slower, out);
    out.steps = wanted;
    wanted = std::move(slower);
    return kept;
  }

 private:
  bool run(const std::vector<WantedFeed>& wanted, std::vector<WantedFeed>& slower,
           NewFeeds& out) {
    const cases::FeedRules& rules = *given_.nc.feed;
    const auto parts = engagement::feed_parts(job_, wanted);
    out.text = program::write_feeds(*given_.nc.program->text.get().text, job_.program,
                                    parts, rules.split_lines);
    const program::Program written = read_again(out.text, given_, job_.program.dialect);
    const engagement::Job job{written, job_.tools, job_.stock, job_.options};
    bool kept = true;
    const engagement::Summary summary =
        engagement::compute_steps(job, [&](std::span<const engagement::Step> rows) {
          for (const engagement::Step& row : rows) kept &= !slow_down(row, slower);
        });
    out.after = totals_of(summary.totals);
    return kept;
  }

  bool slow_down(const engagement::Step& row, std::vector<WantedFeed>& wanted) const {
    const double share = engagement::share_of_limits(row.forces, limits_, row.spindle);
    if (share <= close_enough) return false;
    WantedFeed& step = step_at(wanted, row.along);
    const double lowest = least_ * step.programmed;
    if (step.feed <= lowest * (1 + 1e-6)) return false;
    // Forces have a part that does not depend on the feed; the next run has other steps.
    constexpr double margin = 0.998;
    step.feed = std::max(lowest, margin * step.feed * std::pow(share, -1.5));
    return true;
  }

  const engagement::Job& job_;
  const cases::Case& given_;
  const engagement::Limits& limits_;
  double least_;
};

std::vector<std::uint32_t> lines_where(std::span<const WantedFeed> wanted,
                                       bool (*is)(const WantedFeed&)) {
  std::vector<std::uint32_t> lines;
  for (const WantedFeed& w : wanted) {
    if (is(w) && (lines.empty() || lines.back() != w.line)) lines.push_back(w.line);
  }
  return lines;
}

}  // namespace

engagement::Limits limits_of(const cases::ProgramTables& nc) {
  const cases::ForceLimits given = nc.limits.value_or(cases::ForceLimits{});
  constexpr double none = engagement::Limits::none;
  engagement::Limits out{.peak_xy = given.peak_force.value_or(none),
                         .peak_tooth = given.peak_tooth.value_or(none),
                         .torque = given.torque.value_or(none),
                         .power = given.power.value_or(none),
                         .moment = given.bending_moment.value_or(none),
                         .deflection = given.deflection.value_or(none)};
  if (given.chip.size() == 2) {
    out.least_chip = given.chip[0];
    out.chip = given.chip[1];
  }
  if (nc.machine) {
    for (const auto& [speed, power] : nc.machine->power_curve) {
      out.power_curve.push_back({speed * unit::rpm, power});
    }
  }
  return out;
}

void check_name_of_program(const cases::Case& given) {
  if (!given.nc.feed) return;
  const std::string& name = given.nc.feed->write;
  std::string lower = name;  // some disks do not tell a from A
  std::ranges::transform(lower, lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (!results::is_ours(lower)) return;
  throw base::InputError(
      {fmt::format("{}: feed.write = \"{}\": the answer has a file of that name; give "
                   "another one",
                   given.file.string(), name)});
}

std::optional<results::NewFeeds> new_feeds(const engagement::Job& job,
                                           const cases::Case& given,
                                           const results::ProgramForces& forces,
                                           const Progress& progress) {
  const cases::FeedRules& rules = *given.nc.feed;
  engagement::Limits limits = limits_of(given.nc);
  NewFeeds out{.file = rules.write, .before = totals_of(forces.summary.totals)};
  if (rules.target == cases::FeedTarget::even) {
    limits.peak_xy =
        std::min(limits.peak_xy, even_peak(forces.steps, rules.even_percentile));
    if (std::isfinite(limits.peak_xy)) out.even_peak = limits.peak_xy;
  }
  progress("Looking for the largest feed of each step");
  std::vector<WantedFeed> wanted =
      engagement::largest_feeds(job, limits, {rules.factor[0], rules.factor[1]});
  out.not_reachable =
      lines_where(wanted, [](const WantedFeed& w) { return !w.reachable; });
  out.rubbing = lines_where(wanted, [](const WantedFeed& w) { return w.rubs; });
  Trial trial(job, given, limits, rules.factor[0]);
  for (int i = 0; i < most_rounds && !out.keeps_limits; ++i) {
    progress(fmt::format("Running the program with its new feeds, {}", i + 1));
    if (!job.options.stop.wanted()) out.keeps_limits = trial.keeps(wanted, out);
    if (job.options.stop.wanted()) return std::nullopt;  // nothing half written
  }
  return out;
}

}  // namespace trochoid::run
