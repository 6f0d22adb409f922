#include <trochoid/signal/drift.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trochoid::signal {

namespace {

using Channels = std::array<std::vector<double>, 3>;

/// Consecutive whole revolutions.
std::vector<Part> whole_turns(std::span<const double> angle) {
  std::vector<Part> turns;
  if (angle.empty()) return turns;
  std::size_t begin = 0;
  for (std::size_t i = 1; i < angle.size(); ++i) {
    const auto number = static_cast<double>(turns.size() + 1);
    if (angle[i] < angle[0] + number * unit::turn - 1e-9) continue;
    turns.push_back({begin, i});
    begin = i;
  }
  return turns;
}

/// How much the forces vary within a part, without a straight line through each.
double activity(const Channels& channels, const Part& part) {
  const auto n = static_cast<double>(part.end - part.begin);
  const double middle = 0.5 * (n - 1.0);
  double sum = 0.0;
  for (const auto& y : channels) {
    double mean = 0.0;
    for (std::size_t i = part.begin; i < part.end; ++i) mean += y[i] / n;
    double yy = 0.0;
    double xy = 0.0;
    double xx = 0.0;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const double x = static_cast<double>(i - part.begin) - middle;
      yy += (y[i] - mean) * (y[i] - mean);
      xy += x * (y[i] - mean);
      xx += x * x;
    }
    sum += (yy - (xx > 0.0 ? xy * xy / xx : 0.0)) / n;
  }
  return std::sqrt(std::max(0.0, sum));
}

/// Number of revolutions at the beginning of a list that are idle.
std::size_t idle_run(std::span<const double> level, double limit) {
  const auto at = std::find_if(level.begin(), level.end(),
                               [&](double value) { return value > limit; });
  return static_cast<std::size_t>(at - level.begin());
}

struct Line {
  double middle = 0.0;
  double mean = 0.0;
  double slope = 0.0;
  double mean_se = 0.0;
  double slope_se = 0.0;
};

/// A line through the means of the idle revolutions.
Line line_through(std::span<const double> x, std::span<const double> y, bool sloped) {
  const auto n = static_cast<double>(x.size());
  Line line;
  for (std::size_t i = 0; i < x.size(); ++i) {
    line.middle += x[i] / n;
    line.mean += y[i] / n;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - line.middle) * (x[i] - line.middle);
    xy += (x[i] - line.middle) * (y[i] - line.mean);
  }
  if (sloped && xx > 0.0) line.slope = xy / xx;
  double rest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = y[i] - line.mean - line.slope * (x[i] - line.middle);
    rest += r * r;
  }
  const double free = n - (sloped ? 2.0 : 1.0);
  const double variance = free > 0.0 ? rest / free : 0.0;
  line.mean_se = std::sqrt(variance / n);
  if (sloped && xx > 0.0) line.slope_se = std::sqrt(variance / xx);
  return line;
}

void check(const Channels& channels, std::span<const double> angle) {
  for (const auto& y : channels) {
    if (y.size() != angle.size()) {
      throw std::invalid_argument("drift: one angle a sample is needed");
    }
  }
}

}  // namespace

std::vector<Part> idle_parts(const Channels& channels, std::span<const double> angle) {
  check(channels, angle);
  constexpr std::size_t fewest = 2;
  const auto turns = whole_turns(angle);
  if (turns.size() < fewest + 2) return {};
  std::vector<double> level(turns.size());
  std::transform(turns.begin(), turns.end(), level.begin(),
                 [&](const Part& part) { return activity(channels, part); });
  auto sorted = level;
  std::sort(sorted.begin(), sorted.end());
  const double cutting = sorted[sorted.size() * 9 / 10];
  // Records made by a program may be exactly idle: a thousandth of the cut is nothing.
  const double limit =
      std::min(0.2 * cutting, std::max(2.0 * sorted.front(), 1e-3 * cutting));
  const auto at_start = idle_run(level, limit);
  if (at_start == turns.size()) return {};
  std::reverse(level.begin(), level.end());
  const auto at_end = idle_run(level, limit);
  std::vector<Part> parts;
  if (at_start > fewest) parts.push_back({0, turns[at_start - 2].end});
  if (at_end > fewest) {
    parts.push_back({turns[turns.size() - at_end + 1].begin, turns.back().end});
  }
  return parts;
}

Part steady_part(const Channels& channels, std::span<const double> angle) {
  const std::vector<Part> turns = whole_turns(angle);
  if (turns.size() < 4) return {0, angle.size()};
  std::vector<double> level;
  level.reserve(turns.size());
  for (const Part& part : turns) level.push_back(activity(channels, part));
  std::vector<double> sorted = level;
  const auto quartile =
      sorted.begin() + static_cast<std::ptrdiff_t>(3 * sorted.size() / 4);
  std::nth_element(sorted.begin(), quartile, sorted.end());
  const double least = 0.9 * *quartile;
  std::size_t best = 0;
  std::size_t best_count = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < level.size(); ++k) {
    count = level[k] >= least ? count + 1 : 0;
    if (count > best_count) {
      best_count = count;
      best = k + 1 - count;
    }
  }
  return {turns[best].begin, turns[best + best_count - 1].end};
}

std::optional<Drift> idle_drift(const Channels& channels,
                                std::span<const double> angle) {
  Drift drift;
  drift.idle = idle_parts(channels, angle);
  if (drift.idle.empty()) return std::nullopt;
  std::size_t idle = 0;
  for (const auto& part : drift.idle) idle += part.end - part.begin;
  std::vector<Part> turns;
  for (const auto& part : drift.idle) {
    for (const auto& t :
         whole_turns(angle.subspan(part.begin, part.end - part.begin))) {
      turns.push_back({t.begin + part.begin, t.end + part.begin});
    }
  }
  drift.sloped =
      (drift.idle.size() == 2 || 4 * idle >= angle.size()) && turns.size() >= 3;
  const auto last = static_cast<double>(angle.size() - 1);
  std::vector<double> x(turns.size());
  std::vector<double> y(turns.size());
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < turns.size(); ++k) {
      const auto& part = turns[k];
      const auto n = static_cast<double>(part.end - part.begin);
      x[k] = 0.5 * static_cast<double>(part.begin + part.end - 1) / last;
      y[k] = 0.0;
      for (std::size_t i = part.begin; i < part.end; ++i) y[k] += channels[c][i] / n;
    }
    const Line line = line_through(x, y, drift.sloped);
    auto& d = drift.channel[c];
    d.first = line.mean - line.slope * line.middle;
    d.last = line.mean + line.slope * (1.0 - line.middle);
    d.first_se = std::hypot(line.mean_se, line.slope_se * line.middle);
    d.last_se = std::hypot(line.mean_se, line.slope_se * (1.0 - line.middle));
  }
  return drift;
}

void remove_drift(Channels& channels, const Drift& drift) {
  for (std::size_t c = 0; c < 3; ++c) {
    const auto& d = drift.channel[c];
    const auto last = static_cast<double>(channels[c].size()) - 1.0;
    for (std::size_t i = 0; i < channels[c].size(); ++i) {
      const double x = last > 0.0 ? static_cast<double>(i) / last : 0.0;
      channels[c][i] -= d.first + (d.last - d.first) * x;
    }
  }
}

}  // namespace trochoid::signal
