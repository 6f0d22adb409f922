#include <trochoid/correction/controller.h>
#include <trochoid/correction/estimator.h>
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

/// The estimator of eight flutes and harmonics, linear in both.
TrochoidEstimatorConfig estimator_config() {
  TrochoidEstimatorConfig config;
  trochoid_estimator_defaults(&config);
  constexpr int teeth = TROCHOID_ESTIMATOR_TEETH;
  config.teeth = teeth;
  config.harmonics = TROCHOID_WAVE_HARMONICS;
  config.wait_turns = 0;
  config.deadband = 0.0;
  const double step = 2.0 * std::numbers::pi / teeth;
  constexpr double slope = 1e4;
  for (int j = 0; j < teeth; ++j) {
    config.start_rev[j] = static_cast<double>(j) / teeth;
    for (int n = 1; n <= config.harmonics; ++n) {
      const double to = n * step * (j + 0.5);
      const double from = to - n * step;
      config.wave_model[j][2 * n - 2] = -slope * (std::cos(to) - std::cos(from));
      config.wave_model[j][2 * n - 1] = -slope * (std::sin(to) - std::sin(from));
    }
    config.runout_model[j][j] = slope;
    config.runout_model[j][(j + teeth - 1) % teeth] = -slope;
  }
  return config;
}

/// One revolution of 500 samples; the waves of eight flutes are learnt at its end.
void estimator_revolution(benchmark::State& state) {
  const auto config = estimator_config();
  TrochoidEstimator estimator;
  trochoid_estimator_init(&estimator, &config);
  constexpr int samples = 500;
  for (auto _ : state) {
    for (int i = 0; i < samples; ++i) {
      const double angle = static_cast<double>(i) / samples;
      const double force = 50.0 + 5.0 * std::sin(2.0 * std::numbers::pi * angle);
      benchmark::DoNotOptimize(
          trochoid_estimator_sample(&estimator, angle, force, 1).difference);
    }
  }
  state.counters["learnt"] = estimator.result.learnt;
}

}  // namespace

BENCHMARK(controller_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(online_revolution)->Unit(benchmark::kMicrosecond);
BENCHMARK(estimator_revolution)->Unit(benchmark::kMicrosecond);

}  // namespace trochoid::benchmarks
