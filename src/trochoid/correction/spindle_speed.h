#pragma once

#include <trochoid/correction/rigid_cut.h>

#include <string>
#include <vector>

namespace trochoid::correction {

/// What turns the tool.
struct SpindleDrive {
  double inertia = 0.0;  ///< of everything that turns with the tool [kg m^2]
  double torque = 0.0;   ///< that the motor gives at this speed, either way [N m]
};

/// A spindle speed that changes within the turn, in place of a table that moves.
struct SpeedModulation {
  double part = 0.0;           ///< of the motion that was wanted, 0 to 1
  std::string limit;           ///< what keeps it from 1, in words; empty: nothing
  PeriodicMotion motion;       ///< of a table that would do the same
  double speed_change = 0.0;   ///< largest |Omega(phi)/Omega - 1|
  double torque = 0.0;         ///< largest that is asked for, the cut's included [N m]
  double torque_wanted = 0.0;  ///< for the whole motion [N m]; infinite: no such speed
  double peak_difference = 0.0;   ///< of the flutes with it, on a rigid cut
  std::vector<double> angle;      ///< of the spindle [rad]
  std::vector<double> speed;      ///< there [rad/s]
  std::vector<double> torque_at;  ///< there [N m]
};

/// @brief As much of a motion as a spindle can stand in for by its speed.
///
/// A spindle that is late lets the feed get ahead: the chips change as if a table had
/// moved. A sine is right for an eccentricity alone.
///
/// @eq R-32 Omega(phi) = Omega/(1 - 2 pi X'(phi)/f), f the feed a turn
/// @eq R-33 M = J Omega dOmega/dphi + M_c(phi),  |M| <= the torque of the motor
/// @src the idea as [diez2010] tells it of Sastry et al.; derived from R-1
/// @param X      motion of the table that is wanted, without jumps
/// @param Omega  mean speed [rad/s]
/// @note M_c takes the lag of a helix at mid depth.
SpeedModulation speed_modulation(const RigidCut& cut, const PeriodicMotion& X,
                                 const SpindleDrive& drive, double Omega);

}  // namespace trochoid::correction
