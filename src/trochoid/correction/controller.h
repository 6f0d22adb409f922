#pragma once

// A C interface: for real-time hosts that are not C++, without heap, exceptions and
// libstdc++. An interface to hardware is an edge: units stand in the names.
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Most points of a command over one revolution.
enum { TROCHOID_TABLE_POINTS = 720 };

/// Harmonics of the spindle that may be added to the table.
enum { TROCHOID_WAVE_HARMONICS = 8 };

/// A number that chance does not write: what init leaves in a controller that may run.
enum { TROCHOID_READY = 0x7c0de5 };

/// What the controller does just now.
enum TrochoidState {
  TROCHOID_DISABLED = 0,    ///< rests at mid-stroke, or moves there
  TROCHOID_WAITING = 1,     ///< enabled, waits for good turns; rests at mid-stroke
  TROCHOID_FADING_IN = 2,   ///< the command grows
  TROCHOID_RUNNING = 3,     ///< the whole command
  TROCHOID_FADING_OUT = 4,  ///< disabled, the command shrinks
  TROCHOID_FAULT = 5,       ///< ramps to mid-stroke, then rests there
  TROCHOID_NOT_READY = 6    ///< no valid configuration: the command is 0
};

/// What is wrong with an input, and what stopped a run.
enum TrochoidProblem {
  TROCHOID_NO_PROBLEM = 0,
  TROCHOID_BAD_TIME = 1,       ///< dt not finite, not above 0, or above max_step_s
  TROCHOID_BAD_INPUT = 2,      ///< not finite, or absurd: 1e9 turns, 10 max_speed_rps
  TROCHOID_INHIBITED = 3,      ///< the inhibit input, e.g. the amplifier's fault line
  TROCHOID_OVERSPEED = 4,      ///< above max_speed_rps
  TROCHOID_UNDERSPEED = 5,     ///< below min_speed_rps, or backwards
  TROCHOID_INDEX_LOST = 6,     ///< no index pulse within index_turns
  TROCHOID_BAD_POSITION = 7,   ///< position, speed and index contradict one another
  TROCHOID_SPEED_CHANGED = 8,  ///< by more than speed_change since the run began
  TROCHOID_BAD_MEMORY = 9      ///< the controller's own memory was overwritten
};

/// How a run may begin again after a fault.
enum TrochoidRecovery {
  TROCHOID_RECOVER_BY_ENABLE = 0,  ///< enable must go off and on
  TROCHOID_RECOVER_BY_TURNS = 1    ///< by itself, after good_turns
};

/// What is being cut off, as bits.
enum TrochoidLimit { TROCHOID_LIMITED_SLEW = 1, TROCHOID_LIMITED_GAIN = 2 };

/// Why a configuration is refused.
enum TrochoidRefusal {
  TROCHOID_ACCEPTED = 0,
  TROCHOID_REFUSED_POINTER = 1,
  TROCHOID_REFUSED_POINTS = 2,
  TROCHOID_REFUSED_TABLE = 3,
  TROCHOID_REFUSED_WINDOW = 4,
  TROCHOID_REFUSED_STROKE = 5,
  TROCHOID_REFUSED_TIMES = 6,
  TROCHOID_REFUSED_LEAD = 7,
  TROCHOID_REFUSED_SLEW = 8,
  TROCHOID_REFUSED_SPEEDS = 9,
  TROCHOID_REFUSED_INDEX = 10,
  TROCHOID_REFUSED_RECOVERY = 11,
  TROCHOID_REFUSED_WRAP = 12
};

/// @brief What is fixed while the controller runs;
/// trochoid_controller_defaults fills it.
typedef struct TrochoidControllerConfig {
  double table_m[TROCHOID_TABLE_POINTS];  ///< command from mid-stroke at i/points turns
  int32_t points;                         ///< of the table, 2 to 720
  int32_t recovery;                       ///< TrochoidRecovery
  int32_t good_turns;                     ///< turns in order before a run, 1 to 1000
  double phase_rev;         ///< angle of the table at the index pulse, -10 to 10
  double lead_s;            ///< how much the command is ahead, 0 to 0.1
  double period_s;          ///< nominal time between steps; half of it adds to the lead
  double max_step_s;        ///< longest time between steps that is believed
  double lower_m;           ///< the window: least and
  double upper_m;           ///< greatest command
  double start_m;           ///< where the actuator stands at first, in the window
  double slew_m_per_s;      ///< greatest slope of the command
  double fade_s;            ///< from nothing to the whole command and back
  double ramp_s;            ///< from an end of the window to mid-stroke after a fault
  double gain_time_s;       ///< for a change of the gain by 1
  double filter_rev;        ///< the speed's time constant, in turns; at least 0.25
  double min_speed_rps;     ///< above 0
  double max_speed_rps;     ///< above min_speed_rps
  double speed_change;      ///< part of the speed at the start of a run, 0 to 1
  double index_turns;       ///< turns without an index pulse: lost; above 1
  double position_tol_rev;  ///< by how much position may leave speed and index, to 0.25
  double wrap_rev;  ///< turns after which the position begins anew, as 2^32/1000 of an
                    ///< int32 at 1000 counts a turn; 0: never, or by whole turns
} TrochoidControllerConfig;

