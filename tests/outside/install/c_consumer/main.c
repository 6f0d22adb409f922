/* A host of the controller in C: an actuator that rests at mid-stroke. */
#include <stdio.h>
#include <trochoid/correction/controller.h>
#include <trochoid/correction/online.h>

static TrochoidController controller;

int main(void) {
  TrochoidControllerConfig config;
  TrochoidControllerInput input = {0};
  TrochoidControllerResult result;
  TrochoidOnlineConfig learning;
  TrochoidOnline online;
  trochoid_controller_defaults(&config);
  config.start_m = 0.5 * (config.lower_m + config.upper_m);
  trochoid_online_defaults(&learning);
  learning.feed_per_tooth_m = 40e-6;
  learning.difference_m = 20e-6;
  if (trochoid_controller_init(&controller, &config) != TROCHOID_ACCEPTED ||
      trochoid_online_init(&online, &learning) != TROCHOID_ONLINE_ACCEPTED) {
    return 1;
  }
  input.dt_s = config.period_s;
  result = trochoid_controller_step(&controller, &input);
  printf("%s at %.1f um\n", trochoid_state_name(result.state), 1e6 * result.command_m);
  return result.state == TROCHOID_DISABLED && result.command_m == config.start_m ? 0 : 1;
}
