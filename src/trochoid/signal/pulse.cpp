#include <trochoid/signal/pulse.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/median.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trochoid::signal {

namespace {

constexpr std::size_t fewest = 3;      ///< pulses: two turns can be compared
constexpr double most_change = 0.3;    ///< of a turn against the one before
constexpr double whole_slack = 0.25;   ///< of several turns, in turns
constexpr double most_missing = 20.0;  ///< turns from one pulse to the next

/// Times at which the channel rises through its middle.
std::vector<double> rising_edges(std::span<const double> values,
                                 std::span<const double> time) {
  std::vector<double> edges;
  if (values.empty()) return edges;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const double middle = 0.5 * (*least + *greatest);
  const double low = 0.75 * *least + 0.25 * *greatest;
  bool armed = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] < low) {
      armed = true;
    } else if (armed && values[i] >= middle) {
      const double part = (middle - values[i - 1]) / (values[i] - values[i - 1]);
      edges.push_back(time[i - 1] + part * (time[i] - time[i - 1]));
      armed = false;
    }
  }
  return edges;
}

double usual_turn(const std::vector<double>& edges) {
  std::vector<double> turns;
  for (std::size_t j = 1; j < edges.size(); ++j)
    turns.push_back(edges[j] - edges[j - 1]);
  return numerics::median(std::move(turns));
}

/// The pulses with those that are missing; empty, with the reason, where they are not
/// one a turn.
std::vector<double> filled_in(const std::vector<double>& edges, PulseAngle& out) {
  std::vector<double> pulses{edges.front()};
  double turn = usual_turn(edges);
  for (std::size_t j = 1; j < edges.size(); ++j) {
    const double step = edges[j] - edges[j - 1];
    const double ratio = step / turn;
    const double whole = std::max(1.0, std::round(ratio));
    const double slack = whole > 1.0 ? whole_slack : most_change;
    if (std::abs(ratio - whole) > slack || whole > most_missing) {
      out.why = fmt::format(
          "from the pulse at {:.6g} s to the next at {:.6g} s are {:.3g} turns of the one "
          "before: they are not one a turn, or the spindle started or stopped",
          edges[j - 1], edges[j], ratio);
      return {};
    }
    turn = step / whole;
    for (double k = 1.0; k <= whole; ++k) pulses.push_back(edges[j - 1] + k * turn);
    pulses.back() = edges[j];
    out.filled += static_cast<std::size_t>(whole) - 1;
    out.fastest = std::max(out.fastest, unit::turn / turn);
    out.slowest = j == 1 ? unit::turn / turn : std::min(out.slowest, unit::turn / turn);
  }
  return pulses;
}

}  // namespace

PulseAngle angle_of_pulses(std::span<const double> values,
                           std::span<const double> time) {
  if (values.size() != time.size()) {
    throw std::invalid_argument(
        fmt::format("{} values at {} times", values.size(), time.size()));
  }
  PulseAngle out;
  const auto edges = rising_edges(values, time);
  out.found = edges.size();
  if (edges.size() < fewest) {
    out.why = fmt::format("it has {} rising edge{}: at least {} pulses are needed",
                          edges.size(), edges.size() == 1 ? "" : "s", fewest);
    return out;
  }
  const auto pulses = filled_in(edges, out);
  if (pulses.empty()) return out;
  out.angle.reserve(time.size());
  std::size_t j = 0;
  for (const double t : time) {
    while (j + 2 < pulses.size() && t >= pulses[j + 1]) ++j;
    const double part = (t - pulses[j]) / (pulses[j + 1] - pulses[j]);
    out.angle.push_back(unit::turn * (static_cast<double>(j) + part));  // S-7
  }
  return out;
}

}  // namespace trochoid::signal
