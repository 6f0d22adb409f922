component trochoid_bench "A spindle and a cut to try trochoid_correct on";
license "MIT";
author "The Trochoid authors";

pin in bit external "the position comes from an encoder";
pin in float encoder_position;
pin in float rps = 20.0;
pin io bit index_enable;
pin in float command_um;
pin out float position;
pin out float speed;
pin out bit enable;
pin out float force;
pin out float flute1 "peak of the last turn";
pin out float flute2;
pin out u32 tick;
pin out u32 command_upper;
pin out u32 command_lower;
pin out u32 force_upper;
pin out u32 force_lower;
param rw u32 enable_at "ticks";
param rw u32 disable_at = 0xffffffff;
param rw u32 lose_index_at = 0xffffffff;

option extra_setup yes;
option data Bench;
include "bench.h";

function spindle fp;
function cut fp;
;;

EXTRA_SETUP() {
  (void)prefix;
  (void)extra_arg;
  bench_init(&data);
  return 0;
}

FUNCTION(spindle) {
  const uint32_t now = data.bench_tick;
  enable = now >= enable_at && now < disable_at;
  if (external) {
    bench_follow(&data, encoder_position);
    return;
  }
  if (bench_turn(&data, rps, fperiod, index_enable, now >= lose_index_at)) {
    index_enable = 0;
  }
  position = data.bench_position;
  speed = rps;
}

FUNCTION(cut) {
  tick = data.bench_tick;
  bench_cut(&data, command_um, fperiod);
  force = data.bench_force;
  flute1 = data.bench_done[0];
  flute2 = data.bench_done[1];
  command_upper = bench_bits(command_um, 1);
  command_lower = bench_bits(command_um, 0);
  force_upper = bench_bits(data.bench_force, 1);
  force_lower = bench_bits(data.bench_force, 0);
}
