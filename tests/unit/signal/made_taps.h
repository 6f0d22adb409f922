// Records of hammer blows on known modes.
#pragma once

#include <trochoid/signal/tap_test.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

namespace made {

struct TapMode {
  double frequency = 0.0;  // [Hz]
  double zeta = 0.0;
  double mass = 0.0;  // [kg]
};

struct Taps {
  std::vector<double> at;  // [s]
  double peak = 500.0;     // [N]
  double width = 2e-4;     // of half a sine [s]
  double length = 1.0;     // of the record [s]
  double rate = 51200.0;   // [Hz]
};

/// Force of half sines, added to what is there.
inline void strike(trochoid::signal::TapRecord& record, double at, double peak,
                   double width) {
  for (std::size_t i = 0; i < record.force.size(); ++i) {
    const double t = static_cast<double>(i) / record.sample_rate - at;
    if (t > 0 && t < width)
      record.force[i] += peak * std::sin(std::numbers::pi * t / width);
  }
}

/// Displacements under the force of a record: each sample an impulse, exactly followed.
inline void respond(trochoid::signal::TapRecord& record,
                    const std::vector<TapMode>& modes) {
  const double dt = 1 / record.sample_rate;
  record.response.assign(record.force.size(), 0.0);
  for (const TapMode& m : modes) {
    const double w = 2 * std::numbers::pi * m.frequency;
    const double a = m.zeta * w;
    const double wd = w * std::sqrt(1 - m.zeta * m.zeta);
    const double e = std::exp(-a * dt);
    const double C = e * std::cos(wd * dt);
    const double D = e * std::sin(wd * dt) / wd;
    double x = 0.0;
    double v = 0.0;
    for (std::size_t i = 0; i < record.force.size(); ++i) {
      record.response[i] += x;
      v += record.force[i] * dt / m.mass;
      const double next = x * C + (v + a * x) * D;
      v = v * C - (a * v + w * w * x) * D;
      x = next;
    }
  }
}

inline trochoid::signal::TapRecord taps(const std::vector<TapMode>& modes,
                                        const Taps& how) {
  trochoid::signal::TapRecord record{.sample_rate = how.rate};
  record.force.assign(static_cast<std::size_t>(how.length * how.rate), 0.0);
  for (const double at : how.at) strike(record, at, how.peak, how.width);
  respond(record, modes);
  return record;
}

inline void add_noise(std::vector<double>& values, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, sigma);
  for (double& v : values) v += normal(random);
}

}  // namespace made
