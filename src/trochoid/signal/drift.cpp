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

struct Line {
  double middle = 0.0;
  double mean = 0.0;
  double slope = 0.0;
  double mean_se = 0.0;
  double slope_se = 0.0;
};

/// A line through the means of the idle revolutions.
/// @param least  variance of a mean: a few of them may agree by chance
Line line_through(std::span<const double> x, std::span<const double> y, bool sloped,
                  double least) {
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
  const double variance = std::max(free > 0.0 ? rest / free : 0.0, least);
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

std::optional<Drift> idle_drift(const Channels& channels, std::span<const double> angle,
                                std::span<const Part> idle, const Part& cut) {
  check(channels, angle);
  std::vector<Part> turns;
  std::size_t samples = 0;
  for (const Part& part : idle) {
    samples += part.size();
    for (const Part& t : whole_turns(angle.subspan(part.begin, part.size()))) {
      turns.push_back({t.begin + part.begin, t.end + part.begin});
    }
  }
  if (turns.empty()) return std::nullopt;
  Drift drift;
  const bool far_apart = turns.back().begin - turns.front().begin > angle.size() / 2;
  drift.sloped = (far_apart || 4 * samples >= angle.size()) && turns.size() >= 3;
  const auto last = static_cast<double>(angle.size() - 1);
  const double in_cut = 0.5 * static_cast<double>(cut.begin + cut.end) / last;
  std::vector<double> x(turns.size());
  std::vector<double> y(turns.size());
  for (std::size_t c = 0; c < 3; ++c) {
    double white =
        0.0;  // variance of a mean, were all that varies in a turn white noise
    for (std::size_t k = 0; k < turns.size(); ++k) {
      const auto& part = turns[k];
      const auto n = static_cast<double>(part.end - part.begin);
      x[k] = 0.5 * static_cast<double>(part.begin + part.end - 1) / last;
      y[k] = 0.0;
      for (std::size_t i = part.begin; i < part.end; ++i) y[k] += channels[c][i] / n;
      double squares = 0.0;
      for (std::size_t i = part.begin; i < part.end; ++i) {
        squares += (channels[c][i] - y[k]) * (channels[c][i] - y[k]);
      }
      white += squares / (n * n) / static_cast<double>(turns.size());
    }
    const Line line = line_through(x, y, drift.sloped, white);
    auto& d = drift.channel[c];
    d.first = line.mean - line.slope * line.middle;
    d.last = line.mean + line.slope * (1.0 - line.middle);
    d.first_se = std::hypot(line.mean_se, line.slope_se * line.middle);
    d.last_se = std::hypot(line.mean_se, line.slope_se * (1.0 - line.middle));
    drift.se_in_cut[c] =
        std::hypot(line.mean_se, line.slope_se * (in_cut - line.middle));
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
