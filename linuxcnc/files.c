#include "shim.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double um = 1e-6;

/* Which field of a line of names a column is; -1: none. */
static int column_of(const char* line, const char* name) {
  const size_t length = strlen(name);
  int column = 0;
  for (;;) {
    const size_t field = strcspn(line, ",\r\n");
    if (field == length && strncmp(line, name, length) == 0) {
      return column;
    }
    if (line[field] != ',') {
      return -1;
    }
    line += field + 1;
    ++column;
  }
}

/* The number in a field; NaN if there is none. */
static double number_in(const char* line, int column) {
  char* end;
  double value;
  for (; column > 0; --column) {
    line = strchr(line, ',');
    if (line == NULL) {
      return NAN;
    }
    ++line;
  }
  value = strtod(line, &end);
  return end == line ? NAN : value;
}

/* Angles equally spaced over a turn, and the command around its middle. */
static const char* check_table(TrochoidHal* hal, const double* angle) {
  double low = hal->hal_table_um[0], high = low;
  int i;
  if (hal->hal_points < 2) {
    return "fewer than two points";
  }
  for (i = 0; i < hal->hal_points; ++i) {
    const double value = hal->hal_table_um[i];
    if (!(fabs(angle[i] - 360.0 * i / hal->hal_points) < 1e-3)) {
      return "angles are not equally spaced from 0 to below 360 deg";
    }
    if (!(fabs(value) < 1e6)) {
      return "a command is not a number";
    }
    low = value < low ? value : low;
    high = value > high ? value : high;
  }
  for (i = 0; i < hal->hal_points; ++i) {
    hal->hal_table_um[i] -= 0.5 * (low + high);
  }
  return NULL;
}

const char* trochoid_hal_read_table(TrochoidHal* hal, const char* path) {
  static double angle[TROCHOID_TABLE_POINTS];
  char line[4096];
  int angles = 0, commands = 1;
  FILE* file = fopen(path, "r");
  hal->hal_points = 0;
  if (file == NULL) {
    return "cannot be opened";
  }
  while (fgets(line, sizeof line, file) != NULL) {
    if (line[0] == '#' || line[strspn(line, " \t\r\n")] == '\0') {
      continue;
    }
    if (hal->hal_points == 0 && isnan(number_in(line, 0))) {
      angles = column_of(line, "angle_deg");
      commands = column_of(line, "command_um");
      if (angles < 0 || commands < 0) {
        break;
      }
      continue;
    }
    if (hal->hal_points == TROCHOID_TABLE_POINTS) {
      hal->hal_points = 0;
      fclose(file);
      return "more than 720 points";
    }
    angle[hal->hal_points] = number_in(line, angles);
    hal->hal_table_um[hal->hal_points] = number_in(line, commands);
    ++hal->hal_points;
  }
  fclose(file);
  if (angles < 0 || commands < 0) {
    return "has no columns angle_deg and command_um";
  }
  return check_table(hal, angle);
}

/* Columns of estimator.csv, found by their names. */
typedef struct ModelColumns {
  int start, wait;
  int waves[TROCHOID_ESTIMATOR_WAVES];
  int teeth[TROCHOID_ESTIMATOR_TEETH];
  int wave_count, tooth_count;
} ModelColumns;

static ModelColumns model_columns(const char* line) {
  ModelColumns c;
  char name[40];
  c.start = column_of(line, "window_start_turns");
  c.wait = column_of(line, "wait_turns");
  for (c.wave_count = 0; c.wave_count < TROCHOID_ESTIMATOR_WAVES; ++c.wave_count) {
    snprintf(name, sizeof name, "%s%d_per_um", c.wave_count % 2 ? "sine" : "cosine",
             c.wave_count / 2 + 1);
    if ((c.waves[c.wave_count] = column_of(line, name)) < 0) {
      break;
    }
  }
  for (c.tooth_count = 0; c.tooth_count < TROCHOID_ESTIMATOR_TEETH; ++c.tooth_count) {
    snprintf(name, sizeof name, "tooth%d_per_um", c.tooth_count + 1);
    if ((c.teeth[c.tooth_count] = column_of(line, name)) < 0) {
      break;
    }
  }
  return c;
}

static void set_flute(TrochoidEstimatorConfig* model, const ModelColumns* c,
                      const char* line) {
  const int j = model->teeth++;
  const double wait = number_in(line, c->wait);
  int k;
  model->start_rev[j] = number_in(line, c->start);
  model->wait_turns = wait >= 0.0 && wait <= 1000.0 ? (int)wait : -1;
  for (k = 0; k < c->wave_count; ++k) {
    model->wave_model[j][k] = number_in(line, c->waves[k]) / um;
  }
  for (k = 0; k < c->tooth_count; ++k) {
    model->runout_model[j][k] = number_in(line, c->teeth[k]) / um;
  }
}

static const char* read_model(TrochoidEstimatorConfig* model, FILE* file) {
  static TrochoidEstimator tried;
  char line[4096];
  int32_t refused;
  ModelColumns c = {-1, -1, {0}, {0}, 0, 0};
  if (fgets(line, sizeof line, file) != NULL) {
    c = model_columns(line);
  }
  if (c.start < 0 || c.wait < 0 || c.wave_count < 2 || c.wave_count % 2 != 0) {
    return "has no columns window_start_turns, wait_turns, cosine1_per_um, sine1_per_um";
  }
  trochoid_estimator_defaults(model);
  model->teeth = 0;
  model->harmonics = c.wave_count / 2;
  while (fgets(line, sizeof line, file) != NULL) {
    if (model->teeth == TROCHOID_ESTIMATOR_TEETH) {
      return "has more than 8 flutes";
    }
    set_flute(model, &c, line);
  }
  if (c.tooth_count != model->teeth) {
    return "has not as many columns tooth1_per_um, ... as flutes";
  }
  model->most_m = 1e-6; /* those of the settings when it begins */
  model->step_m = 1e-6;
  refused = trochoid_estimator_init(&tried, model);
  return refused == TROCHOID_ESTIMATOR_ACCEPTED
             ? NULL
             : trochoid_estimator_refusal_reason(refused);
}

const char* trochoid_hal_read_model(TrochoidHal* hal, const char* path) {
  static TrochoidEstimatorConfig model;
  const char* wrong;
  FILE* file = fopen(path, "r");
  memset(&hal->hal_model, 0, sizeof hal->hal_model);
  if (file == NULL) {
    return "cannot be opened";
  }
  wrong = read_model(&model, file);
  fclose(file);
  if (wrong == NULL) {
    hal->hal_model = model;
  }
  return wrong;
}
