#pragma once

/* A machine to try the component on: spindle with index pulse, plant, and a scenario by
   ticks. The offline program runs the same one around the library. */
#include <stdint.h>

#include "../../unit/correction/plant.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct Bench {
  Plant bench_plant;
  double bench_turns;    /* of the spindle */
  double bench_position; /* since the pulse that set the counter to zero */
  double bench_last;     /* position of an encoder outside, one tick ago */
  double bench_force;
  double bench_peaks[2]; /* of the turn that goes on */
  double bench_done[2];  /* of the last complete turn */
  uint32_t bench_tick;
} Bench;

void bench_init(Bench* bench);

/* The spindle of the bench turns: sets the counter to zero and returns 1 at the pulse,
   when armed and the pulse is not lost. */
int bench_turn(Bench* bench, double rps, double dt_s, int armed, int lost);

/* An encoder outside tells the position. */
void bench_follow(Bench* bench, double position);

/* The cut, with the command that was given. */
void bench_cut(Bench* bench, double command_um, double dt_s);

/* The upper or lower half of the bits of a number. */
uint32_t bench_bits(double value, int upper);

#ifdef __cplusplus
}
#endif
