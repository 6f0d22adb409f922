#include <trochoid/surface/flat_trace.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace trochoid::surface {
namespace {

/// How far the feed may be from the stated one, and how much of a turn the last turn of a
/// trace may drift from one feed that is tried to the next.
constexpr double feed_range = 0.03;
constexpr double drift = 0.04;
struct Line {
  double level = 0.0;
  double slope = 0.0;
};

/// The line through a trace, about its middle.
Line line_through(const Trace& trace, double middle) {
  double sum = 0.0;
  double xx = 0.0;
  double xz = 0.0;
  for (std::size_t i = 0; i < trace.x.size(); ++i) {
    const double x = trace.x[i] - middle;
    sum += trace.z[i];
    xx += x * x;
    xz += x * trace.z[i];
  }
  return {sum / static_cast<double>(trace.x.size()), xx > 0 ? xz / xx : 0.0};
}

}  // namespace

FlatTrace without_line(const Trace& trace) {
  const double middle = 0.5 * (trace.x.front() + trace.x.back());
  const Line line = line_through(trace, middle);
  FlatTrace flat;
  for (std::size_t i = 0; i < trace.x.size(); ++i) {
    flat.x.push_back(trace.x[i] - trace.x.front());
    flat.z.push_back(trace.z[i] - line.level - line.slope * (trace.x[i] - middle));
  }
  return flat;
}

std::vector<double> FlatTrace::folded(double feed, std::size_t bins) const {
  std::vector<double> sum(bins, 0.0);
  std::vector<double> count(bins, 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto k = std::min(
        bins - 1,
        static_cast<std::size_t>(turn_of(x[i] / feed) * static_cast<double>(bins)));
    sum[k] += z[i];
    count[k] += 1.0;
  }
  double last = 0.0;
  for (std::size_t k = 0; k < bins; ++k) {
    if (count[k] > 0) last = sum[k] / count[k];
  }
  for (std::size_t k = 0; k < bins; ++k) {
    last = sum[k] = count[k] > 0 ? sum[k] / count[k] : last;
  }
  return sum;
}

double average_roughness(const std::vector<double>& z) {
  const double mean =
      std::accumulate(z.begin(), z.end(), 0.0) / static_cast<double>(z.size());
  double sum = 0.0;
  for (const double value : z) sum += std::abs(value - mean);
  return sum / static_cast<double>(z.size());
}

double feed_that_repeats(const FlatTrace& flat, double stated) {
  constexpr std::size_t bins = 64;
  const double step = drift * stated * stated / flat.length();
  const int n = static_cast<int>(std::ceil(feed_range * stated / step));
  double best = stated;
  double largest = -1.0;
  for (int i = -n; i <= n; ++i) {
    const double feed = stated + i * step;
    const std::vector<double> mean = flat.folded(feed, bins);
    double squares = 0.0;
    for (const double m : mean) squares += m * m;
    if (squares > largest) {
      largest = squares;
      best = feed;
    }
  }
  return best;
}

double readings_as_one(const std::vector<double>& r) {
  double power = 0.0;
  for (const double e : r) power += e * e;
  double sum = 1.0;
  for (std::size_t lag = 1; lag < r.size() / 4; ++lag) {
    double product = 0.0;
    for (std::size_t i = 0; i + lag < r.size(); ++i) product += r[i] * r[i + lag];
    if (!(product > 0)) break;
    sum += 2 * product / power;
  }
  return sum;
}

double repeating_share(const FlatTrace& flat, const std::vector<double>& r,
                       double feed) {
  constexpr std::size_t bins = 64;
  std::array<std::vector<double>, 2> sum{std::vector<double>(bins),
                                         std::vector<double>(bins)};
  std::array<std::vector<double>, 2> count = sum;
  double power = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double turns = flat.x[i] / feed;
    const auto half = static_cast<std::size_t>(turns) % 2;
    const auto k = std::min(bins - 1, static_cast<std::size_t>(turn_of(turns) * bins));
    sum[half][k] += r[i];
    count[half][k] += 1.0;
    power += r[i] * r[i] / static_cast<double>(r.size());
  }
  double product = 0.0;
  for (std::size_t k = 0; k < bins; ++k) {
    if (count[0][k] > 0 && count[1][k] > 0) {
      product += sum[0][k] / count[0][k] * sum[1][k] / count[1][k] / bins;
    }
  }
  return power > 0 ? std::max(product / power, 0.0) : 0.0;
}

}  // namespace trochoid::surface
