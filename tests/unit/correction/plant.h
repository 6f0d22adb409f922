#pragma once

/* A cut to try a controller on: a two-pole actuator that moves the work along the feed,
   a slot milled by two flutes of different length, the surface that every pass leaves,
   and a power law. C's interface: a component of LinuxCNC runs the same plant. */
#ifdef __cplusplus
extern "C" {
#endif

enum { PLANT_BINS = 720, PLANT_PASSES = 8 };

typedef struct Plant {
  double feed_m;   /* per tooth */
  double longer_m; /* radius of flute 1 less that of flute 2 */
  double depth_m;
  double K_t, m_t, K_r, m_r;     /* N/m^(2-m) and exponents */
  double gain, T1_s, T2_s;       /* of the actuator */
  double place_m, speed_m_per_s; /* of the work */
  double table_m[PLANT_PASSES]
                [PLANT_BINS]; /* place of the work at each pass and angle */
  long passes[PLANT_PASSES];  /* which pass is stored; -1: none */
  long pass;
  int bin;
} Plant;

typedef struct PlantForce {
  double Fx_N, Fy_N; /* on the tool */
  double chip_m;
} PlantForce;

/* An ordinary aluminium: 56 % between the flutes for 26 um. */
void plant_init(Plant* plant, double longer_m, double offset_m);

/* One step: the command held for dt, then the cut at the position. Whole turns before
   position 0 count as a steady surface. */
PlantForce plant_step(Plant* plant, double position_rev, double command_m, double dt_s);

#ifdef __cplusplus
}
#endif
