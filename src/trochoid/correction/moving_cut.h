#pragma once

#include <trochoid/correction/command.h>
#include <trochoid/correction/periodic_motion.h>
#include <trochoid/correction/plant.h>
#include <trochoid/correction/rigid_cut.h>
#include <trochoid/correction/static_fit.h>
#include <trochoid/dynamics/motion.h>

#include <array>
#include <vector>

namespace trochoid::correction {

/// @brief A cut whose tool and table give way.
struct MovingCut {
  force::Setup setup;
  force::Law law;
  std::vector<dynamics::ChipMode> tool;  ///< modes with +1 along their direction
  Plant plant;                           ///< its table moves along the feed
  dynamics::GridOptions grid;
  int slices = 1;  ///< of the same cut where it is rigid; helix needs many
  int revolutions = 20;
  int samples_per_rev = 1440;
};

/// Slices in which a rigid cut follows the helix of a cutter: one for half a degree of its
/// lag, and at most 20.
int slices_for(const force::Setup& setup) noexcept;

/// What dynamics::motion does for a cut.
dynamics::MotionProblem problem_of(const MovingCut& cut, const PeriodicMotion& command);

/// What the last turn was like.
struct MovingFlutes {
  bool periodic = true;      ///< as dynamics::Motion has it
  double last_change = 0.0;  ///< of the force from turn to turn, in the last one [N]
  ForceRecord record;        ///< last turn, on the tool
  Harmonics table;           ///< X over the last turn [m]
  std::vector<Flute> flutes;
};

/// @brief Forces and flutes with a command, by T-4; the command starts from rest.
MovingFlutes moving_flutes(const MovingCut& cut, const PeriodicMotion& command);

/// @brief What a static fit reads on a moving cut of known runout.
///
/// @eq R-22 read(rho) = R-21 of the forces of T-4 with offsets rho
/// @src definition
StaticFit static_reading(const MovingCut& cut, std::span<const double> rho,
                         const StaticFitOptions& options = {});

/// @brief Runout behind a static estimate, the compliance taken out.
struct TrueRunout {
  bool ok = false;
  std::string reason;            ///< when not ok
  std::vector<double> rho;       ///< [m], mean 0
  std::vector<double> h_ro;      ///< [m]
  force::Power law;              ///< that makes the static fit read the one measured
  std::vector<double> read;      ///< h_ro that the static fit reads on it [m]
  double peak_difference = 0.0;  ///< of the flutes simulated with it, no command
  int iterations = 0;
};

/// @brief Runout and law whose static reading is a measured estimate.
///
/// @eq R-23 rho <- rho + estimate - read(rho), the law's ln K and m in the same way
/// @src derived: read is nearly proportional to rho
/// @param cut       its law and runout are replaced
/// @param measured  the static fit of the measured forces
TrueRunout true_runout(const MovingCut& cut, const StaticFit& measured,
                       const StaticFitOptions& options = {});

}  // namespace trochoid::correction
