#include <trochoid/correction/residual_map.h>

#include <trochoid/base/units.h>
#include <trochoid/correction/learning.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace trochoid::correction {

namespace {

constexpr int clipped_samples = 512;  ///< of a clipped command
/// Harmonics below this fraction of the largest do not matter.
constexpr double negligible_waves = 1e-7;

Harmonics clipped(const PeriodicMotion& wave, double low, double high) {
  std::vector<double> u(clipped_samples);
  for (int i = 0; i < clipped_samples; ++i) {
    u[static_cast<std::size_t>(i)] =
        std::clamp(place_at(wave, unit::turn * i / clipped_samples), low, high);
  }
  return harmonics_of_samples(u, table_harmonics);
}

void drop_negligible(Harmonics& motion) {
  double largest = 0.0;
  for (const auto& c : motion.c) {
    largest = std::max(largest, std::abs(c));
  }
  while (!motion.c.empty() && std::abs(motion.c.back()) < negligible_waves * largest) {
    motion.c.pop_back();
  }
}

/// The table with a command, as learning meets it.
using TableWith = std::function<Harmonics(const Harmonics& u)>;

Command command_of(const RigidCut& cut, const Strategy& strategy,
                   const MapSetting& setting, double Omega, const TableWith& table) {
  CommandOptions options = setting.command;
  if (strategy.method != Method::inverse && strategy.method != Method::learning) {
    return command_for(strategy.motion, strategy.method, setting.model, Omega, options);
  }
  const Followed wanted =
      followed(cut, strategy.motion, setting.model, Omega, setting.limits);
  options.n_max = wanted.n_max;
  Command command =
      command_for(wanted.motion, Method::inverse, setting.model, Omega, options);
  if (strategy.method == Method::learning) {
    command.wave =
        learn(wanted.motion, std::get<Harmonics>(command.wave), setting.model, Omega,
              table, {.iterations = 15, .enough = 1e-3})
            .command;
  }
  return command;
}

/// What reaches the actuator, and the point but for what the flutes then do.
struct Sent {
  PeriodicMotion wave;
  MapPoint point;
};

Sent sent(const Command& command, const ActuatorLimits& limits) {
  const Range range = range_of(command.wave);
  Sent out{command.wave, {}};
  out.point.command_range = range.peak_to_peak();
  out.point.n_max = command.n_max;
  const double half = (limits.stroke_high - limits.stroke_low) / 2;
  out.point.clipped = out.point.command_range > 2 * half * (1 + 1e-9);
  if (out.point.clipped) {
    out.wave = clipped(command.wave, range.middle() - half, range.middle() + half);
  }
  return out;
}

MapPoint impossible() {
  MapPoint point;
  point.peak_difference = std::numeric_limits<double>::quiet_NaN();
  return point;
}

/// residual_at over a grid, for either kind of cut.
template <class Cut>
std::vector<MapPoint> map_of(const Cut& cut, std::span<const Strategy> strategies,
                             const MapSetting& setting, std::span<const double> Omega) {
  std::vector<MapPoint> map(strategies.size() * Omega.size());
  numerics::for_each_index(map.size(), [&](std::size_t i) {
    map[i] = residual_at(cut, strategies[i / Omega.size()], setting,
                         Omega[i % Omega.size()]);
  });
  return map;
}

}  // namespace

MapPoint residual_at(const RigidCut& cut, const Strategy& strategy,
                     const MapSetting& setting, double Omega) {
  const auto table = [&](const Harmonics& u) {
    return table_response(setting.real, u, Omega, table_harmonics);
  };
  const Command command = command_of(cut, strategy, setting, Omega, table);
  if (!command.ok) {
    return impossible();
  }
  Sent out = sent(command, setting.limits);
  Harmonics X = table_response(setting.real, out.wave, Omega, table_harmonics);
  drop_negligible(X);
  out.point.peak_difference = peak_difference(cut.peaks(X));
  return out.point;
}

MapPoint residual_at(const MovingCut& cut, const Strategy& strategy,
                     const MapSetting& setting, double Omega) {
  MovingCut moving = cut;
  moving.plant = setting.real;
  moving.setup.cut.Omega = Omega;
  const auto table = [&](const Harmonics& u) { return moving_flutes(moving, u).table; };
  const RigidCut rigid(cut.setup, cut.law);
  const Command command = command_of(rigid, strategy, setting, Omega, table);
  if (!command.ok) {
    return impossible();
  }
  Sent out = sent(command, setting.limits);
  const MovingFlutes flutes = moving_flutes(moving, out.wave);
  if (flutes.record.angle.empty()) {  // it grew beyond all bounds: no peaks to compare
    out.point.peak_difference = impossible().peak_difference;
  } else {
    out.point.peak_difference = peak_difference(flutes.flutes);
  }
  out.point.periodic = flutes.periodic;
  return out.point;
}

std::vector<MapPoint> residual_map(const RigidCut& cut,
                                   std::span<const Strategy> strategies,
                                   const MapSetting& setting,
                                   std::span<const double> Omega) {
  return map_of(cut, strategies, setting, Omega);
}

std::vector<MapPoint> residual_map(const MovingCut& cut,
                                   std::span<const Strategy> strategies,
                                   const MapSetting& setting,
                                   std::span<const double> Omega) {
  return map_of(cut, strategies, setting, Omega);
}

double residual_speed(const RigidCut& cut, const Strategy& strategy,
                      const MapSetting& setting, double residual,
                      std::span<const double> range) {
  return residual_speed(
      [&](double Omega) {
        return residual_at(cut, strategy, setting, Omega).peak_difference;
      },
      residual, range);
}

double residual_speed(const std::function<double(double)>& difference, double residual,
                      std::span<const double> range) {
  const double lowest = range.front();
  const double highest = range.back();
  constexpr int steps = 60;
  const auto over = [&](double Omega) { return difference(Omega) > residual; };
  double low = lowest;
  if (over(low)) {
    return 0.0;
  }
  for (int i = 1; i <= steps; ++i) {
    double high = lowest + (highest - lowest) * i / steps;
    if (over(high)) {
      for (int k = 0; k < 20; ++k) {
        const double middle = (low + high) / 2;
        (over(middle) ? high : low) = middle;
      }
      return low;
    }
    low = high;
  }
  return highest;
}

}  // namespace trochoid::correction
