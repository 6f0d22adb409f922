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

/// The mean over one feed about each reading; nearer to an end the line through the first,
/// or last, turn and a half.
std::vector<double> running_mean(const FlatTrace& flat, double feed) {
  const std::size_t n = flat.x.size();
  std::vector<double> area(n, 0.0);  // from the first reading on
  for (std::size_t i = 1; i < n; ++i) {
    area[i] =
        area[i - 1] + 0.5 * (flat.z[i] + flat.z[i - 1]) * (flat.x[i] - flat.x[i - 1]);
  }
  const auto area_to = [&](double x) {
    const auto after = std::ranges::upper_bound(flat.x, x);
    if (after == flat.x.begin()) return 0.0;
    if (after == flat.x.end()) return area.back();
    const auto i = static_cast<std::size_t>(after - flat.x.begin());
    const double part = (x - flat.x[i - 1]) / (flat.x[i] - flat.x[i - 1]);
    return area[i - 1] + part * (area[i] - area[i - 1]);
  };
  const auto mean_at = [&](double x) {
    return (area_to(x + 0.5 * feed) - area_to(x - 0.5 * feed)) / feed;
  };
  const double first = 0.5 * feed;
  const double last = flat.length() - 0.5 * feed;
  const double first_slope = (mean_at(first + feed) - mean_at(first)) / feed;
  const double last_slope = (mean_at(last) - mean_at(last - feed)) / feed;
  std::vector<double> out(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double x = flat.x[i];
    out[i] = x < first  ? mean_at(first) + first_slope * (x - first)
             : x > last ? mean_at(last) + last_slope * (x - last)
                        : mean_at(x);
  }
  return out;
}

}  // namespace

FlatTrace without_waviness(const FlatTrace& flat, double feed) {
  constexpr double fewest = 5.0;  // turns
  constexpr double worth = 0.1;   // of the roughness
  if (flat.length() < fewest * feed) return flat;
  FlatTrace out = flat;
  std::vector<double> waves(flat.z.size(), 0.0);
  for (int pass = 0; pass < 2; ++pass) {  // the first leaves a part of each wave
    const std::vector<double> mean = running_mean(out, feed);
    for (std::size_t i = 0; i < out.z.size(); ++i) {
      out.z[i] -= mean[i];
      waves[i] += mean[i];
    }
  }
  if (average_roughness(waves) < worth * average_roughness(out.z)) return flat;
  const auto [lowest, highest] = std::ranges::minmax(waves);
  out.waviness = highest - lowest;
  return out;
}

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
