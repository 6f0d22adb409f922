#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/cases/case.h>
#include <trochoid/results/actuator.h>
#include <trochoid/results/calibrate.h>
#include <trochoid/results/correct.h>
#include <trochoid/results/dynamics.h>
#include <trochoid/results/identify.h>
#include <trochoid/results/plan.h>
#include <trochoid/results/plan_finish.h>
#include <trochoid/results/plan_wall.h>
#include <trochoid/results/program.h>
#include <trochoid/results/simulate.h>
#include <trochoid/results/stability.h>
#include <trochoid/results/surface.h>
#include <trochoid/run/progress.h>

/// From a case to what a command answers, in SI.
namespace trochoid::run {

/// @brief What every answer to a case begins with: its title, what its reader noted, and
/// the case as it was understood.
inline results::Heading heading_of(const cases::Case& given) {
  results::Heading heading;
  heading.title = given.title;
  heading.warnings = given.notes;
  heading.case_toml = given.as_understood;
  return heading;
}

/// @brief Chip, forces, torque and engagement of a case; its measurements, if it has
/// any, are compared with the forces.
/// @param tables  whether those of chips are wanted
/// @throws base::InputError when a measurement cannot be read
results::SimulateResult simulate(const cases::Case& given, bool tables = true);

/// @brief Coefficients, runout and phase from the measurements of a case.
/// @param stop  then what adds to the fit that decides is left out, with a warning of the
///              code `time_limit`; where `left` of it is none, some 10 s of one core bound the
///              work (`work_limit`)
/// @throws base::InputError when a measurement cannot be used
results::IdentifyResult identify(const cases::Case& given, const Progress& progress,
                                 base::Stop stop = {});

/// @brief Which cut to measure next: the one after which the quantities of [plan] are
/// known best (I-20, I-21), told from the measurements of a case, or from its
/// coefficients as if nothing had been measured.
/// @throws base::InputError when a measurement cannot be used
results::PlanResult plan(const cases::Case& given, const Progress& progress);

/// @brief The wall that a cut leaves, with the deflection of cutter and wall.
results::SurfaceResult surface(const cases::Case& given, const Progress& progress);

/// @brief Cutting coefficients, and runout where it shows, from measured walls.
/// @throws base::InputError when a measurement cannot be used
results::CalibrateResult calibrate(const cases::Case& given, const Progress& progress);
/// Where what was measured are roughness traces.
results::CalibrateResult calibrate_finish(const cases::Case& given,
                                          const Progress& progress);

/// @brief How to measure a wall so that it tells the coefficients and the runout as well
/// as is wanted (E-60), and which cut and which wall keep an allowed error.
///
/// About the coefficients and the runout of the case; with measurements about what
/// these tell.
/// @throws base::InputError when a measurement cannot be used
results::PlanWallResult plan_wall(const cases::Case& given, const Progress& progress);

/// @brief Which feed keeps Ra of floor and wall within a limit, with the runout of the case,
/// with other inserts and with all teeth at one depth (W-9).
results::PlanFinishResult plan_finish(const cases::Case& given,
                                      const Progress& progress);

/// @brief Whether a small vibration grows at the case, and over speed and depth.
/// @param stop  the diagram ends then, with a warning of the code `time_limit`
results::StabilityResult stability(const cases::Case& given, const Progress& progress,
                                   base::Stop stop = {});

/// @brief Motion of cutter, table and actuator while they cut.
/// @throws base::InputError when the file of [command] cannot be read
results::MotionResult dynamics(const cases::Case& given, const Progress& progress);

/// @brief Gain and dynamics of an actuator from the step of a case.
/// @param given  with [step]
/// @throws base::InputError when the file cannot be read
results::ActuatorResult actuator(const cases::Case& given);

/// @brief The motion of the table that cancels runout, its command, and what the cut is
/// like before and after.
/// @param controller  simulate the real-time controller as well
/// @throws base::InputError when a measurement cannot be read
results::CorrectResult correct(const cases::Case& given, bool controller,
                               const Progress& progress);

/// @brief The moves of a whole NC program.
/// @throws base::InputError when it cannot be read
results::ProgramResult program(const cases::Case& given, const Progress& progress = {},
                               const base::Stop& stop = {});

}  // namespace trochoid::run
