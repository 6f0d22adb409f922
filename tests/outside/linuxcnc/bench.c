#include "bench.h"

#include <math.h>
#include <string.h>

void bench_init(Bench* b) {
  memset(b, 0, sizeof *b);
  plant_init(&b->bench_plant, 26e-6, 30e-6);
  b->bench_turns = 0.25;
  b->bench_position = 0.25;
}

int bench_turn(Bench* b, double rps, double dt_s, int armed, int lost) {
  const double before = b->bench_turns;
  const double moved = rps * dt_s;
  int pulse;
  b->bench_turns += moved;
  b->bench_position += moved;
  pulse = armed && !lost && floor(b->bench_turns) > floor(before);
  if (pulse) {
    b->bench_position = b->bench_turns - floor(b->bench_turns);
  }
  return pulse;
}

void bench_follow(Bench* b, double position) {
  double moved = position - b->bench_last;
  moved -= floor(moved + 0.5);
  b->bench_last = position;
  if (b->bench_tick == 0) {
    b->bench_turns = 0.0;
  }
  b->bench_turns += moved;
}

void bench_cut(Bench* b, double command_um, double dt_s) {
  const double angle = b->bench_turns - floor(b->bench_turns);
  double* peak = &b->bench_peaks[angle < 0.5 ? 0 : 1];
  b->bench_force =
      plant_step(&b->bench_plant, b->bench_turns, 1e-6 * command_um, dt_s).Fy_N;
  if (angle < 0.5 && b->bench_peaks[1] > 0.0) { /* a turn begins */
    b->bench_done[0] = b->bench_peaks[0];
    b->bench_done[1] = b->bench_peaks[1];
    b->bench_peaks[0] = 0.0;
    b->bench_peaks[1] = 0.0;
  }
  if (fabs(b->bench_force) > *peak) {
    *peak = fabs(b->bench_force);
  }
  ++b->bench_tick;
}

uint32_t bench_bits(double value, int upper) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  return (uint32_t)(upper ? bits >> 32 : bits & 0xffffffffU);
}
