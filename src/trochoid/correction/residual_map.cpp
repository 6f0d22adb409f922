#include <trochoid/correction/residual_map.h>

#include <trochoid/correction/learning.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trochoid::correction {

namespace {

constexpr double turn = 2 * std::numbers::pi;
/// Harmonics of a command that are followed to the table, and samples of a clipped one.
constexpr int harmonics_followed = 60;
constexpr int samples = 512;
/// Harmonics below this part of the largest do not matter.
constexpr double negligible = 1e-7;

Harmonics clipped(const PeriodicMotion& wave, double low, double high) {
  std::vector<double> u;
  for (int i = 0; i < samples; ++i) {
    u.push_back(std::clamp(place_at(wave, turn * i / samples), low, high));
  }
  return harmonics_of_samples(u, harmonics_followed);
}

void drop_negligible(Harmonics& motion) {
  double largest = 0.0;
  for (const auto& c : motion.c) {
    largest = std::max(largest, std::abs(c));
  }
  while (!motion.c.empty() && std::abs(motion.c.back()) < negligible * largest) {
    motion.c.pop_back();
  }
}

Command command_of(const RigidCut& cut, const Strategy& strategy,
                   const MapSetting& setting, double Omega) {
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
    const auto table = [&](const Harmonics& u) {
      return table_response(setting.real, u, Omega, harmonics_followed);
    };
    command.wave = learn(wanted.motion, std::get<Harmonics>(command.wave),
                         setting.model, Omega, table)
                       .command;
  }
  return command;
}

}  // namespace

MapPoint residual_at(const RigidCut& cut, const Strategy& strategy,
                     const MapSetting& setting, double Omega) {
  const Command command = command_of(cut, strategy, setting, Omega);
  MapPoint point;
  if (!command.ok) {
    point.peak_difference = std::numeric_limits<double>::quiet_NaN();
    return point;
  }
  const Range range = range_of(command.wave);
  point.command_range = range.peak_to_peak();
  point.n_max = command.n_max;
  const double half = (setting.limits.stroke_high - setting.limits.stroke_low) / 2;
  point.clipped = point.command_range > 2 * half * (1 + 1e-9);
  const PeriodicMotion sent =
      point.clipped
          ? clipped(command.wave, range.middle() - half, range.middle() + half)
          : command.wave;
  Harmonics X = table_response(setting.real, sent, Omega, harmonics_followed);
  drop_negligible(X);
  point.peak_difference = peak_difference(cut.peaks(X));
  return point;
}

std::vector<MapPoint> residual_map(const RigidCut& cut,
                                   std::span<const Strategy> strategies,
                                   const MapSetting& setting,
                                   std::span<const double> Omega) {
  std::vector<MapPoint> map(strategies.size() * Omega.size());
  numerics::for_each_index(map.size(), [&](std::size_t i) {
    map[i] = residual_at(cut, strategies[i / Omega.size()], setting,
                         Omega[i % Omega.size()]);
  });
  return map;
}

double residual_speed(const RigidCut& cut, const Strategy& strategy,
                      const MapSetting& setting, double residual,
                      std::span<const double> range) {
  const double lowest = range.front();
  const double highest = range.back();
  constexpr int steps = 60;
  const auto over = [&](double Omega) {
    return residual_at(cut, strategy, setting, Omega).peak_difference > residual;
  };
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
