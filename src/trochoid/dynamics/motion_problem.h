#pragma once

#include <trochoid/dynamics/engaged_grid.h>
#include <trochoid/dynamics/system.h>
#include <trochoid/force/law.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::dynamics {

/// @brief A piezo actuator that pushes a table mode through a spring.
/// @eq T-2 a_2 p'' + a_1 p' + a_0 p = x_com;  force on the table: k_s p + c_s p'
/// @src [diez2010] eq. 13, 15, 16 with the poles at -1/T
struct Drive {
  std::size_t mode = 0;  ///< of the system: the table along the feed
  double a_0 = 1.0;      ///< 1/gain
  double a_1 = 0.0;      ///< [s]
  double a_2 = 0.0;      ///< [s^2]
  double k_s = 0.0;      ///< [N/m]
  double c_s = 0.0;      ///< [N s/m]
};

/// In which motion a simulation starts.
enum class Start {
  rest,      ///< nothing moves, and nothing ever did
  periodic,  ///< the one that the forces without vibration would keep up
};

/// @brief What moves, what cuts, and for how long.
struct MotionProblem {
  force::Setup setup;
  force::Law law;
  System system;
  std::optional<Drive> drive;
  /// x_com [m] at t [s]; empty: none. Called once a step, at the middle of the step,
  /// and so in increasing order of t: it may keep a state, as a sampled controller
  /// does. A jump acts from the node that is next to it.
  std::function<double(double t)> command;
  /// Called at the start of every step, before `command` is asked about it: time [s],
  /// force on the tool [N], place of the driven mode [m] (0 without a drive). Where the
  /// force jumps it is the one just after.
  std::function<void(double t, const std::array<double, 3>& force, double table)>
      observe;
  /// Called after every revolution: how many are done. May be empty.
  std::function<void(int done)> turned;
  GridOptions grid;
  Start start = Start::rest;
  int revolutions = 20;
  int kept = 1;               ///< last revolutions that are returned
  int watched = 1;            ///< last revolutions in which the flutes are looked at
  int samples_per_rev = 720;  ///< of what is returned
};

/// @brief Largest change of the force from period to period, over the largest force, of a
/// motion that is periodic: 0.2 N of 60 N, as the case of [diez2010] settles.
inline constexpr double periodic_tolerance = 1.0 / 300;

/// A displacement that no cut has [m]: the motion has run away.
inline constexpr double run_away = 0.1;

/// One flute in the last revolution, or in the last ones that are watched.
struct FluteMotion {
  double peak_x = 0.0;     ///< largest |F_x| while its tip is in the stock [N]
  double peak_y = 0.0;     ///< largest |F_y| [N]
  double chip_area = 0.0;  ///< mean integral of h over its angle, at the tip [m rad]
  double peak_chip = 0.0;  ///< [m]
};

/// @brief Motion in time. Vectors have one value a sample of the kept revolutions.
struct Motion {
  std::vector<double> time;                  ///< from the start of the simulation [s]
  std::vector<double> angle;                 ///< of the tip of tooth 1 [rad]
  std::vector<std::array<double, 3>> force;  ///< on the tool [N]
  std::vector<std::vector<double>> mode;     ///< displacement of each mode [m]
  std::vector<std::vector<double>> speed;    ///< of each mode [m/s]
  std::vector<double> actuator;              ///< p [m]
  std::vector<double> command;               ///< x_com [m]
  std::vector<std::array<double, 2>> once;   ///< q at the start of every revolution [m]
  std::vector<FluteMotion> flutes;
  bool finite = true;  ///< false: it was displaced by more than run_away
  bool solved = true;  ///< false: some step had no force that agrees with its motion
  /// Largest change of a component of the force from turn to turn, in the last one,
  /// apart from steps in which an edge force came or went [N].
  double last_change = 0.0;
  double peak = 0.0;  ///< largest force in the plane of the table, where watched [N]
  /// Teeth that pass until the force is as it was, within periodic_tolerance of the
  /// peak; none: not within a few turns.
  std::optional<int> passes;
  /// What tells that period from a shorter one: the change over a tooth, or over a turn
  /// for longer ones, in the last turn over that four turns before; below 1 it fades.
  double persistence = 0.0;
  std::optional<double> growth;  ///< of a small vibration in a turn (T-11), where seen
  int turns_done = 0;
};

/// @brief Whether the motion repeats with every turn.
inline bool repeats_every_turn(const Motion& motion) noexcept {
  return motion.passes && static_cast<int>(motion.flutes.size()) % *motion.passes == 0;
}

}  // namespace trochoid::dynamics
