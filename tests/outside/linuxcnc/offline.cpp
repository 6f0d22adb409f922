// The bench around the library, without LinuxCNC: what the component must equal bit for
// bit. Usage: offline TABLE TICKS ENABLE_AT DISABLE_AT LOSE_INDEX_AT LEARN Prints a
// line a tick: tick, state, command and force as two halves of their bits each.
#include <trochoid/correction/controller.h>
#include <trochoid/correction/online.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "bench.h"

namespace {

constexpr double um = 1e-6;
constexpr double rps = 20.0;
constexpr double dt = 250000 * 1e-9;  // as HAL makes it of its period

std::vector<double> read_table(const char* path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<double> table;
  while (std::getline(file, line)) {
    table.push_back(std::strtod(line.c_str() + line.find(',') + 1, nullptr));
  }
  const auto [low, high] = std::minmax_element(table.begin(), table.end());
  const double middle = 0.5 * (*low + *high);
  for (double& value : table) {
    value -= middle;
  }
  return table;
}

/// The settings of the test's HAL file.
TrochoidControllerConfig config_of(const std::vector<double>& table) {
  TrochoidControllerConfig config;
  trochoid_controller_defaults(&config);
  config.points = static_cast<int>(table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    config.table_m[i] = um * table[i];
  }
  config.lower_m = um * 0.0;
  config.upper_m = um * 60.0;
  config.start_m = um * 30.0;
  config.slew_m_per_s = um * 20000.0;
  config.lead_s = 2.268e-3;
  config.period_s = dt;
  config.max_step_s = 5.0 * dt;
  return config;
}

TrochoidOnlineConfig learning_of(const std::vector<double>& table, double gain_limit) {
  const auto [low, high] = std::minmax_element(table.begin(), table.end());
  TrochoidOnlineConfig config;
  trochoid_online_defaults(&config);
  config.gain_high = gain_limit;
  config.gain_step = gain_limit;
  config.difference_m = um * *high - um * *low;
  config.feed_per_tooth_m = um * 50.0;
  return config;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 7) {
    return 2;
  }
  const auto number = [&](int i) { return std::strtoul(argv[i], nullptr, 10); };
  const auto table = read_table(argv[1]);
  const auto config = config_of(table);
  TrochoidController controller;
  TrochoidOnline online;
  if (trochoid_controller_init(&controller, &config) != TROCHOID_ACCEPTED) {
    return 1;
  }
  const auto learning = learning_of(table, trochoid_controller_gain_limit(&controller));
  trochoid_online_init(&online, &learning);
  static Bench bench;
  bench_init(&bench);
  const bool learn = number(6) != 0;
  for (unsigned long tick = 0; tick < number(2); ++tick) {
    const int pulse = bench_turn(&bench, rps, dt, tick > 0, tick >= number(5));
    TrochoidControllerInput in{};
    in.position_rev = bench.bench_position;
    in.speed_rps = rps;
    in.gain = learn ? online.result.gain : 1.0;
    in.dt_s = dt;
    in.index = pulse;
    in.enable = tick >= number(3) && tick < number(4) ? 1 : 0;
    const auto result = trochoid_controller_step(&controller, &in);
    if (learn) {
      trochoid_online_sample(&online, result.angle_rev, bench.bench_force,
                             result.state == TROCHOID_RUNNING);
    }
    const double command = result.command_m / um;
    bench_cut(&bench, command, dt);
    std::printf("%lu %d %u %u %u %u\n", tick, result.state, bench_bits(command, 1),
                bench_bits(command, 0), bench_bits(bench.bench_force, 1),
                bench_bits(bench.bench_force, 0));
  }
}
