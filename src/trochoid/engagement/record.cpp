#include <trochoid/engagement/record.h>

#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace trochoid::engagement {

namespace {

using Vector = std::array<double, 3>;

/// Bins of the program in which a first place of the record is looked for.
constexpr std::size_t most_bins = 2048;
/// Rows that are compared when the place is found exactly.
constexpr std::size_t most_compared = 4000;
/// Parts of the program that are laid over the record each by itself.
constexpr int parts = 6;
/// Less air tells no offset [s].
constexpr double least_air = 0.05;

/// Slow channels lag behind: so many samples about a step are of the same cut, or of air.
constexpr double settled = 6.0;
/// So many samples tell how long a line took.
constexpr std::size_t samples_of_a_line = 70;

/// Time from sample to sample, on the average [s].
double sample_time(const Recorded& record) noexcept {
  const auto n = static_cast<double>(record.time.size());
  return n > 1 ? (record.time.back() - record.time.front()) / (n - 1) : 0.0;
}

/// Means of a record over any of its stretches.
class Means {
 public:
  explicit Means(const Recorded& record) : record_(record) {
    sums_.resize(record.value.size() + 1);
    for (std::size_t i = 0; i < record.value.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        sums_[i + 1][c] = sums_[i][c] + record.value[i][c];
      }
    }
  }

  struct Samples {
    std::size_t from, to;
  };
  [[nodiscard]] Samples within(double from, double to) const noexcept {
    const auto& t = record_.time;
    const auto at = [&](double x) {
      return static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), x) -
                                      t.begin());
    };
    return {at(from), at(to)};
  }

  [[nodiscard]] Reads reads() const noexcept { return record_.reads; }
  [[nodiscard]] std::optional<Vector> mean(double from, double to) const noexcept {
    const auto [a, b] = within(from, to);
    if (b <= a) return std::nullopt;
    Vector out{};
    for (std::size_t c = 0; c < 3; ++c) {
      out[c] = (sums_[b][c] - sums_[a][c]) / static_cast<double>(b - a);
    }
    return out;
  }

 private:
  const Recorded& record_;
  std::vector<Vector> sums_;
};

/// Weighted correlation of vectors, each component about its own mean.
class Correlation {
 public:
  void add(const Vector& a, const Vector& b, double weight) noexcept {
    weight_ += weight;
    for (std::size_t c = 0; c < 3; ++c) {
      a_[c] += weight * a[c];
      b_[c] += weight * b[c];
      aa_ += weight * a[c] * a[c];
      bb_ += weight * b[c] * b[c];
      ab_ += weight * a[c] * b[c];
    }
  }
  [[nodiscard]] double weight() const noexcept { return weight_; }
  [[nodiscard]] double value() const noexcept {
    if (!(weight_ > 0)) return 0.0;
    double aa = aa_;
    double bb = bb_;
    double ab = ab_;
    for (std::size_t c = 0; c < 3; ++c) {
      aa -= a_[c] * a_[c] / weight_;
      bb -= b_[c] * b_[c] / weight_;
      ab -= a_[c] * b_[c] / weight_;
    }
    return aa > 1e-12 * aa_ && bb > 1e-12 * bb_ ? ab / std::sqrt(aa * bb) : 0.0;
  }

 private:
  double weight_ = 0.0;
  Vector a_{}, b_{};
  double aa_ = 0.0, bb_ = 0.0, ab_ = 0.0;
};

/// Means in bins of time.
std::vector<Vector> computed_bins(std::span<const Step> steps, Reads reads, double bin,
                                  std::size_t count) {
  std::vector<Vector> out(count);
  for (const Step& step : steps) {
    const double from = step.time - 0.5 * step.duration;
    const double to = from + step.duration;
    const Vector mean = mean_of(step, reads);
    const auto first = static_cast<std::size_t>(std::max(0.0, from / bin));
    for (std::size_t k = first; k < count && static_cast<double>(k) * bin < to; ++k) {
      const double share = std::min(to, static_cast<double>(k + 1) * bin) -
                           std::max(from, static_cast<double>(k) * bin);
      for (std::size_t c = 0; c < 3; ++c) {
        out[k][c] += std::max(share, 0.0) / bin * mean[c];
      }
    }
  }
  return out;
}