/// @brief What is measured at one step.
typedef struct TrochoidControllerInput {
  double position_rev;        ///< of the spindle, counted from anywhere, even wrapped
  double index_position_rev;  ///< that position at the pulse: the latched count, 0 for
                              ///< a counter that the pulse resets, or position_rev
  double speed_rps;           ///< may be coarse
  double gain;                ///< factor of the table; 1 as it is
  double dt_s;                ///< since the step before
  int32_t index;              ///< not 0: the index pulse came since the step before
  int32_t enable;             ///< not 0: run
  int32_t inhibit;            ///< not 0: ramp to mid-stroke at once
  double
      cosine_m[TROCHOID_WAVE_HARMONICS];   ///< added to the table: of cos(n angle) and
  double sine_m[TROCHOID_WAVE_HARMONICS];  ///< of sin(n angle), n = 1, 2, ...
} TrochoidControllerInput;

typedef struct TrochoidControllerResult {
  double command_m;  ///< in the window
  double speed_rps;  ///< filtered
  double angle_rev;  ///< of the spindle since the index pulse, in [0, 1)
  double fade;       ///< part of the command that is given, 0 to 1
  double gain;       ///< in force: limited by the stroke and in its rate
  int32_t state;     ///< TrochoidState
  int32_t problem;   ///< TrochoidProblem of this step
  int32_t fault;     ///< TrochoidProblem that ended the last run; none from the next on
  int32_t limited;   ///< TrochoidLimit, bits
  int32_t turns;     ///< in order, one after another, at most 1000000
} TrochoidControllerResult;

/// @brief The whole memory. Plain data: may lie in shared memory and be copied.
typedef struct TrochoidController {
  TrochoidControllerConfig config;
  double middle_m;
  double ramp_m_per_s;
  double gain_limit;
  double output_m;
  double fade;
  double gain;
  double speed_rps;      // filtered
  double reference_rps;  // speed at the start of the run, or of the good turns
  double zero_rev;       // position at the last index pulse
  double angle_rev;      // position since then
  double expected_rev;   // the same from the speed
  double position_rev;   // at the step before
  double cosine_m[TROCHOID_WAVE_HARMONICS];  // in force
  double sine_m[TROCHOID_WAVE_HARMONICS];
  int32_t ready;  // TROCHOID_READY, or else nothing is commanded
  int32_t state;
  int32_t fault;
  int32_t turns;
  int32_t synchronised;  // an index pulse has been seen
  int32_t speed_known;
  int32_t index_was;
  int32_t released;  // enable was off since the fault
} TrochoidController;

/// @brief Sensible values for a stroke of 60 um, 1 kHz and an empty table.
void trochoid_controller_defaults(TrochoidControllerConfig* config);

/// @brief Check a configuration and begin with it; also to begin anew.
/// @return TrochoidRefusal; if refused, the controller is not ready and commands 0
int32_t trochoid_controller_init(TrochoidController* controller,
                                 const TrochoidControllerConfig* config);

/// @brief One step: what to command now.
///
/// @eq L-1 x_com = x_mid + fade gain table(frac(angle + speed (lead + T_s/2) + phase))
/// @eq L-7 x_com += fade sum over n of a_n cos(2 pi n alpha) + b_n sin(2 pi n alpha),
///         alpha the angle of the look-up
/// @eq L-2 speed += (measured - speed) d/(d + d_f),  d = max(|measured|, |speed|) dt
/// @eq L-3 |x_com(now) - x_com(before)| <= slew dt,  x_lower <= x_com <= x_upper
/// @eq L-4 expected += measured dt;  |wrap(angle - expected)| <= tolerance
/// @eq L-8 angle += d - W round(d/W), d the change of the position, W wrap_rev
/// @src [diez2010] for look-up by an index pulse; the rest derived
///
/// Whatever the input, the command stays in the window and its slope within the slew
/// limit, exactly; time that does not pass leaves it where it is. Bounded time, no
/// allocation, the same bits for the same inputs. Memory that was overwritten ends in a
/// fault, never in the command: only where the command itself is lost it jumps, to
/// mid-stroke.
TrochoidControllerResult trochoid_controller_step(TrochoidController* controller,
                                                  const TrochoidControllerInput* input);

/// @brief Largest gain whose command stays in the window.
double trochoid_controller_gain_limit(const TrochoidController* controller);

/// @brief In words; never null.
const char* trochoid_state_name(int32_t state);
const char* trochoid_problem_name(int32_t problem);
const char* trochoid_refusal_reason(int32_t refusal);

#ifdef __cplusplus
}
#endif
