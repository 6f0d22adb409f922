#pragma once

#include <trochoid/correction/controller.h>
#include <trochoid/correction/estimator.h>
#include <trochoid/correction/plan.h>

#include <optional>
#include <string>
#include <vector>

/// The real-time controller in the loop with a simulated cut.
namespace trochoid::correction {

/// What surrounds the controller.
struct LoopOptions {
  double rate = 4000.0;       ///< of the loop [Hz]
  int counts = 4096;          ///< of the encoder, a turn
  double jitter = 0.0;        ///< standard deviation of the loop's time [s]
  double speed_ripple = 0.0;  ///< amplitude, as a fraction of the speed, once a turn
  double fade = 0.2;          ///< [s]
  double ramp = 0.05;         ///< to mid-stroke after a fault [s]
  int turns = 40;             ///< that are simulated, more than enabling_turn
  int index_lost_at = 0;      ///< turn from which no index pulse comes; 0: never
  bool adapt = false;  ///< it learns from the forces while it runs: the amplitude of
                       ///< two flutes, the waves of the command of more
};

/// The turn in which the controller is enabled; before, it only looks.
inline constexpr int enabling_turn = 6;

/// The controller at one of its steps.
struct LoopSample {
  double time = 0.0;     ///< [s]
  double command = 0.0;  ///< [m], in the stroke
  double table = 0.0;    ///< [m]
  double gain = 1.0;
  int state = TROCHOID_DISABLED;
};

/// One turn of the spindle under the controller.
struct LoopTurn {
  std::vector<double> peaks;  ///< of |F_y| of each flute [N]
  double difference = 0.0;    ///< of them, over the largest
  double gain = 1.0;          ///< at its end
  double wave = 0.0;          ///< largest amplitude of the waves learnt, at its end [m]
  int event = TROCHOID_TOOL_UNCHANGED;  ///< of the tool, that it recognised
  int state = TROCHOID_DISABLED;
};

/// @brief What the controller did to the cut.
struct ControllerInLoop {
  bool ok = false;
  std::string reason;  ///< when not ok: why it refuses its configuration
  std::vector<LoopTurn> turns;
  std::vector<LoopSample> samples;
  int fault = TROCHOID_NO_PROBLEM;    ///< the first one
  double fault_time = 0.0;            ///< [s]
  int held_by = TROCHOID_NO_PROBLEM;  ///< what was wrong most often while it waited
  double held_part = 0.0;             ///< of the steps in which it waited
  double coarse_speed = 0.0;  ///< one count of the encoder in one step, over the speed
  /// From the fault to rest at mid-stroke [s]; none: it never came there.
  std::optional<double> time_to_safe;
  double lowest = 0.0;   ///< command [m]
  double highest = 0.0;  ///< command [m]
  bool finite = true;    ///< false: the cut ran away
};

/// @brief Run the controller of controller.h on the model of the cut.
///
/// The ripple turns the spindle unevenly in time; the vibration of the cut is computed at
/// the mean speed. Chance has a fixed seed.
/// @throws std::invalid_argument for as few turns as enabling_turn, and where
/// dynamics::motion does
ControllerInLoop controller_in_loop(const Setting& setting, const Plan& plan,
                                    const LoopOptions& options);

/// @brief The last turn in which the whole command was given; nullptr: there is none.
const LoopTurn* last_running(const ControllerInLoop& run) noexcept;

/// @brief Turns of running until the flutes differ by less and stay so.
/// @return none where they never do
std::optional<int> turns_to_equal(const ControllerInLoop& run,
                                  double difference) noexcept;

}  // namespace trochoid::correction
