#include <trochoid/signal/tap_test.h>

#include <trochoid/numerics/spectrum.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

namespace trochoid::signal {
namespace {

/// A stretch of the force above its threshold.
struct Pulse {
  std::size_t begin = 0;
  std::size_t end = 0;  ///< past the last sample
  double peak = 0.0;    ///< [N], with its sign
};

/// A hit: a pulse, and whether others follow within its block.
struct Hit {
  Pulse pulse;
  std::size_t start = 0;  ///< of its block, a little before the pulse
  TapHit told;
};

struct Hits {
  std::vector<Hit> hits;
  std::size_t length = 0;  ///< of the blocks, in samples; 0: no hit was found
};

/// @brief Hits and the length of their blocks.
/// @param block  [s]; 0: until the next hit, a second at most
Hits find_hits(const TapRecord& record, double block);

/// Of the largest force: a pulse begins above the one and ends below the other.
constexpr double begins = 0.1;
constexpr double ends = 0.03;
/// A hammer that strikes again within this time has bounced [s].
constexpr double bounce_time = 0.1;
constexpr double longest_block = 1.0;  ///< that is chosen [s]
/// What is taken before a pulse, as a fraction of the block.
constexpr double lead = 0.01;
/// So many samples at the very limit of a channel are an overload.
constexpr int overload_samples = 3;

std::vector<Pulse> pulses_of(std::span<const double> force) {
  double largest = 0.0;
  for (const double f : force) {
    largest = std::max(largest, std::abs(f));
  }
  std::vector<Pulse> out;
  bool inside = false;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const double size = std::abs(force[i]);
    if (!inside && size > begins * largest) {
      inside = true;
      out.push_back({.begin = i, .end = i + 1, .peak = force[i]});
    } else if (inside) {
      inside = size >= ends * largest;
      out.back().end = i + 1;
      if (size > std::abs(out.back().peak)) {
        out.back().peak = force[i];
      }
    }
  }
  return out;
}

/// Largest number of equal samples in a row at the limit of a channel.
int at_limit(std::span<const double> values, std::size_t from, std::size_t to) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  int most = 0;
  const double size = std::max(std::abs(*low), std::abs(*high));
  for (const double limit : {*low, *high}) {
    if (std::abs(limit) < 0.5 * size) {
      continue;  // the rest of a channel that only goes the other way
    }
    int run = 0;
    for (std::size_t i = from; i < std::min(to, values.size()); ++i) {
      run = values[i] == limit ? run + 1 : 0;
      most = std::max(most, run);
    }
  }
  return most;
}

/// Why a hit cannot be used; empty: it can.
std::string fault_of(const TapRecord& record, const Hit& hit, const Hits& hits,
                     const Pulse* second) {
  const double dt = 1 / record.sample_rate;
  if (hit.start + hits.length > record.force.size()) {
    return "the record ends before its block does";
  }
  if (second != nullptr) {
    return fmt::format(
        "the hammer strikes again {:.3g} ms later, with {:.3g} N (a double "
        "hit)",
        1e3 * dt * static_cast<double>(second->begin - hit.pulse.begin), second->peak);
  }
  const std::size_t end = hit.start + hits.length;
  if (at_limit(record.force, hit.start, end) >= overload_samples) {
    return "the force stands at the limit of its channel (overload)";
  }
  if (at_limit(record.response, hit.start, end) >= overload_samples) {
    return "the response stands at the limit of its channel (overload)";
  }
  return {};
}