double turn_time(std::span<const Step> steps) {
  double longest = 0.0;
  for (const Step& step : steps) {
    if (step.a_p > 0 && step.turns > 0) {
      longest = std::max(longest, step.duration / step.turns);
    }
  }
  return longest;
}

/// A first place: every bin of the record is tried as the start.
std::optional<double> coarse_start(std::span<const Step> steps, const Recorded& record,
                                   const Means& means, double bin) {
  const double end = steps.back().time + 0.5 * steps.back().duration;
  const auto count = static_cast<std::size_t>(end / bin) + 1;
  const std::vector<Vector> computed = computed_bins(steps, record.reads, bin, count);
  const double zero = record.time.front();
  const auto there = static_cast<std::size_t>((record.time.back() - zero) / bin);
  std::vector<Vector> measured(there);
  for (std::size_t k = 0; k < there; ++k) {
    const double from = zero + static_cast<double>(k) * bin;
    measured[k] = means.mean(from, from + bin).value_or(Vector{});
  }
  const std::size_t least = std::min(count, there) * 6 / 10;
  const auto lags = static_cast<std::ptrdiff_t>(count + there);
  std::vector<double> found(static_cast<std::size_t>(lags), -1.0);
  numerics::for_each_index(
      found.size(),
      [&](std::size_t i) {
        const std::ptrdiff_t lag =
            static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(count);
        const std::size_t from = lag < 0 ? static_cast<std::size_t>(-lag) : 0;
        Correlation sum;
        for (std::size_t k = from; k < count; ++k) {
          const auto m = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(k) + lag);
          if (m >= there) break;
          sum.add(computed[k], measured[m], 1.0);
        }
        if (sum.weight() >= static_cast<double>(std::max<std::size_t>(least, 8))) {
          found[i] = sum.value();
        }
      },
      16);
  const auto best = std::ranges::max_element(found);
  if (best == found.end() || !(*best > 0)) return std::nullopt;
  const auto lag =
      static_cast<double>(best - found.begin()) - static_cast<double>(count);
  return zero + lag * bin;
}

/// How well rows agree with the record at a place.
double agreement(std::span<const Step* const> rows, const Means& means, double start,
                 double stretch) {
  Correlation sum;
  for (const Step* row : rows) {
    const double middle = start + stretch * row->time;
    const double half = 0.5 * stretch * row->duration;
    if (const auto mean = means.mean(middle - half, middle + half)) {
      sum.add(mean_of(*row, means.reads()), *mean, row->duration);
    }
  }
  return sum.value();
}

/// The start at which rows agree best, looked for about a place and finer and finer.
double best_start(std::span<const Step* const> rows, const Means& means, double about,
                  double reach, double stretch) {
  constexpr int tries = 20;
  double best = about;
  for (int round = 0; round < 4; ++round) {
    double most = -2.0;
    const double center = best;
    for (int i = -tries; i <= tries; ++i) {
      const double start = center + reach * i / tries;
      const double value = agreement(rows, means, start, stretch);
      if (value > most) {
        most = value;
        best = start;
      }
    }
    reach *= 2.0 / tries;
  }
  return best;
}

/// Rows evenly taken.
std::vector<const Step*> some_of(std::span<const Step> steps, std::size_t most) {
  std::vector<const Step*> out;
  const std::size_t every = std::max<std::size_t>(1, steps.size() / most);
  for (std::size_t i = 0; i < steps.size(); i += every) out.push_back(&steps[i]);
  return out;
}

