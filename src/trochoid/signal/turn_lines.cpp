#include <trochoid/signal/turn_lines.h>

#include <trochoid/numerics/median.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numeric>

namespace trochoid::signal {

namespace {

using Channels = std::array<std::vector<double>, 3>;
using Samples = std::array<std::span<const double>, 3>;
using Complex = std::complex<double>;

// Of steady_windows.
constexpr std::size_t least_windows = 6 * quarters_of_turn;  ///< of a pass
constexpr std::size_t most_turns = 8;                        ///< that are averaged
constexpr double tolerance = 0.004;                          ///< of the force
constexpr double little = 0.003;      ///< of the force: beyond it a rest of an entry
constexpr double drift = 0.25;        ///< the same of the means, where no air tells it
constexpr double slow_change = 0.1;   ///< of the force over the pass: wear, no entry
constexpr double chance = 4.0;        ///< standard errors
constexpr double least_entry = 0.15;  ///< of the force, where no air is beside it
constexpr std::size_t gap = 8;        ///< windows that an entry may look steady for
constexpr std::size_t unseen = 8;  ///< one of so many windows of an entry is not seen
constexpr double most_mean = 3.0;  ///< of the amplitudes, where the offset is unknown

// Of air_by_means.
constexpr std::size_t first_turns = 4;  ///< windows within the first two turns
constexpr double clear = 8.0;           ///< standard errors between air and cut
constexpr double like_air = 0.05;       ///< of the step from air to cut
constexpr double few_lines = 0.1;       ///< the same, of what lines may add to noise

/// Sums of one quarter of a turn.
struct Quarter {
  double count = 0.0;
  std::array<double, 3> squares{};
  std::vector<Complex> sum;  ///< shape (3, lines + 1)
};

std::array<double, 3> means_of(const Channels& channels) {
  std::array<double, 3> out{};
  for (std::size_t c = 0; c < out.size(); ++c) {
    const auto n = static_cast<double>(channels[c].size());
    out[c] = std::reduce(channels[c].begin(), channels[c].end()) / n;
  }
  return out;
}

/// The means of all are taken out first, or they would leak into the lines of a turn that
/// holds no whole number of samples.
Quarter quarter_of(const Samples& channels, std::span<const double> angle,
                   std::span<const double> mean, int lines) {
  const auto orders = static_cast<std::size_t>(lines) + 1;
  Quarter out{0.0, {}, std::vector<Complex>(3 * orders)};
  out.count = static_cast<double>(angle.size());
  for (std::size_t i = 0; i < angle.size(); ++i) {
    const Complex turn = std::polar(1.0, -angle[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double y = channels[c][i] - mean[c];
      out.squares[c] += y * y;
      Complex e = y;
      for (std::size_t m = 0; m < orders; ++m) {
        out.sum[c * orders + m] += e;
        e = {e.real() * turn.real() - e.imag() * turn.imag(),
             e.real() * turn.imag() + e.imag() * turn.real()};
      }
    }
  }
  return out;
}

/// One turn from its quarters.
void add_window(std::span<const Quarter> quarters, std::span<const double> mean,
                TurnLines& out) {
  const auto orders = static_cast<std::size_t>(out.lines) + 1;
  Quarter all = quarters.front();
  for (const Quarter& q : quarters.subspan(1)) {
    all.count += q.count;
    for (std::size_t c = 0; c < 3; ++c) all.squares[c] += q.squares[c];
    std::ranges::transform(all.sum, q.sum, all.sum.begin(), std::plus());
  }
  const double n = std::max(all.count, 1.0);
  for (std::size_t c = 0; c < 3; ++c) {
    out.value.push_back(mean[c] + all.sum[c * orders].real() / n);
  }
  const double freedom = std::max(n - 2.0 * static_cast<double>(orders), 1.0);
  for (std::size_t c = 0; c < 3; ++c) {
    double explained = std::norm(all.sum[c * orders]) / n;
    for (std::size_t m = 1; m < orders; ++m) {
      const double power = std::norm(all.sum[c * orders + m]);
      out.value.push_back(2.0 * std::sqrt(power) / n);
      explained += 2.0 * power / n;
    }
    out.noise.push_back(std::max(0.0, all.squares[c] - explained) / freedom);
  }
  out.count.push_back(all.count);
}

/// Means of the features over many windows, each in a few steps.
class Averages {
 public:
  explicit Averages(const TurnLines& lines) : features_(lines.features()) {
    sums_.assign(features_, 0.0);
    sums_.reserve((lines.windows() + 1) * features_);
    for (std::size_t k = 0; k < lines.windows(); ++k) {
      for (std::size_t i = 0; i < features_; ++i) {
        sums_.push_back(sums_[k * features_ + i] + lines.at(k)[i]);
      }
    }
  }

  [[nodiscard]] double of(std::size_t feature, const Windows& w) const {
    return (sums_[w.end * features_ + feature] - sums_[w.begin * features_ + feature]) /
           static_cast<double>(w.size());
  }

 private:
  std::size_t features_;
  std::vector<double> sums_;
};

/// What the windows of a pass are compared with.
struct Reference {
  Windows windows;
  std::vector<double> value;  ///< of each feature [N]
  std::vector<double> se;     ///< of one turn [N]
  double force = 0.0;         ///< [N]
  double drift = 0.0;         ///< of the means, part of the force over the pass
};

/// Squared differences between the halves of some windows, and their middle and ends.
double unevenness(const Averages& mean, std::size_t features, const Windows& w) {
  const std::size_t quarter = w.size() / 4;
  const std::size_t middle = w.begin + w.size() / 2;
  double sum = 0.0;
  for (std::size_t i = 0; i < features; ++i) {
    const double step = mean.of(i, {w.begin, middle}) - mean.of(i, {middle, w.end});
    const double bow = mean.of(i, {w.begin + quarter, w.end - quarter}) - mean.of(i, w);
    sum += step * step + bow * bow;
  }
  return sum;
}

/// A quarter of the pass in its middle half.
Windows flattest(const Averages& mean, std::size_t features, const Windows& pass) {
  const std::size_t length = std::max<std::size_t>(8, pass.size() / 4);
  const std::size_t step = std::max<std::size_t>(1, length / 16);
  const std::size_t from = pass.begin + pass.size() / 4;
  const std::size_t last = std::max(from, pass.begin + 3 * pass.size() / 4 - length);
  Windows best{from, from + length};
  double least = INFINITY;
  for (std::size_t k = from; k <= last; k += step) {
    const double here = unevenness(mean, features, {k, k + length});
    if (!(here < least)) continue;
    least = here;
    best = {k, k + length};
  }
  return best;
}

/// Of one turn, from how much turns differ from the next.
double turn_error(const TurnLines& lines, std::size_t feature, const Windows& w) {
  std::vector<double> differences;
  for (std::size_t k = w.begin; k + quarters_of_turn < w.end; ++k) {
    differences.push_back(
        std::abs(lines.at(k + quarters_of_turn)[feature] - lines.at(k)[feature]));
  }
  constexpr double of_normal = 0.6745;
  return differences.empty()
             ? 0.0
             : numerics::median(std::move(differences)) / (of_normal * std::sqrt(2.0));
}

/// Size of the force: what the means are above air, and the lines.
double force_of(const Reference& reference, const Pass& pass) {
  double means = 0.0;
  double amplitudes = 0.0;
  for (std::size_t i = 0; i < reference.value.size(); ++i) {
    const double v = reference.value[i];
    if (i < 3) {
      means += v * v;
    } else {
      amplitudes += 0.5 * v * v;
    }
  }
  constexpr double least_of_means = 0.01;  // squared: of what may be offsets
  const bool known = pass.air_before || pass.air_after;
  return std::sqrt(amplitudes + (known ? means
                                       : std::clamp(most_mean * most_mean * amplitudes,
                                                    least_of_means * means, means)));
}

Reference reference_of(const TurnLines& lines, const Averages& mean, const Pass& pass) {
  Reference out;
  out.windows = flattest(mean, lines.features(), pass.windows);
  for (std::size_t i = 0; i < lines.features(); ++i) {
    out.value.push_back(mean.of(i, out.windows));
    out.se.push_back(turn_error(lines, i, out.windows));
  }
  out.force = force_of(out, pass);
  out.drift = pass.air_before && pass.air_after ? slow_change : drift;
  return out;
}

/// Whether anything in it turns with the spindle: a constant has no entry.
bool turns(const Reference& reference) {
  constexpr double nothing_turns = 1e-12;  // of the squares
  double means = 0.0;
  double lines = 0.0;
  for (std::size_t i = 0; i < reference.value.size(); ++i) {
    (i < 3 ? means : lines) += reference.value[i] * reference.value[i];
  }
  return lines > nothing_turns * means;
}

/// How far the middles of some windows are from one another.
double distance(const Windows& a, const Windows& b) {
  return 0.5 * std::abs(static_cast<double>(a.begin + a.end) -
                        static_cast<double>(b.begin + b.end));
}

/// Whether windows differ from the reference by more than a slow change and chance do.
/// @param away     from the reference, part of the pass
/// @param of_mean  standard error of their mean over that of one turn, and of the reference
bool differ(const Averages& mean, const Reference& reference, const Windows& w,
            double away, double of_mean) {
  for (std::size_t i = 0; i < reference.value.size(); ++i) {
    const double slow = i < 3 ? reference.drift : slow_change;
    if (std::abs(mean.of(i, w) - reference.value[i]) >
        (tolerance + slow * away) * reference.force +
            chance * of_mean * reference.se[i]) {
      return true;
    }
  }
  return false;
}

/// Windows that are the outer ends of some that differ.
struct Different {
  std::vector<std::uint8_t> before;  ///< of those before the reference
  std::vector<std::uint8_t> after;   ///< of those after it
};

Different different(const Averages& mean, const Reference& reference,
                    const Windows& pass) {
  Different out{std::vector<std::uint8_t>(pass.size(), 0),
                std::vector<std::uint8_t>(pass.size(), 0)};
  const double of_reference =
      quarters_of_turn / static_cast<double>(reference.windows.size());
  for (std::size_t turns = 1;
       turns <= most_turns && 4 * quarters_of_turn * turns <= pass.size(); turns *= 2) {
    const std::size_t width = quarters_of_turn * (turns - 1) + 1;
    const double of_mean = std::sqrt(1.0 / static_cast<double>(turns) + of_reference);
    for (std::size_t k = pass.begin; k + width <= pass.end; ++k) {
      const Windows w{k, k + width};
      const double away =
          distance(w, reference.windows) / static_cast<double>(pass.size());
      if (!differ(mean, reference, w, away, of_mean)) continue;
      out.before[k - pass.begin] = 1;
      out.after[k + width - 1 - pass.begin] = 1;
    }
  }
  return out;
}

/// How many windows from one end on differ, in a row but for short gaps.
template <class It>
std::size_t run_of_different(It begin, It end) {
  std::size_t last = 0;
  for (It it = begin; it != end; ++it) {
    const auto here = static_cast<std::size_t>(it - begin) + 1;
    if (*it != 0) last = here;
    if (here > last + gap) break;
  }
  return last;
}

/// Largest difference of the outermost turn of a pass.
double difference_at(const TurnLines& lines, const Reference& reference,
                     std::size_t window) {
  double out = 0.0;
  for (std::size_t i = 0; i < reference.value.size(); ++i) {
    out = std::max(out, std::abs(lines.at(window)[i] - reference.value[i]));
  }
  return out;
}

/// Features as straight lines over the middle half of a steady part: what wears slowly
/// stays on them.
class SteadyLines {
 public:
  SteadyLines(const TurnLines& lines, const Averages& mean, const Windows& steady)
      : middle_{steady.begin + steady.size() / 4,
                steady.begin + steady.size() / 4 + steady.size() / 2} {
    const std::size_t half = middle_.begin + middle_.size() / 2;
    const double apart = 0.5 * static_cast<double>(middle_.size());
    for (std::size_t i = 0; i < lines.features(); ++i) {
      value_.push_back(mean.of(i, middle_));
      slope_.push_back(
          (mean.of(i, {half, middle_.end}) - mean.of(i, {middle_.begin, half})) /
          apart);
      se_.push_back(turn_error(lines, i, middle_));
    }
  }

  [[nodiscard]] const Windows& middle() const noexcept { return middle_; }

  /// Whether the mean over some windows is off the lines.
  [[nodiscard]] bool left_by(const Averages& mean, const Windows& w,
                             double least) const {
    const double off = 0.5 * (static_cast<double>(w.begin + w.end) -
                              static_cast<double>(middle_.begin + middle_.end));
    const auto length = static_cast<double>(middle_.size());
    const double turns = 1.0 + static_cast<double>(w.size() - 1) / quarters_of_turn;
    const double of_mean =
        std::sqrt(1.0 / turns + quarters_of_turn / length *
                                    (1.0 + 12.0 * off * off / (length * length)));
    for (std::size_t i = 0; i < value_.size(); ++i) {
      if (std::abs(mean.of(i, w) - value_[i] - slope_[i] * off) >
          least + chance * of_mean * se_[i]) {
        return true;
      }
    }
    return false;
  }

 private:
  Windows middle_;
  std::vector<double> value_;
  std::vector<double> slope_;
  std::vector<double> se_;
};

/// What is left of a steady part without what its ends still hold of entry and exit.
Windows without_rest(const TurnLines& lines, const Averages& mean,
                     const Windows& steady, double force) {
  if (steady.size() < least_windows) return steady;
  const SteadyLines straight(lines, mean, steady);
  const Windows middle = straight.middle();
  Windows out = steady;
  for (std::size_t turns = 1; turns <= most_turns; turns *= 2) {
    const std::size_t width = quarters_of_turn * (turns - 1) + 1;
    if (4 * width > steady.size()) break;
    for (std::size_t k = steady.begin; k + width <= steady.end; ++k) {
      const bool before = k < middle.begin;
      const bool after = k + width > middle.end;
      if ((!before && !after) ||
          !straight.left_by(mean, {k, k + width}, little * force)) {
        continue;
      }
      if (before) out.begin = std::max(out.begin, k + (width + 1) / 2);
      if (after && !before) out.end = std::min(out.end, k + (width + 1) / 2);
    }
  }
  return {std::min(out.begin, middle.begin), std::max(out.end, middle.end)};
}

/// Steps from the means of the first two turns to those in the middle of the record.
struct AirMean {
  std::array<double, 3> air{};
  double step = 0.0;
  double se = 0.0;  ///< of one turn
};

double away_from(std::span<const double> means, std::span<const double> air) {
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    sum += (means[c] - air[c]) * (means[c] - air[c]);
  }
  return std::sqrt(sum);
}

/// @param order  of the windows, from the end that is looked at inwards
AirMean air_mean(const TurnLines& lines, std::span<const std::size_t> order) {
  AirMean out;
  double noise = 0.0;
  for (std::size_t j = 0; j <= first_turns; ++j) {
    for (std::size_t c = 0; c < 3; ++c) {
      out.air[c] += lines.means(order[j])[c] / (first_turns + 1.0);
      noise += lines.noise[3 * order[j] + c] / lines.count[order[j]];
    }
  }
  out.se = std::sqrt(noise / (first_turns + 1.0));
  std::array<double, 3> middle{};
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> all;
    for (std::size_t k = order.size() / 4; k < 3 * order.size() / 4; ++k) {
      all.push_back(lines.means(order[k])[c]);
    }
    middle[c] = numerics::median(std::move(all));
  }
  out.step = away_from(middle, out.air);
  return out;
}

/// Whether the lines of some windows are no more than their noise makes of them.
bool only_noise(const TurnLines& lines, std::span<const std::size_t> windows,
                double allowed) {
  double power = 0.0;
  double expected = 0.0;
  for (const std::size_t k : windows) {
    power += lines.line_power(k);
    for (std::size_t c = 0; c < 3; ++c) {
      expected += 4.0 * lines.lines * lines.noise[3 * k + c] / lines.count[k];
    }
  }
  return power <=
         1.5 * expected + allowed * allowed * static_cast<double>(windows.size());
}

/// How many windows from one end on are air.
std::size_t air_from(const TurnLines& lines, std::span<const std::size_t> order) {
  const AirMean mean = air_mean(lines, order);
  if (!(mean.step > clear * mean.se)) return 0;
  const double most = like_air * mean.step + chance * mean.se;
  std::size_t count = 0;
  while (count < order.size() &&
         away_from(lines.means(order[count]), mean.air) <= most) {
    ++count;
  }
  const auto middle = order.subspan(order.size() / 4, order.size() / 2);
  const bool air = count > quarters_of_turn && count < order.size() &&
                   only_noise(lines, order.first(count), few_lines * mean.step) &&
                   !only_noise(lines, middle, 0.0);
  return air ? count : 0;
}

}  // namespace

