#pragma once

// A C interface like controller.h, for the same hosts.
#include <trochoid/correction/controller.h>
#include <trochoid/correction/online.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
  TROCHOID_ESTIMATOR_TEETH = 8,                             ///< at most
  TROCHOID_ESTIMATOR_WAVES = 2 * TROCHOID_WAVE_HARMONICS,   ///< a_1, b_1, a_2, b_2, ...
  TROCHOID_ESTIMATOR_TERMS = TROCHOID_ESTIMATOR_WAVES + 1,  ///< and a constant
};

/// What has happened to the tool.
enum TrochoidToolEvent {
  TROCHOID_TOOL_UNCHANGED = 0,
  TROCHOID_TOOTH_WORN = 1,    ///< one tooth stands out less or more than before
  TROCHOID_TOOL_CHANGED = 2,  ///< several at once: another tool, or clamped anew
};

/// Why a configuration is refused.
enum TrochoidEstimatorRefusal {
  TROCHOID_ESTIMATOR_ACCEPTED = 0,
  TROCHOID_ESTIMATOR_REFUSED_POINTER = 1,
  TROCHOID_ESTIMATOR_REFUSED_TEETH = 2,
  TROCHOID_ESTIMATOR_REFUSED_WINDOWS = 3,
  TROCHOID_ESTIMATOR_REFUSED_MODEL = 4,
  TROCHOID_ESTIMATOR_REFUSED_LEARNING = 5,
};

/// @brief A model of how the waves of the command change the flutes, and how to learn.
///
/// v_j is the force of flute j over the mean of all, less 1.
typedef struct TrochoidEstimatorConfig {
  int32_t teeth;          ///< 2 to 8
  int32_t harmonics;      ///< of the command, 1 to 8
  int32_t least_samples;  ///< of a window, 2 to 1000000
  int32_t wait_turns;     ///< after a change of the waves, 0 to 1000
  double start_rev[TROCHOID_ESTIMATOR_TEETH];  ///< where each flute's window begins,
                                               ///< ascending within a turn, -1 to 2
  /// dv_j/da_n, dv_j/db_n of the command's waves [1/m]: a_1, b_1, a_2, b_2, ...
  double wave_model[TROCHOID_ESTIMATOR_TEETH][TROCHOID_ESTIMATOR_WAVES];
  /// dv_j/drho_i of what tooth i stands out [1/m]
  double runout_model[TROCHOID_ESTIMATOR_TEETH][TROCHOID_ESTIMATOR_TEETH];
  double most_m;      ///< the waves' sum never exceeds this, above 0
  double step_m;      ///< largest change of one wave at once, above 0
  double rate;        ///< part of the difference taken away at once, 1e-3 to 1.5
  double forgetting;  ///< of the runout, per turn, 0.5 to 1; the model: 20 times slower
  double trust;       ///< standard deviation of the model's numbers over themselves
  double noise;       ///< standard deviation of v from turn to turn, above 0
  double least_force_N;   ///< below: not cutting
  double deadband;        ///< of the difference, 0 to below 1
  double event_change;    ///< of a v that is an event, above 0; 0: none are looked for
  int32_t settled_turns;  ///< learnt from before events are looked for, 1 to 100000
} TrochoidEstimatorConfig;

typedef struct TrochoidEstimatorResult {
  double cosine_m[TROCHOID_WAVE_HARMONICS];  ///< for the controller's input
  double sine_m[TROCHOID_WAVE_HARMONICS];
  double force_N[TROCHOID_ESTIMATOR_TEETH];  ///< of each flute in the last whole turn
  double difference;  ///< largest minus smallest, over the largest; 0 before any turn
  int32_t turn;       ///< TrochoidTurn of the turn that this sample completes
  int32_t learnt;     ///< how often the waves were changed, at most 1000000
  int32_t event;      ///< TrochoidToolEvent that this turn recognised
  int32_t events;     ///< so far, at most 1000000
  int32_t tooth;      ///< of the last event, from 1; 0: several
  double change_m;    ///< of that tooth; negative: it stands out less
} TrochoidEstimatorResult;

/// @brief The whole memory. Plain data, about 8 kB.
typedef struct TrochoidEstimator {
  TrochoidEstimatorConfig config;
  TrochoidEstimatorResult result;
  double theta[TROCHOID_ESTIMATOR_TEETH][TROCHOID_ESTIMATOR_TERMS];  // scaled
  double P[TROCHOID_ESTIMATOR_TERMS][TROCHOID_ESTIMATOR_TERMS];
  double
      most_P[TROCHOID_ESTIMATOR_TERMS];   // the diagonal at first: it never exceeds it
  double wave[TROCHOID_ESTIMATOR_WAVES];  // of the command, over the scale
  double reference[TROCHOID_ESTIMATOR_TEETH];  // constant terms since the last event
  double largest_N[TROCHOID_ESTIMATOR_TEETH];
  int32_t samples[TROCHOID_ESTIMATOR_TEETH];
  double angle_rev;  // of the sample before, from the first window's start
  int32_t begun;
  int32_t gaps;
  int32_t passive;
  int32_t waiting;
  int32_t measured;  // turns since the start or the last event
  int32_t odd;       // turns in a row that the model did not foresee
  int32_t sudden;    // the reference is not yet taken anew
  int32_t ready;
} TrochoidEstimator;

/// @brief Four flutes from the index on, forgetting 0.85, no model yet.
void trochoid_estimator_defaults(TrochoidEstimatorConfig* config);

/// @return TrochoidEstimatorRefusal; if refused, every turn is TROCHOID_TURN_NOT_READY
int32_t trochoid_estimator_init(TrochoidEstimator* estimator,
                                const TrochoidEstimatorConfig* config);

/// @brief One sample of the force; learns where it completes a turn.
///
/// @eq L-9  v_j = d_j + sum over k of S_jk u_k;  v_j = p_j/mean(p) - 1
/// @eq L-10 g = P x/(R + x^T P x), x = (1, u);  theta_j += g (v_j - x^T theta_j);
///          P <- L (P - g x^T P) L, L = diag(lambda^-1/2, (1 - 0.05 (1 - lambda))^-1/2, ...),
///          its diagonal never above that of the start
/// @eq L-11 u -= mu S^T (S S^T + epsilon I)^-1 v, at most the step
/// @eq L-12 event: max_j |v_j - x^T theta_j| or |d_j - d_j at the last one| above the
///          change; tooth i where (w_i e)^2/(w_i^2 e^2) is largest and above 0.8, its
///          change w_i e/w_i^2, w_i = dv/drho_i
/// @src [ljung1999] for recursive least squares; the rest derived
/// @param angle_rev  of the spindle since the index pulse, any whole turns
/// @param force_N    the same component always, Fy or Fx
/// @param active     not 0: the command is wholly in force
///
/// Memory that was overwritten with what cannot be leaves it not ready, with waves of 0,
/// until it is begun anew; waves that are no numbers are never given.
TrochoidEstimatorResult trochoid_estimator_sample(TrochoidEstimator* estimator,
                                                  double angle_rev, double force_N,
                                                  int32_t active);

/// @brief In words; never null.
const char* trochoid_tool_event_name(int32_t event);
const char* trochoid_estimator_refusal_reason(int32_t refusal);

#ifdef __cplusplus
}
#endif
