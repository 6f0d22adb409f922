#include <trochoid/numerics/spectrum.h>
#include <trochoid/signal/tap_hits.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace trochoid::signal {

namespace {

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

}  // namespace

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

}  // namespace trochoid::signal
