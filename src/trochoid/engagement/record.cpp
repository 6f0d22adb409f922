#include <trochoid/engagement/record.h>

#include <trochoid/engagement/record_means.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace trochoid::engagement {

namespace {

using Vector = std::array<double, 3>;

/// Less air tells no offset [s].
constexpr double least_air = 0.05;

/// Slow channels lag behind: so many samples about a step are of the same cut, or of air.
constexpr double settled = 6.0;
/// So many samples tell how long a line took.
constexpr std::size_t samples_of_a_line = 70;

bool is_air(const Step& step) noexcept {
  return step.layers.empty() && step.cause == Cause::air;
}

/// Whether a row of air follows another one at once, at the same speed.
bool goes_on_in_air(const Step& row, const Step& next) noexcept {
  constexpr double at_once = 0.01;  // [s]
  const double gap = next.time - row.time - 0.5 * (row.duration + next.duration);
  return is_air(next) && next.spindle == row.spindle && gap < at_once;
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

/// What forces read in air, over the time: their channels drift.
class Baseline {
 public:
  void add(double time, const Vector& mean) { air_.push_back({time, mean}); }
  [[nodiscard]] bool empty() const noexcept { return air_.empty(); }

  /// On the line from the air before to the air after.
  [[nodiscard]] Vector at(double time) const noexcept {
    const auto after = std::ranges::lower_bound(air_, time, {}, &Air::time);
    if (after == air_.begin()) return after->mean;
    const auto before = std::prev(after);
    if (after == air_.end()) return before->mean;
    const double part = (time - before->time) / (after->time - before->time);
    Vector out{};
    for (std::size_t c = 0; c < 3; ++c) {
      out[c] = before->mean[c] + part * (after->mean[c] - before->mean[c]);
    }
    return out;
  }

 private:
  struct Air {
    double time;  ///< of its middle [s]
    Vector mean;
  };
  std::vector<Air> air_;
};

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

double LaidOver::stretch(std::size_t from, std::size_t to) const noexcept {
  const std::vector<double>& slower = record.slower;
  if (slower.empty() || from >= std::min(to, slower.size())) return alignment.stretch;
  return alignment.stretch * slower[from + (std::min(to, slower.size()) - from) / 2];
}

double LaidOver::clock_at(double time) const noexcept {
  const double t = alignment.start + alignment.stretch * time;
  const std::vector<double>& clock = record.clock;
  if (clock.size() < 2) return t;
  const auto after =
      std::upper_bound(record.time.begin() + 1, record.time.end() - 1, t);
  const auto i = static_cast<std::size_t>(after - record.time.begin());
  const double part = (t - record.time[i - 1]) / (record.time[i] - record.time[i - 1]);
  return clock[i - 1] + part * (clock[i] - clock[i - 1]);
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
  const auto window = [&](const Step& step, double part = 1.0) {
    const double middle = alignment.start + alignment.stretch * step.time;
    const double half = 0.5 * alignment.stretch * step.duration / part;
    return std::pair(middle - half, middle + half);
  };
  Baseline baseline;
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
    if (!mean) continue;
    add_air(air, *mean, record.reads, out.idle);
    if (record.reads == Reads::forces && to - from > 2 * rest + least_air) {
      baseline.add(0.5 * (from + to), *mean);
    }
  }
  std::erase_if(out.idle.speeds, [](const auto& one) { return one.air <= least_air; });
  out.idle.found = !out.idle.speeds.empty();
  for (const Step& step : steps) {
    StepRecord& one = out.steps.emplace_back();
    // The computed mean is that of a whole turn.
    const auto [from, to] =
        window(step, step.turns > 0 ? std::min(step.turns, 1.0) : 1.0);
    const Vector offset =
        baseline.empty() ? out.idle.at(step.spindle) : baseline.at(0.5 * (from + to));
    const auto [a, b] = means.within(from, to);
    one.time = over.clock_at(step.time);
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
