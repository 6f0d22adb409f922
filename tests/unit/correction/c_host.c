/* The controller as a host in C sees it: this is C99, linked by the C compiler with its
   mathematics only. That it links is half of the test. */
#include <trochoid/correction/controller.h>

#include <stdio.h>

static TrochoidController controller;

int main(void) {
  TrochoidControllerConfig config;
  TrochoidControllerResult result = {0};
  int i, largest = 0;
  trochoid_controller_defaults(&config);
  config.table_m[0] = 10e-6;
  config.table_m[1] = -10e-6;
  config.slew_m_per_s = 1.0;
  if (trochoid_controller_init(&controller, &config) != TROCHOID_ACCEPTED) {
    return 1;
  }
  for (i = 1; i < 2000; ++i) {
    TrochoidControllerInput input = {0};
    input.position_rev = 0.02 * i;
    input.index_position_rev = i / 50;
    input.index = i % 50 == 0;
    input.speed_rps = 20.0;
    input.gain = 1.0;
    input.dt_s = 1e-3;
    input.enable = 1;
    result = trochoid_controller_step(&controller, &input);
    if (1e9 * result.command_m > largest) {
      largest = (int)(1e9 * result.command_m);
    }
  }
  printf("%s, up to %d nm\n", trochoid_state_name(result.state), largest);
  return result.state == TROCHOID_RUNNING && largest > 39000 && largest <= 40000 ? 0
                                                                                 : 1;
}
