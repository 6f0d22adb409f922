#pragma once

#include <trochoid/correction/controller.h>

#include <cmath>
#include <numbers>

namespace trochoid::tests {

/// A spindle with an encoder, and what may go wrong with it.
struct Spindle {
  double speed = 20.0;  ///< [rev/s]
  double turns = 0.3;   ///< since the beginning
  double dt = 1e-3;     ///< [s]
  bool index = true;    ///< false: the pulses do not come
  bool latched = true;  ///< false: the counter is not latched at the pulse
  bool resets = false;  ///< true: the pulse sets the counter to zero
  double counts = 0.0;  ///< of a revolution; 0: as fine as numbers are
  double ripple = 0.0;  ///< part of the speed, once per revolution

  double now() const {
    return speed * (1.0 + ripple * std::sin(2.0 * std::numbers::pi * turns));
  }

  TrochoidControllerInput next() {
    const double before = turns;
    turns += now() * dt;
    const bool pulse = index && std::floor(turns) > std::floor(before);
    if (pulse && resets) {
      zero = std::floor(turns);
    }
    TrochoidControllerInput in{};
    in.position_rev = counted(turns) - zero;
    in.index_position_rev = latched ? std::floor(turns) - zero : in.position_rev;
    in.speed_rps = counts > 0.0 ? (counted(turns) - counted(before)) / dt : now();
    in.gain = 1.0;
    in.dt_s = dt;
    in.index = pulse ? 1 : 0;
    in.enable = 1;
    return in;
  }

  double counted(double value) const {
    return counts > 0.0 ? std::floor(value * counts) / counts : value;
  }
  double zero = 0.0;
};

/// A sine of 15 um with the default limits, as fast as the paper's case.
inline TrochoidControllerConfig sine_config(double amplitude = 15e-6) {
  TrochoidControllerConfig config;
  trochoid_controller_defaults(&config);
  config.points = 360;
  for (int i = 0; i < config.points; ++i) {
    config.table_m[i] = amplitude * std::sin(2.0 * std::numbers::pi * i / 360.0);
  }
  config.start_m = 30e-6;
  return config;
}

/// A controller with a spindle, stepped together.
struct Bench {
  TrochoidController controller{};
  Spindle spindle;
  TrochoidControllerResult last{};
  double time = 0.0;

  explicit Bench(const TrochoidControllerConfig& config) {
    trochoid_controller_init(&controller, &config);
    spindle.dt = config.period_s;
  }
  TrochoidControllerResult give(const TrochoidControllerInput& in) {
    last = trochoid_controller_step(&controller, &in);
    time += spindle.dt;
    return last;
  }
  TrochoidControllerResult step() { return give(spindle.next()); }
  /// Steps for some seconds.
  TrochoidControllerResult run(double seconds) {
    for (double end = time + seconds; time < end;) {
      step();
    }
    return last;
  }
  /// Seconds until a state, at most `most`; more if it does not come.
  double until(int state, double most = 10.0) {
    const double start = time;
    while (time - start < most) {
      if (step().state == state) {
        return time - start;
      }
    }
    return 2.0 * most;
  }
  /// Seconds until the command rests at mid-stroke.
  double until_rest(double most = 10.0) {
    const double start = time;
    while (last.command_m != controller.middle_m && time - start < most) {
      step();
    }
    return time - start;
  }
};

}  // namespace trochoid::tests
