#include "textbook_motion.h"

#include <trochoid/dynamics/motion.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

/// How much faster than the machine a motion is computed: two tool modes, a table and
/// its actuator, two teeth, 1200 rpm, 1000 steps of a tooth period.
namespace trochoid::benchmarks {

namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr int steps = 1000;

dynamics::MotionProblem runout_tool(double helix) {
  dynamics::MotionProblem p;
  p.setup.cutter = {.profile = geometry::cylinder(8e-3),
                    .pitch = geometry::equal_pitch(2),
                    .helix = helix,
                    .lag_diameter = 8e-3};
  p.setup.runout.radial_offsets = {13e-6, -13e-6};
  p.setup.cut = {geometry::Slot{}, 1e-3, 0.05e-3, 20 * turn};
  p.setup.chip.model = chip::Model::radial;
  p.law = force::Power{.K_t1 = 166.7e6, .K_r1 = 58.35e6, .m_t = 0.598, .m_r = 0.598};
  p.system.modes = {{0.0324, 25.5, 8e6, 1, 0},
                    {0.0324, 25.5, 8e6, 0, 1},
                    {0.194, 77.3, 1.7e7, -1, 0}};
  p.drive = dynamics::Drive{2, 1 / 0.99536, 2.2785e-3, 1.2919e-6, 1.7e7, 77.3};
  p.grid.steps_per_tooth = steps;
  return p;
}

dynamics::MotionProblem linear_tool(double helix) {
  dynamics::MotionProblem p = runout_tool(helix);
  p.law = force::LinearEdge{.K_tc = 800e6, .K_rc = 300e6};
  return p;
}

void count(benchmark::State& state, const dynamics::MotionProblem& p) {
  const double simulated = p.revolutions * turn / p.setup.cut.Omega *
                           static_cast<double>(state.iterations());
  state.counters["times_real_time"] =
      benchmark::Counter(simulated, benchmark::Counter::kIsRate);
  state.counters["ns_per_step"] = benchmark::Counter(
      2.0 * steps * p.revolutions * static_cast<double>(state.iterations()) * 1e-9,
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void run(benchmark::State& state, dynamics::MotionProblem p) {
  p.revolutions = static_cast<int>(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(dynamics::motion(p));
  }
  count(state, p);
}

void motion_power(benchmark::State& state) {
  run(state, runout_tool(0));
}
void motion_linear(benchmark::State& state) {
  run(state, linear_tool(0));
}
void motion_power_helix(benchmark::State& state) {
  run(state, runout_tool(0.5));
}
void motion_linear_helix(benchmark::State& state) {
  run(state, linear_tool(0.5));
}

BENCHMARK(motion_power)->Arg(20)->Arg(500)->Unit(benchmark::kMillisecond);
BENCHMARK(motion_linear)->Arg(20)->Arg(500)->Unit(benchmark::kMillisecond);
BENCHMARK(motion_power_helix)->Arg(20)->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(motion_linear_helix)->Arg(20)->Arg(200)->Unit(benchmark::kMillisecond);

void textbook_power(benchmark::State& state) {
  dynamics::MotionProblem p = runout_tool(state.range(0) > 1 ? 0.5 : 0.0);
  p.revolutions = 4;
  const auto slices = static_cast<int>(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(textbook_motion(p, steps, slices));
  }
  count(state, p);
}

BENCHMARK(textbook_power)->Arg(1)->Arg(50)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace trochoid::benchmarks
