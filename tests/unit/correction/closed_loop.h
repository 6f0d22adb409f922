#pragma once

#include <trochoid/correction/controller.h>
#include <trochoid/correction/online.h>

#include "plant.h"
#include "spindle.h"

#include <cmath>
#include <vector>

namespace trochoid::tests {

/// A turn of the cut as it truly was.
struct TrueTurn {
  double peak[2] = {0.0, 0.0};
  double gain = 0.0;
  double difference() const {
    return std::fabs(peak[0] - peak[1]) / std::fmax(peak[0], peak[1]);
  }
};

/// Controller at 1 kHz, plant and force at 10 kHz, 1200 rpm.
struct ClosedLoop {
  TrochoidController controller{};
  TrochoidOnline online{};
  Plant plant{};
  Spindle spindle;
  TrochoidControllerResult last{};
  TrochoidOnlineResult learnt{};
  std::vector<TrueTurn> turns;  ///< since all of the command was in force
  double noise = 0.0;           ///< of the force, uniform [N]
  double least_command = 1.0;
  double most_command = -1.0;

  ClosedLoop(const TrochoidControllerConfig& config,
             const TrochoidOnlineConfig& learning, double longer) {
    trochoid_controller_init(&controller, &config);
    trochoid_online_init(&online, &learning);
    plant_init(&plant, longer, controller.middle_m);
    spindle.dt = 1e-4;
    spindle.turns = 0.0;
    learnt.gain = learning.gain;
  }

  void run(int until_turns) {
    const int every = 10;
    for (long i = 0; static_cast<int>(turns.size()) <= until_turns && i < 1000000;
         ++i) {
      auto in = spindle.next();
      pulse = pulse || in.index != 0;
      if (steps++ % every == 0) {
        in.index = pulse ? 1 : 0;
        in.index_position_rev = std::floor(spindle.turns);
        in.dt_s = every * spindle.dt;
        in.gain = learnt.gain;
        last = trochoid_controller_step(&controller, &in);
        pulse = false;
      }
      cut(in.position_rev);
    }
  }

 private:
  bool pulse = false;
  long steps = 0;
  unsigned seed = 1;

  void cut(double position) {
    const PlantForce force = plant_step(&plant, position, last.command_m, spindle.dt);
    const bool active = last.state == TROCHOID_RUNNING;
    seed = 1664525U * seed + 1013904223U;
    const double wrong = noise * (static_cast<double>(seed) / 2147483648.0 - 1.0);
    learnt = trochoid_online_sample(&online, position, force.Fy_N + wrong, active);
    least_command = std::fmin(least_command, last.command_m);
    most_command = std::fmax(most_command, last.command_m);
    const double angle = position - std::floor(position);
    if (active && angle < before) {
      turns.push_back({.gain = learnt.gain});
    }
    before = angle;
    if (!turns.empty()) {
      double& peak = turns.back().peak[angle < 0.5 ? 0 : 1];
      peak = std::fmax(peak, std::fabs(force.Fy_N));
    }
  }
  double before = 0.0;
};

}  // namespace trochoid::tests
