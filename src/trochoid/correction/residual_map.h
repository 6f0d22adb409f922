#pragma once

#include <trochoid/correction/command.h>
#include <trochoid/correction/moving_cut.h>
#include <trochoid/correction/rigid_cut.h>
#include <trochoid/correction/shapes.h>

#include <functional>
#include <span>
#include <vector>

namespace trochoid::correction {

/// One way to correct: a motion of the table and how its command is made.
struct Strategy {
  PeriodicMotion motion;  ///< wanted
  Method method = Method::plain;
};

/// What is common to a map.
struct MapSetting {
  Plant model;  ///< from which commands are made
  Plant real;   ///< what they meet; usually the same
  ActuatorLimits limits;
  CommandOptions command;
};

/// What a strategy leaves at a speed.
struct MapPoint {
  double peak_difference = 0.0;  ///< of the flutes
  double command_range = 0.0;    ///< peak to peak before it is cut off [m]
  bool clipped = false;          ///< the stroke cuts the command off
  int n_max = 0;                 ///< harmonics of the command; 0: all
  bool periodic = true;          ///< the forces repeated from turn to turn
};

/// @brief What a strategy leaves at one speed: command, stroke, plant, rigid cut.
MapPoint residual_at(const RigidCut& cut, const Strategy& strategy,
                     const MapSetting& setting, double Omega);

/// @brief The same over speeds and strategies, on several threads.
/// @param Omega  [rad/s]
/// @return shape (strategies, speeds), row-major
std::vector<MapPoint> residual_map(const RigidCut& cut,
                                   std::span<const Strategy> strategies,
                                   const MapSetting& setting,
                                   std::span<const double> Omega);

/// @brief The same points by simulation of a cut that gives way, with the plant `real`.
MapPoint residual_at(const MovingCut& cut, const Strategy& strategy,
                     const MapSetting& setting, double Omega);
std::vector<MapPoint> residual_map(const MovingCut& cut,
                                   std::span<const Strategy> strategies,
                                   const MapSetting& setting,
                                   std::span<const double> Omega);

/// @brief Highest speed up to which a strategy leaves no more than a residual [rad/s].
///
/// @eq R-19 smallest Omega with difference(Omega) = residual
/// @src definition
/// @param range  lowest and highest speed [rad/s]; the residual is looked at on 60
///               speeds between them and the crossing refined
/// @return 0 if it is exceeded at once, `highest` if nowhere
double residual_speed(const RigidCut& cut, const Strategy& strategy,
                      const MapSetting& setting, double residual,
                      std::span<const double> range);

/// @brief The same of any difference over the spindle speed [rad/s].
/// @param difference  of the peaks at a spindle speed
double residual_speed(const std::function<double(double)>& difference, double residual,
                      std::span<const double> range);

}  // namespace trochoid::correction
