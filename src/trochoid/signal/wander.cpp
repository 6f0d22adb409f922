#include <trochoid/signal/wander.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numeric>
#include <optional>

namespace trochoid::signal {

namespace {

using Channels = std::array<std::vector<double>, 3>;
using Complex = std::complex<double>;

constexpr std::size_t least_turns = 16;
constexpr std::size_t samples_of_turn = 12;  ///< of a turn
constexpr int lines_at_most = 12;
constexpr double samples_of_line = 3.0;
constexpr double clearly = 0.7;  ///< of what a constant speed foretells, in squares
constexpr double least_wander = 5e-3;  ///< [rad], rms: less changes nothing

/// Lines of one turn, channel by channel, order by order from 1.
using Lines = std::vector<Complex>;

struct SpindleTurns {
  int lines = 0;
  std::vector<Lines> turn;
  std::vector<double> middle;  ///< [rad]
};

/// Whole turns from the first sample on.
SpindleTurns turns_of(const Channels& channels, std::span<const double> angle) {
  SpindleTurns out;
  const double count = std::floor((angle.back() - angle.front()) / unit::turn + 1e-6);
  if (!(count >= static_cast<double>(least_turns)) ||
      static_cast<double>(angle.size()) <
          count * static_cast<double>(samples_of_turn)) {
    return out;
  }
  const double per_turn = static_cast<double>(angle.size()) / count;
  out.lines = static_cast<int>(
      std::clamp(per_turn / samples_of_line, 1.0, static_cast<double>(lines_at_most)));
  std::array<double, 3> mean{};
  for (std::size_t c = 0; c < 3; ++c) {
    mean[c] = std::reduce(channels[c].begin(), channels[c].end()) /
              static_cast<double>(angle.size());
  }
  const auto orders = static_cast<std::size_t>(out.lines);
  std::size_t i = 0;
  for (double b = 0.0; b < count; b += 1.0) {
    const double from = angle[0] + b * unit::turn;
    Lines lines(3 * orders);
    double n = 0.0;
    for (; i < angle.size() && angle[i] < from + unit::turn - 1e-9; ++i) {
      const Complex step = std::polar(1.0, -angle[i]);
      for (std::size_t c = 0; c < 3; ++c) {
        Complex e = channels[c][i] - mean[c];
        for (std::size_t k = 0; k < orders; ++k) lines[c * orders + k] += e *= step;
      }
      n += 1.0;
    }
    for (Complex& one : lines) one /= std::max(n, 1.0);
    out.turn.push_back(std::move(lines));
    out.middle.push_back(from + 0.5 * unit::turn);
  }
  return out;
}

/// Lines as they would be at another phase.
Lines turned(const Lines& lines, int orders, double delta) {
  Lines out = lines;
  const auto count = static_cast<std::size_t>(orders);
  for (std::size_t j = 0; j < out.size(); ++j) {
    out[j] *= std::polar(1.0, -delta * static_cast<double>(j % count + 1));
  }
  return out;
}

/// Phase of some lines against others, small (S-10).
double phase_against(const Lines& lines, const Lines& reference, int orders) {
  const auto count = static_cast<std::size_t>(orders);
  double above = 0.0;
  double below = 0.0;
  for (std::size_t j = 0; j < lines.size(); ++j) {
    const auto k = static_cast<double>(j % count + 1);
    above += k * (std::conj(reference[j]) * lines[j]).imag();
    below += k * k * std::norm(reference[j]);
  }
  return below > 0.0 ? above / below : 0.0;
}

/// Phase of each turn against the mean of all, found outwards from the middle.
std::vector<double> phases_of(const SpindleTurns& turns) {
  const std::size_t count = turns.turn.size();
  const std::size_t middle = count / 2;
  std::vector<double> delta(count, 0.0);
  Lines reference = turns.turn[middle];
  for (int round = 0; round < 3; ++round) {
    const auto find = [&](std::size_t b, double near) {
      double d = round == 0 ? near : delta[b];
      for (int step = 0; step < 2; ++step) {
        d += std::clamp(phase_against(turned(turns.turn[b], turns.lines, d), reference,
                                      turns.lines),
                        -0.1, 0.1);
      }
      delta[b] = d;
    };
    find(middle, 0.0);
    for (std::size_t b = middle + 1; b < count; ++b) find(b, delta[b - 1]);
    for (std::size_t b = middle; b-- > 0;) find(b, delta[b + 1]);
    std::ranges::fill(reference, Complex{});
    for (std::size_t b = 0; b < count; ++b) {
      const Lines lines = turned(turns.turn[b], turns.lines, delta[b]);
      for (std::size_t j = 0; j < lines.size(); ++j) {
        reference[j] += lines[j] / static_cast<double>(count);
      }
    }
  }
  return delta;
}

/// Straight lines through the values of any turns in a row, each in a few steps.
class LinesThrough {
 public:
  explicit LinesThrough(std::span<const double> values)
      : values_(values), y_(values.size() + 1), by_(values.size() + 1) {
    for (std::size_t b = 0; b < values.size(); ++b) {
      y_[b + 1] = y_[b] + values[b];
      by_[b + 1] = by_[b] + static_cast<double>(b) * values[b];
    }
  }

