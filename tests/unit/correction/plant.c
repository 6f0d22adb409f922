#include "plant.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

void plant_init(Plant* plant, double longer_m, double offset_m) {
  int i;
  plant->feed_m = 50e-6;
  plant->longer_m = longer_m;
  plant->depth_m = 1e-3;
  plant->K_t = 60708470.37132895;
  plant->m_t = 0.28;
  plant->K_r = 5220638.301647434;
  plant->m_r = 0.42;
  plant->gain = 0.99536;
  plant->T1_s = 1.1303e-3;
  plant->T2_s = 1.1376e-3;
  plant->place_m = plant->gain * offset_m;
  plant->speed_m_per_s = 0.0;
  for (i = 0; i < PLANT_PASSES; ++i) {
    plant->passes[i] = -1;
  }
  plant->pass = -2;
  plant->bin = 0;
}

/* The semi-implicit Euler method in parts of a step. */
static void move(Plant* p, double command, double dt) {
  const int parts = 20;
  const double h = dt / parts;
  int i;
  for (i = 0; i < parts; ++i) {
    const double a =
        (p->gain * command - p->place_m - (p->T1_s + p->T2_s) * p->speed_m_per_s) /
        (p->T1_s * p->T2_s);
    p->speed_m_per_s += h * a;
    p->place_m += h * p->speed_m_per_s;
  }
}

/* Keeps where the work stood for all angles since the last step. */
static void mark(Plant* p, long pass, int bin) {
  while (p->pass != pass || p->bin != bin) {
    if (p->pass < pass - 1 || p->pass > pass) { /* begins, or was turned back */
      p->pass = pass;
      for (p->bin = 0; p->bin < bin; ++p->bin) {
        p->table_m[pass % PLANT_PASSES][p->bin] = p->place_m;
      }
    } else if (p->bin + 1 < PLANT_BINS) {
      ++p->bin;
    } else {
      p->bin = 0;
      ++p->pass;
    }
    p->passes[p->pass % PLANT_PASSES] = p->pass;
    p->table_m[p->pass % PLANT_PASSES][p->bin] = p->place_m;
  }
}

/* The least distance to what earlier passes left. */
static double chip(const Plant* p, long pass, int bin, double s) {
  double least = 1.0;
  long k;
  for (k = 1; k <= 4; ++k) {
    const long before = pass - k;
    const int known = before >= 0 && p->passes[before % PLANT_PASSES] == before;
    const double there = known ? p->table_m[before % PLANT_PASSES][bin] : p->place_m;
    const double longer =
        k % 2 == 0 ? 0.0 : (pass % 2 == 0 ? p->longer_m : -p->longer_m);
    const double h = ((double)k * p->feed_m - (p->place_m - there)) * s + longer;
    least = h < least ? h : least;
  }
  return least > 0.0 ? least : 0.0;
}

PlantForce plant_step(Plant* p, double position_rev, double command_m, double dt_s) {
  PlantForce out = {0.0, 0.0, 0.0};
  const double passes = 2.0 * position_rev;
  const long pass = (long)floor(passes);
  const double part = passes - (double)pass;
  const int bin = (int)(part * (int)PLANT_BINS);
  const double s = sin(pi * part), c = cos(pi * part);
  double Ft, Fr;
  move(p, command_m, dt_s);
  if (pass < 0) {
    return out;
  }
  mark(p, pass, bin);
  out.chip_m = chip(p, pass, bin, s);
  if (out.chip_m > 0.0) {
    Ft = p->K_t * pow(out.chip_m, 1.0 - p->m_t) * p->depth_m;
    Fr = p->K_r * pow(out.chip_m, 1.0 - p->m_r) * p->depth_m;
    out.Fx_N = -Ft * c - Fr * s;
    out.Fy_N = Ft * s - Fr * c;
  }
  return out;
}
