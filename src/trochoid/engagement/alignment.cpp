#include <trochoid/engagement/record_rows.h>

#include <algorithm>
#include <cmath>
#include <numeric>

// Where a record lies over its program.
namespace trochoid::engagement {

namespace {

/// Bins of the program in which a first place of the record is looked for.
constexpr std::size_t most_bins = 2048;
/// Rows that are compared when the place is found exactly.
constexpr std::size_t most_compared = 4000;
/// Parts of the program that are laid over the record each by itself.
constexpr int parts = 6;

/// Where the parts of the program start best.
struct PartStarts {
  std::vector<double> at;     ///< middle of the part, in the program [s]
  std::vector<double> start;  ///< of the program [s]
};

PartStarts starts_of_parts(std::span<const Row> rows, const Means& means, double about,
                           double reach) {
  constexpr double good = 0.7;
  PartStarts out;
  for (std::size_t p = 0; p < parts; ++p) {
    const std::size_t n = rows.size();
    const auto part = rows.subspan(n * p / parts, n * (p + 1) / parts - n * p / parts);
    if (part.size() < 10) continue;
    const double found = best_start(part, means, {about}, reach);
    const Agreement there = agreement(part, means, {found});
    if (there.correlation < good || there.covered < good) continue;
    out.at.push_back(0.5 * (part.front().time + part.back().time));
    out.start.push_back(found);
  }
  return out;
}

/// A line through the starts of the parts of the program.
void stretch_over_parts(std::span<const Row> rows, const Means& means, double reach,
                        Alignment& out) {
  const auto [at, start] = starts_of_parts(rows, means, out.start, reach);
  if (at.size() < 3) return;
  const auto n = static_cast<double>(at.size());
  const double mean_t = std::accumulate(at.begin(), at.end(), 0.0) / n;
  const double mean_s = std::accumulate(start.begin(), start.end(), 0.0) / n;
  double tt = 0.0;
  double ts = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    tt += (at[i] - mean_t) * (at[i] - mean_t);
    ts += (at[i] - mean_t) * (start[i] - mean_s);
  }
  if (!(tt > 0)) return;
  const double slope = ts / tt;
  const double from = mean_s - slope * mean_t;
  if (agreement(rows, means, {from, 1 + slope}).correlation >
      agreement(rows, means, {out.start}).correlation) {
    out.start = from;
    out.stretch = 1 + slope;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double off = start[i] - (out.start + (out.stretch - 1) * at[i]);
    sum += off * off;
  }
  out.scatter = std::sqrt(sum / n);
}

}  // namespace

std::optional<Alignment> align(std::span<const Step> steps, const Recorded& record) {
  if (!can_align(steps, record)) return std::nullopt;
  const Means means(record);
  const Bins bins(record, means, bin_of(steps, record, most_bins));
  std::vector<Row> all = rows_of(steps, record.reads);
  const Lag lag = best_lag(all, bins);
  if (!(lag.whole > 0)) return std::nullopt;
  const std::vector<Row> rows = some_of(all, most_compared);
  const double end = all.back().to();
  Alignment out{.other_start = lag.other};
  out.start = best_start(rows, means, {lag.start}, 1.5 * bins.width());
  stretch_over_parts(rows, means, std::max(3 * bins.width(), 0.02 * end), out);
  const Agreement there = agreement(rows, means, {out.start, out.stretch});
  out.correlation = there.correlation;
  out.covered = there.covered;
  for (Row& row : all) {
    row.time = out.start + out.stretch * row.time;
    row.duration *= out.stretch;
  }
  out.whole_correlation = whole_agreement(all, bins);
  return out;
}

}  // namespace trochoid::engagement