  /// @param leave_out  whether the value at that place is not looked at
  [[nodiscard]] double at(std::size_t place, std::size_t reach, bool leave_out) const {
    const std::size_t from = place > reach ? place - reach : 0;
    const std::size_t to = std::min(values_.size(), place + reach + 1);
    const auto f = static_cast<double>(from);
    const auto t = static_cast<double>(to);
    const auto here = static_cast<double>(place);
    const double left = leave_out ? 1.0 : 0.0;
    const double n = t - f - left;
    const double x = 0.5 * (t - f) * (f + t - 1.0) - left * here;
    const double xx = squares(t) - squares(f) - left * here * here;
    const double y = y_[to] - y_[from] - left * values_[place];
    const double xy = by_[to] - by_[from] - left * here * values_[place];
    const double sxx = xx - x * x / n;
    return y / n + (sxx > 0.0 ? (xy - x * y / n) / sxx * (here - x / n) : 0.0);
  }

 private:
  /// Of all whole numbers below n.
  static double squares(double n) { return (n - 1.0) * n * (2.0 * n - 1.0) / 6.0; }

  std::span<const double> values_;
  std::vector<double> y_;
  std::vector<double> by_;
};

/// Each turn from a line through those within some turns of it.
std::vector<double> smoothed(std::span<const double> values, std::size_t reach,
                             bool leave_out) {
  const LinesThrough lines(values);
  std::vector<double> out;
  for (std::size_t b = 0; b < values.size(); ++b) {
    out.push_back(lines.at(b, reach, leave_out));
  }
  return out;
}

double mean_square(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

/// The phases smoothed as far as the record asks; none: a straight line does.
std::optional<std::vector<double>> wandering(std::span<const double> delta) {
  const std::size_t all = delta.size();
  const double constant = mean_square(delta, smoothed(delta, all, true));
  double least = constant;
  std::size_t best = all;
  for (std::size_t reach = 2; reach < all / 2; reach *= 2) {
    const double foretold = mean_square(delta, smoothed(delta, reach, true));
    if (!(foretold < least)) continue;
    least = foretold;
    best = reach;
  }
  if (!(least < clearly * constant)) return std::nullopt;
  std::vector<double> out = smoothed(delta, best, false);
  const double size = mean_square(out, smoothed(out, all, false));
  if (!(std::sqrt(size) > least_wander)) return std::nullopt;
  return out;
}

/// Size of each turn against the mean of all.
std::vector<double> sizes_of(const SpindleTurns& turns, std::span<const double> delta) {
  Lines mean(turns.turn.front().size());
  std::vector<Lines> aligned;
  for (std::size_t b = 0; b < turns.turn.size(); ++b) {
    aligned.push_back(turned(turns.turn[b], turns.lines, delta[b]));
    for (std::size_t j = 0; j < mean.size(); ++j) {
      mean[j] += aligned[b][j] / static_cast<double>(turns.turn.size());
    }
  }
  double power = 0.0;
  for (const Complex& one : mean) power += std::norm(one);
  std::vector<double> out;
  for (const Lines& lines : aligned) {
    double sum = 0.0;
    for (std::size_t j = 0; j < mean.size(); ++j) {
      sum += (std::conj(mean[j]) * lines[j]).real();
    }
    out.push_back(power > 0.0 ? sum / power : 1.0);
  }
  return out;
}

}  // namespace

Growth growth_of_force(const Channels& channels, std::span<const double> angle) {
  if (angle.size() < 2) return {};
  const SpindleTurns turns = turns_of(channels, angle);
  if (turns.turn.empty()) return {};
  const std::vector<double> size = sizes_of(turns, phases_of(turns));
  const std::size_t n = size.size();
  const std::vector<double> line = smoothed(size, n, false);
  double rest =
      0.0;  // of turns less than the next two apart: slow changes are no noise
  for (std::size_t b = 1; b + 1 < n; ++b) {
    const double bow = size[b] - 0.5 * (size[b - 1] + size[b + 1]);
    rest += bow * bow / 1.5;
  }
  const double variance = rest / static_cast<double>(n - 2);
  const double turns_of_record = (angle.back() - angle.front()) / unit::turn;
  return {(line.back() - line.front()) * turns_of_record / static_cast<double>(n - 1),
          std::sqrt(12.0 * variance / static_cast<double>(n))};
}

Wander follow_speed(const Channels& channels, std::span<const double> angle) {
  Wander out;
  if (angle.size() < 2) return out;
  const SpindleTurns turns = turns_of(channels, angle);
  if (turns.turn.empty()) return out;
  const auto delta = wandering(phases_of(turns));
  if (!delta) return out;
  const std::size_t last = delta->size() - 1;
  out.slowest = INFINITY;
  out.fastest = 0.0;
  for (std::size_t b = 0; b < last; ++b) {
    const double speed = 1.0 + ((*delta)[b + 1] - (*delta)[b]) / unit::turn;
    out.slowest = std::min(out.slowest, speed);
    out.fastest = std::max(out.fastest, speed);
  }
  std::size_t b = 0;
  for (const double phi : angle) {  // beyond the ends at the speed next to them
    while (b + 2 <= last && phi > turns.middle[b + 1]) ++b;
    const double x = (phi - turns.middle[b]) / unit::turn;
    out.angle.push_back(phi + (*delta)[b] + x * ((*delta)[b + 1] - (*delta)[b]));
  }
  if (std::ranges::adjacent_find(out.angle, std::greater_equal<>()) !=
      out.angle.end()) {
    return {};  // no spindle turns back
  }
  return out;
}

}  // namespace trochoid::signal