Hits find_hits(const TapRecord& record, double block) {
  const std::vector<Pulse> pulses = pulses_of(record.force);
  const double rate = record.sample_rate;
  const double apart = (block > 0 ? std::min(block, bounce_time) : bounce_time) * rate;
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < pulses.size(); ++i) {
    if (i == 0 || static_cast<double>(pulses[i].begin - pulses[i - 1].end) > apart) {
      first.push_back(i);
    }
  }
  Hits out;
  if (first.empty()) {
    return out;
  }
  double length = block > 0 ? block * rate : longest_block * rate;
  for (std::size_t k = 0; k < first.size() && !(block > 0); ++k) {
    const double next = k + 1 < first.size()
                            ? static_cast<double>(pulses[first[k + 1]].begin)
                            : static_cast<double>(record.force.size());
    const double room = next - static_cast<double>(pulses[first[k]].begin);
    // The end of the record may cut off the last hit, but not shorten all others.
    if (k + 1 < first.size() || k == 0) {
      length = std::min(length, room * (1 - 2 * lead));
    }
  }
  out.length =
      numerics::fast_length(std::max<std::size_t>(static_cast<std::size_t>(length), 2));
  const auto before = static_cast<std::size_t>(lead * static_cast<double>(out.length));
  for (const std::size_t i : first) {
    Hit hit{.pulse = pulses[i],
            .start = pulses[i].begin - std::min(pulses[i].begin, before)};
    const bool again =
        i + 1 < pulses.size() && pulses[i + 1].begin < hit.start + out.length;
    hit.told = {.time = static_cast<double>(hit.pulse.begin) / rate,
                .peak = hit.pulse.peak,
                .fault = fault_of(record, hit, out, again ? &pulses[i + 1] : nullptr)};
    out.hits.push_back(hit);
  }
  return out;
}

using Complex = std::complex<double>;

/// What the exponential window leaves where it is needed and not given.
constexpr double usual_end = 0.01;
/// A response that has fallen to less than this of its most needs no window.
constexpr double died_out = 0.01;
/// Force below this part of its largest power does not excite: 20 dB.
constexpr double least_power = 0.01;
constexpr std::size_t least_lines = 8;
constexpr std::size_t kept_widths = 4;  ///< of the pulse, by the force window

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double rms_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

/// Force and response of a block, from which what stood there before is taken.
struct Block {
  std::vector<double> force, response;
  std::size_t pulse_begin = 0, pulse_end = 0;
};

Block block_of(const TapRecord& record, const Hit& hit, std::size_t length) {
  const auto cut = [&](const std::vector<double>& values) {
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(hit.start);
    std::vector<double> out(from, from + static_cast<std::ptrdiff_t>(length));
    const double level = mean_of({out.data(), hit.pulse.begin - hit.start});
    for (double& v : out) v -= level;
    return out;
  };
  return {.force = cut(record.force),
          .response = cut(record.response),
          .pulse_begin = hit.pulse.begin - hit.start,
          .pulse_end = hit.pulse.end - hit.start};
}

/// Zero after the pulse. Filters against aliases ring on for some widths of it: these are
/// kept, and half a cosine of as many leads to zero.
void apply_force_window(Block& block) {
  const std::size_t width = kept_widths * (block.pulse_end - block.pulse_begin);
  const std::size_t from = block.pulse_end + width;
  for (std::size_t i = from; i < block.force.size(); ++i) {
    const double x = static_cast<double>(i - from) / static_cast<double>(width);
    block.force[i] *= x < 1 ? 0.5 * (1 + std::cos(std::numbers::pi * x)) : 0.0;
  }
}

/// M-21; before the hit the window is 1, which the noise there does not feel.
void apply_exponential(Block& block, double decay, double rate) {
  if (decay == 0) {
    return;
  }
  for (std::size_t i = 0; i < block.force.size(); ++i) {
    const double w = std::exp(-decay * static_cast<double>(i) / rate);
    block.force[i] *= w;
    block.response[i] *= w;
  }
}

/// How much of its most a response still has in the last tenth of its block.
double left_at_end(const Block& block) {
  const std::size_t tenth = std::max<std::size_t>(block.response.size() / 10, 1);
  const std::span<const double> all = block.response;
  double most = 0.0;
  for (std::size_t i = 0; i + tenth <= all.size(); i += tenth) {
    most = std::max(most, rms_of(all.subspan(i, tenth)));
  }
  return most > 0 ? rms_of(all.last(tenth)) / most : 0.0;
}

/// SpectrumSums over the hits, line by line.
struct SpectrumSums {
  std::vector<double> ff, xx;
  std::vector<Complex> xf;
};