double TurnLines::line_power(std::size_t window) const {
  double sum = 0.0;
  for (const double a : at(window).subspan(channels)) sum += a * a;
  return sum;
}

TurnLines turn_lines(const Channels& channels, std::span<const double> angle,
                     std::span<const std::size_t> begins, int lines) {
  TurnLines out;
  out.lines = lines;
  const std::array<double, 3> mean = means_of(channels);
  std::vector<Quarter> quarters;
  for (std::size_t q = 0; q + 1 < begins.size(); ++q) {
    const std::size_t n = begins[q + 1] - begins[q];
    Samples part;
    for (std::size_t c = 0; c < 3; ++c) {
      part[c] = std::span(channels[c]).subspan(begins[q], n);
    }
    quarters.push_back(quarter_of(part, angle.subspan(begins[q], n), mean, lines));
  }
  for (std::size_t k = 0; k + quarters_of_turn <= quarters.size(); ++k) {
    add_window(std::span(quarters).subspan(k, quarters_of_turn), mean, out);
  }
  return out;
}

Windows steady_windows(const TurnLines& lines, const Pass& pass) {
  const Windows all = pass.windows;
  if (all.size() < least_windows) return all;
  const Averages mean(lines);
  const Reference reference = reference_of(lines, mean, pass);
  if (!(reference.force > 0.0) || !turns(reference)) return all;
  const Different differs = different(mean, reference, all);
  const auto inner = static_cast<std::ptrdiff_t>(reference.windows.begin - all.begin);
  const auto outer = static_cast<std::ptrdiff_t>(all.end - reference.windows.end);
  std::size_t before =
      run_of_different(differs.before.begin(), differs.before.begin() + inner);
  std::size_t after =
      run_of_different(differs.after.rbegin(), differs.after.rbegin() + outer);
  const double least = least_entry * reference.force;
  if (!pass.air_before && difference_at(lines, reference, all.begin) < least) {
    before = 0;
  }
  if (!pass.air_after && difference_at(lines, reference, all.end - 1) < least) {
    after = 0;
  }
  before = std::min(before + before / unseen, static_cast<std::size_t>(inner));
  after = std::min(after + after / unseen, static_cast<std::size_t>(outer));
  const Windows steady{all.begin + before, all.end - after};
  const Windows rest = without_rest(lines, mean, steady, reference.force);
  return {before > 0 || pass.air_before ? rest.begin : steady.begin,
          after > 0 || pass.air_after ? rest.end : steady.end};
}