/// A line through the starts of the parts of the program.
void stretch_over_parts(std::span<const Step* const> rows, const Means& means,
                        double reach, Alignment& out) {
  std::vector<double> at;
  std::vector<double> start;
  for (int p = 0; p < parts; ++p) {
    const std::size_t n = rows.size();
    const auto part = rows.subspan(n * static_cast<std::size_t>(p) / parts,
                                   n * static_cast<std::size_t>(p + 1) / parts -
                                       n * static_cast<std::size_t>(p) / parts);
    if (part.size() < 10) continue;
    const double found = best_start(part, means, out.start, reach, 1.0);
    if (agreement(part, means, found, 1.0) < 0.7) continue;
    at.push_back(0.5 * (part.front()->time + part.back()->time));
    start.push_back(found);
  }
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
  if (agreement(rows, means, from, 1 + slope) >
      agreement(rows, means, out.start, 1.0)) {
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

bool is_air(const Step& step) noexcept {
  return step.layers.empty() && step.cause == Cause::air;
}

/// Whether a row of air follows another one at once, at the same speed.
bool goes_on_in_air(const Step& row, const Step& next) noexcept {
  constexpr double at_once = 0.01;  // [s]
  const double gap = next.time - row.time - 0.5 * (row.duration + next.duration);
  return is_air(next) && next.spindle == row.spindle && gap < at_once;
}

/// Whether two speeds of the spindle take the same power in air.
bool is_same_speed(double a, double b) noexcept {
  constexpr double same = 0.005;
  return std::abs(a - b) <= same * a;
}

/// Into the mean of its speed, or of all where the speed does not matter.
void add_air(const Step& step, const Vector& mean, Reads reads, Idle& idle) {
  const auto at = std::ranges::find_if(idle.speeds, [&](const Idle::AtSpeed& one) {
    return reads == Reads::forces || is_same_speed(one.spindle, step.spindle);
  });
  Idle::AtSpeed& one = at != idle.speeds.end()
                           ? *at
                           : idle.speeds.emplace_back(Idle::AtSpeed{step.spindle});
  const double air = one.air + step.duration;
  for (std::size_t c = 0; c < 3; ++c) {
    one.offset[c] += step.duration / air * (mean[c] - one.offset[c]);
  }
  one.air = air;
}

}  // namespace

std::array<double, 3> Idle::at(double spindle) const noexcept {
  const auto nearest = std::ranges::min_element(
      speeds, {}, [&](const AtSpeed& one) { return std::abs(one.spindle - spindle); });
  return nearest == speeds.end() ? std::array<double, 3>{} : nearest->offset;
}

bool Idle::has(double spindle) const noexcept {
  return std::ranges::any_of(
      speeds, [&](const AtSpeed& one) { return is_same_speed(one.spindle, spindle); });
}

Recorded by_lines(std::span<const Step> steps, const Recorded& record,
                  LineNumbers numbers) {
  struct Span {
    double from, to;
  };
  std::map<std::int64_t, Span> in_program;
  for (const Step& step : steps) {
    if (numbers == LineNumbers::block && step.block < 0) continue;
    const double from = step.time - 0.5 * step.duration;
    const auto [at, is_new] = in_program.try_emplace(
        numbers == LineNumbers::line ? std::int64_t{step.line} : step.block,
        Span{from, from});
    at->second.to = from + step.duration;
  }
  Recorded out{.reads = record.reads};
  const double step = sample_time(record);
  const std::size_t n = record.time.size();
  for (std::size_t i = 0, next = 0; i < n; i = next) {
    while (next < n && record.line[next] == record.line[i]) ++next;
    const auto found = in_program.find(record.line[i]);
    if (found == in_program.end()) continue;
    const auto [from, to] = found->second;
    const double first = record.time[i];
    // The logger may have stood still behind it.
    const double last =
        record.time[next - 1] +
        (next < n ? std::min(step, record.time[next] - record.time[next - 1]) : 0.0);
    // The ends of a line are known to a sample: of short ones nothing follows.
    const bool known = next - i >= samples_of_a_line && to > from;
    const double slower = known ? (last - first) / (to - from) : 1.0;
    for (std::size_t k = i; k < next; ++k) {
      const double part =
          last > first ? (record.time[k] - first) / (last - first) : 0.0;
      const double t = from + part * (to - from);
      if (!out.time.empty() && !(t > out.time.back())) continue;
      out.time.push_back(t);
      out.value.push_back(record.value[k]);
      out.clock.push_back(record.time[k]);
      out.slower.push_back(slower);
    }
  }
  return out;
}

std::optional<Alignment> align(std::span<const Step> steps, const Recorded& record) {
  const double turn = turn_time(steps);
  if (steps.empty() || record.time.size() < 2 || !(turn > 0) ||
      record.time.back() - record.time.front() < 10 * turn) {
    return std::nullopt;
  }
  const Means means(record);
  const double end = steps.back().time + 0.5 * steps.back().duration;
  const double bin = std::max({turn, end / most_bins, 2 * sample_time(record)});
  const auto start = coarse_start(steps, record, means, bin);
  if (!start) return std::nullopt;
  const std::vector<const Step*> rows = some_of(steps, most_compared);
  Alignment out;
  out.start = best_start(rows, means, *start, 1.5 * bin, 1.0);
  stretch_over_parts(rows, means, std::max(3 * bin, 0.02 * end), out);
  out.correlation = agreement(rows, means, out.start, out.stretch);
  return out;
}

double LaidOver::stretch(std::size_t from, std::size_t to) const noexcept {
  const std::vector<double>& slower = record.slower;
  if (slower.empty() || from >= std::min(to, slower.size())) return alignment.stretch;
  return alignment.stretch * slower[from + (std::min(to, slower.size()) - from) / 2];
}

double settling_time(const Recorded& record) noexcept {
  return settled * sample_time(record);
}

std::array<double, 3> mean_of(const Step& step, Reads reads) noexcept {
  switch (reads) {
    case Reads::forces:
      return step.forces.mean;
    case Reads::power:
      return {step.forces.power, 0.0, 0.0};
    case Reads::torque:
      return {step.forces.torque_mean, 0.0, 0.0};
  }
  return {};
}

RecordedSteps over_steps(std::span<const Step> steps, const LaidOver& over) {
  const Recorded& record = over.record;
  const Alignment& alignment = over.alignment;
  RecordedSteps out;
  const Means means(record);
  const auto window = [&](const Step& step) {
    const double middle = alignment.start + alignment.stretch * step.time;
    const double half = 0.5 * alignment.stretch * step.duration;
    return std::pair(middle - half, middle + half);
  };
  for (std::size_t i = 0, next = 0; i < steps.size(); i = next) {
    next = i + 1;
    if (!is_air(steps[i])) continue;
    while (next < steps.size() && goes_on_in_air(steps[next - 1], steps[next])) ++next;
    Step air = steps[i];
    const double from = window(steps[i]).first;
    const double to = window(steps[next - 1]).second;
    air.duration = to - from;
    // Times are known roughly.
    const double rest = std::max(0.2 * (to - from), settling_time(record));
    if (!(to - from > 2 * rest)) continue;
    const auto mean = means.mean(from + rest, to - rest);
    if (mean) add_air(air, *mean, record.reads, out.idle);
  }
  std::erase_if(out.idle.speeds, [](const auto& one) { return one.air <= least_air; });
  out.idle.found = !out.idle.speeds.empty();
  for (const Step& step : steps) {
    StepRecord& one = out.steps.emplace_back();
    const Vector offset = out.idle.at(step.spindle);
    const auto [from, to] = window(step);
    const auto [a, b] = means.within(from, to);
    one.there = b > a && from >= record.time.front() && to <= record.time.back();
    if (out.idle.found && record.reads != Reads::forces &&
        !out.idle.has(step.spindle)) {
      one.there = false;
      if (step.a_p > 0) out.speed_without_air = step.spindle;
    }
    if (!one.there) continue;
    one.stretch = over.stretch(a, b);
    for (std::size_t i = a; i < b; ++i) {
      Vector F = record.value[i];
      for (std::size_t c = 0; c < 3; ++c) {
        F[c] -= offset[c];
        one.mean[c] += F[c] / static_cast<double>(b - a);
      }
      one.peak_xy = std::max(one.peak_xy, std::hypot(F[0], F[1]));
    }
  }
  return out;
}

}  // namespace trochoid::engagement