void add(SpectrumSums& sums, const Block& block) {
  const auto F = numerics::real_spectrum(block.force);
  const auto X = numerics::real_spectrum(block.response);
  sums.ff.resize(F.size());
  sums.xx.resize(F.size());
  sums.xf.resize(F.size());
  for (std::size_t k = 0; k < F.size(); ++k) {
    sums.ff[k] += std::norm(F[k]);
    sums.xx[k] += std::norm(X[k]);
    sums.xf[k] += X[k] * std::conj(F[k]);
  }
}

/// The part of the samples that stand out: few of a blow, many of what rings.
double busy_part(std::span<const double> values) {
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  const auto busy = std::ranges::count_if(
      values, [&](double v) { return std::abs(v) > begins * largest; });
  return static_cast<double>(busy) / static_cast<double>(values.size());
}

/// Why there is no response where no hit can be used.
std::string why_no_hit(const TapRecord& record, const std::vector<TapHit>& hits) {
  constexpr double clearly = 3.0;
  if (hits.empty()) return "the force is zero: there is no hit";
  if (busy_part(record.force) > clearly * busy_part(record.response)) {
    return "no hit can be used: the channel of the force rings, and the other one has "
           "the blows; are they exchanged?";
  }
  return "no hit can be used: " + hits.front().fault;
}

/// Fill in the lines up to where the hammer excites (M-20).
void take(const SpectrumSums& sums, int used, FrfEstimator estimator,
          TapResponse& out) {
  const double step = 2 * std::numbers::pi / out.block;
  const double most = *std::max_element(sums.ff.begin(), sums.ff.end());
  for (std::size_t k = 1; k + 1 < sums.ff.size(); ++k) {
    if (sums.ff[k] < least_power * most) {
      break;
    }
    out.excited = step * static_cast<double>(k);
    out.omega.push_back(out.excited);
    const double cross = std::norm(sums.xf[k]);
    if (estimator == FrfEstimator::H1) {
      out.H.push_back(sums.xf[k] / sums.ff[k]);
    } else {
      out.H.push_back(cross > 0 ? sums.xx[k] / std::conj(sums.xf[k]) : Complex(0.0));
    }
    if (used > 1) {
      const double both = sums.ff[k] * sums.xx[k];
      out.coherence.push_back(both > 0 ? cross / both : 0.0);
    }
  }
}

}  // namespace

TapResponse frequency_response(const TapRecord& record, const TapOptions& options) {
  if (record.force.size() != record.response.size() || !(record.sample_rate > 0)) {
    throw std::invalid_argument(
        "frequency_response: channels of one length and a rate");
  }
  TapResponse out;
  const Hits hits = find_hits(record, options.block);
  out.block = static_cast<double>(hits.length) / record.sample_rate;
  std::vector<Block> blocks;
  for (const Hit& hit : hits.hits) {
    out.hits.push_back(hit.told);
    if (hit.told.fault.empty()) {
      blocks.push_back(block_of(record, hit, hits.length));
    }
  }
  if (blocks.empty()) {
    out.fault = why_no_hit(record, out.hits);
    return out;
  }
  double left = 0.0;
  for (const Block& block : blocks) {
    left = std::max(left, left_at_end(block));
  }
  out.window_end =
      options.window_end > 0 ? options.window_end : (left > died_out ? usual_end : 1.0);
  out.decay = -std::log(out.window_end) / out.block;
  if (out.decay > 0) {
    const double end = out.window_end;
    out.noise_bandwidth =
        0.5 * -std::log(end) * (1 - end * end) / ((1 - end) * (1 - end));  // M-23
  }
  SpectrumSums sums;
  for (Block& block : blocks) {
    apply_force_window(block);
    apply_exponential(block, out.decay, record.sample_rate);
    add(sums, block);
  }
  take(sums, static_cast<int>(blocks.size()), options.estimator, out);
  if (out.omega.size() < least_lines) {
    out.fault =
        "the hammer excites fewer than 8 lines: its pulse is too long for "
        "blocks of this length, or the force channel is not the hammer's";
  }
  return out;
}

}  // namespace trochoid::signal
