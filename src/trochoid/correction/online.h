#pragma once

// A C interface like controller.h, for the same hosts.
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// What is taken as the force of a flute in its window.
enum TrochoidMeasure {
  TROCHOID_MEASURE_PEAK = 0,  ///< the largest magnitude: equal peaks are the aim
  TROCHOID_MEASURE_MEAN =
      1  ///< the mean magnitude: less noise, equal means are the aim
};

/// What became of a turn.
enum TrochoidTurn {
  TROCHOID_TURN_OPEN = 0,      ///< none is complete
  TROCHOID_TURN_LEARNT = 1,    ///< the gain was adapted
  TROCHOID_TURN_EQUAL = 2,     ///< the flutes differ by less than the deadband
  TROCHOID_TURN_WAITED = 3,    ///< the gain of before was not yet in force
  TROCHOID_TURN_NO_CUT = 4,    ///< the force stayed below least_force_N
  TROCHOID_TURN_GAPS = 5,      ///< samples are missing, not finite, or run backwards
  TROCHOID_TURN_PASSIVE = 6,   ///< the controller was not running
  TROCHOID_TURN_NOT_READY = 7  ///< no valid configuration
};

/// Why a configuration is refused.
enum TrochoidOnlineRefusal {
  TROCHOID_ONLINE_ACCEPTED = 0,
  TROCHOID_ONLINE_REFUSED_POINTER = 1,
  TROCHOID_ONLINE_REFUSED_TEETH = 2,  ///< two only: one gain tells no more flutes apart
  TROCHOID_ONLINE_REFUSED_WINDOW = 3,
  TROCHOID_ONLINE_REFUSED_GAIN = 4,
  TROCHOID_ONLINE_REFUSED_CHIP = 5,
  TROCHOID_ONLINE_REFUSED_LEARNING = 6
};

typedef struct TrochoidOnlineConfig {
  int32_t teeth;            ///< 2
  int32_t measure;          ///< TrochoidMeasure
  int32_t least_samples;    ///< of a window, 2 to 1000000
  int32_t wait_turns;       ///< after a change of the gain, 0 to 1000
  double window_start_rev;  ///< spindle angle where flute 1 begins, -1 to 1
  double window_rev;        ///< length of a flute's window, to 0.5
  double gain;              ///< at first
  double gain_low;          ///< limits; the high one at most the controller's
  double gain_high;
  double gain_step;  ///< largest change at once, above 0
  double rate;       ///< part of the difference taken away at once, 0 to 1.5
  double feed_per_tooth_m;
  double difference_m;   ///< peak-to-peak of the table's motion at gain 1; negative
                         ///< if it makes the chip of flute 1 thicker
  double exponent;       ///< m of a force like h^(1-m), 0 to below 1
  double least_force_N;  ///< below: not cutting
  double deadband;       ///< of the difference, 0 to below 1
} TrochoidOnlineConfig;

typedef struct TrochoidOnlineResult {
  double gain;        ///< for the controller
  double force_N[2];  ///< of each flute in the last complete turn
  double difference;  ///< larger minus smaller, over the larger; 0 before any turn
  double residual_m;  ///< chip of flute 1 above the mean, estimated
  int32_t turn;       ///< TrochoidTurn of the turn that this sample completes
  int32_t learnt;     ///< how often the gain was adapted, at most 1000000
} TrochoidOnlineResult;

/// @brief The whole memory. Plain data.
typedef struct TrochoidOnline {
  TrochoidOnlineConfig config;
  TrochoidOnlineResult result;
  double largest_N[2];
  double sum_N[2];
  double angle_rev;  // of the sample before, from the start of flute 1
  int32_t samples[2];
  int32_t begun;  // 0: before the first start of a turn
  int32_t gaps;
  int32_t passive;
  int32_t waiting;  // turns still to wait
  int32_t ready;
} TrochoidOnline;

/// @brief Two flutes, peaks, half-turn windows from the index on, gain 0 to 1.
void trochoid_online_defaults(TrochoidOnlineConfig* config);

/// @return TrochoidOnlineRefusal; if refused, every turn is TROCHOID_TURN_NOT_READY
int32_t trochoid_online_init(TrochoidOnline* online,
                             const TrochoidOnlineConfig* config);

/// @brief One sample of the force; adapts the gain where it completes a turn.
///
/// @eq L-5 e = f_z (q_1 - q_2)/(q_1 + q_2),  q_j = p_j^{1/(1-m)}
/// @eq L-6 g += mu e/d, by at most the step, within the limits
/// @src [diez2010] eq. 3 and 7 give L-5 for one tooth in cut; L-6 derived
/// @param angle_rev  of the spindle since the index pulse, any whole turns
/// @param force_N    the same component always, Fy or Fx
/// @param active     not 0: the command is wholly in force
///
/// Memory that was overwritten with what cannot be leaves it not ready, with a gain of 0,
/// until it is begun anew; a gain beyond its limits is never given.
TrochoidOnlineResult trochoid_online_sample(TrochoidOnline* online, double angle_rev,
                                            double force_N, int32_t active);

/// @brief Samples in a row: the result of the last; `turn` of the last turn completed.
/// @param angle_rev  shape (count)
/// @param force_N    shape (count)
TrochoidOnlineResult trochoid_online_batch(TrochoidOnline* online,
                                           const double* angle_rev,
                                           const double* force_N, int32_t count,
                                           int32_t active);

/// @brief In words; never null.
const char* trochoid_turn_name(int32_t turn);
const char* trochoid_online_refusal_reason(int32_t refusal);

#ifdef __cplusplus
}
#endif
