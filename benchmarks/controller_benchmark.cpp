#include <trochoid/correction/controller.h>
#include <trochoid/correction/online.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace trochoid::benchmarks {

namespace {

TrochoidControllerConfig sine_config() {
  TrochoidControllerConfig config;
  trochoid_controller_defaults(&config);
  config.points = TROCHOID_TABLE_POINTS;
  for (int i = 0; i < config.points; ++i) {
    config.table_m[i] = 15e-6 * std::sin(2.0 * std::numbers::pi * i / config.points);
  }
  return config;
}

/// Ten seconds at 1200 rpm and 1 kHz, with the pulses.
std::vector<TrochoidControllerInput> inputs() {
  std::vector<TrochoidControllerInput> all(10000);
  double turns = 0.3;
  for (auto& in : all) {
    const double before = turns;
    turns += 20.0 * 1e-3;
    in.position_rev = turns;
    in.index_position_rev = std::floor(turns);
    in.index = std::floor(turns) > std::floor(before) ? 1 : 0;
    in.speed_rps = 20.0;
    in.gain = 1.0;
    in.dt_s = 1e-3;
    in.enable = 1;
  }
  return all;
}

/// Time of one step, running.
void controller_step(benchmark::State& state) {
  const auto config = sine_config();
  const auto all = inputs();
  TrochoidController controller;
  trochoid_controller_init(&controller, &config);
  long running = 0;
  for (auto _ : state) {
    for (const auto& in : all) {
      const auto result = trochoid_controller_step(&controller, &in);
      running += result.state == TROCHOID_RUNNING ? 1 : 0;
      benchmark::DoNotOptimize(result.command_m);
    }
  }
  const auto steps = static_cast<double>(state.iterations()) * 10000.0;
  state.counters["step"] = benchmark::Counter(
      steps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["running"] = static_cast<double>(running) / steps;
}

/// One revolution at 1200 rpm and 10 kHz: 500 samples, and the gain is adapted.
void online_revolution(benchmark::State& state) {
  TrochoidOnlineConfig config;
  trochoid_online_defaults(&config);
  config.wait_turns = 0;
  config.deadband = 0.0;
  TrochoidOnline online;
  trochoid_online_init(&online, &config);
  std::vector<double> angle(500);
  std::vector<double> force(500);
  for (std::size_t i = 0; i < angle.size(); ++i) {
    angle[i] = static_cast<double>(i) / 500.0;
    force[i] = (i < 250 ? 60.0 : 30.0) * std::sin(2.0 * std::numbers::pi * angle[i]);
  }
  for (auto _ : state) {
    const auto result =
        trochoid_online_batch(&online, angle.data(), force.data(), 500, 1);
    benchmark::DoNotOptimize(result.gain);
  }
  state.counters["learnt"] = online.result.learnt;
}

}  // namespace

BENCHMARK(controller_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(online_revolution)->Unit(benchmark::kMicrosecond);

}  // namespace trochoid::benchmarks