void take_idle_out(std::span<const Windows> air, TurnLines& lines) {
  if (air.empty()) return;
  struct Idle {
    double at = 0.0;
    std::array<double, 3> mean{};
  };
  std::vector<Idle> idle;
  for (const Windows& w : air) {
    Idle& one = idle.emplace_back();
    one.at = 0.5 * static_cast<double>(w.begin + w.end - 1);
    for (std::size_t k = w.begin; k < w.end; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        one.mean[c] += lines.means(k)[c] / static_cast<double>(w.size());
      }
    }
  }
  std::size_t next = 0;
  for (std::size_t k = 0; k < lines.windows(); ++k) {
    const auto here = static_cast<double>(k);
    while (next + 1 < idle.size() && idle[next].at < here) ++next;
    const Idle& b = idle[next];
    const Idle& a = idle[next > 0 ? next - 1 : 0];
    const double x =
        b.at > a.at ? std::clamp((here - a.at) / (b.at - a.at), 0.0, 1.0) : 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      lines.value[k * lines.features() + c] -= a.mean[c] + x * (b.mean[c] - a.mean[c]);
    }
  }
}

std::vector<Windows> air_by_means(const TurnLines& lines) {
  const std::size_t n = lines.windows();
  if (n < least_windows) return {};
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<Windows> out;
  const std::size_t head = air_from(lines, order);
  if (head > 0) out.push_back({0, head});
  std::ranges::reverse(order);
  const std::size_t tail = air_from(lines, order);
  if (tail > 0 && head + tail < n) out.push_back({n - tail, n});
  return out;
}

}  // namespace trochoid::signal
