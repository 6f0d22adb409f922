#include <trochoid/base/units.h>
#include <trochoid/force/forces.h>
#include <trochoid/identification/identify.h>

#include <benchmark/benchmark.h>

#include <random>

#include "paper_cut.h"

namespace trochoid::benchmarks {

namespace {

/// Revolutions of 720 samples with noise, phase 37.5 deg.
identification::Run noisy_run(const force::Setup& setup, int revolutions,
                              double noise_N) {
  identification::Run run{.cut = setup.cut, .angle = turns(720, revolutions)};
  std::vector<double> phi = run.angle;
  for (double& angle : phi) {
    angle += 37.5 * unit::deg;
  }
  std::mt19937 random(2009);
  std::normal_distribution<double> noise(0.0, noise_N);
  for (const force::Vector3& F : force::forces(setup, paper_law(), phi, 1e-9)) {
    run.force.push_back(
        {F[0] + noise(random), F[1] + noise(random), F[2] + noise(random)});
  }
  return run;
}

/// What a tool is known by before its fit: everything but its runout.
force::Setup without_runout(force::Setup setup) {
  setup.runout = {};
  return setup;
}

void fit_again_and_again(benchmark::State& state, const force::Setup& setup,
                         const identification::Run& run,
                         const identification::Options& options) {
  const std::vector<identification::Run> runs = {run};
  identification::Fit fit;
  for (auto _ : state) {
    fit = identification::identify(setup, paper_law(), runs, options);
    benchmark::DoNotOptimize(fit.rms);
  }
  state.counters["K_tc_MPa"] =
      fit.ok && fit.coefficients[0] ? fit.coefficients[0]->value / unit::MPa : 0.0;
}

/// Six coefficients, the offset of tooth 2 and the phase, from nothing known.
void identify(benchmark::State& state, chip::Model model) {
  fit_again_and_again(state, without_runout(paper_cut(model)),
                      noisy_run(paper_cut(), 2, static_cast<double>(state.range(0))),
                      {.chip_model = model});
}

/// The same from a start near the answer.
void identify_from_start(benchmark::State& state) {
  identification::Options options;
  options.start = identification::Start{{}, {37 * unit::deg}};
  options.start->runout.radial_offsets = {0.0, -7.5 * unit::um};
  fit_again_and_again(state, without_runout(paper_cut()),
                      noisy_run(paper_cut(), 2, static_cast<double>(state.range(0))),
                      options);
}

/// Two straight teeth: their force jumps.
void identify_straight(benchmark::State& state) {
  force::Setup setup = paper_cut();
  setup.cutter.helix = 0.0;
  fit_again_and_again(state, without_runout(setup),
                      noisy_run(setup, 2, static_cast<double>(state.range(0))), {});
}

/// Coefficients, eccentricity and phase of four teeth, one turn.
void identify_eccentricity(benchmark::State& state, bool start) {
  force::Setup setup = paper_cut();
  setup.cutter.pitch = geometry::equal_pitch(4);
  setup.runout = {.eccentricity = 10 * unit::um, .angle = 0.3};
  identification::Options options;
  options.runout = identification::RunoutUnknowns::eccentricity;
  if (start) {
    options.start = identification::Start{
        {.eccentricity = 9.5 * unit::um, .angle = 0.35}, {37 * unit::deg}};
  }
  fit_again_and_again(state, without_runout(setup),
                      noisy_run(setup, 1, static_cast<double>(state.range(0))),
                      options);
}

}  // namespace

BENCHMARK_CAPTURE(identify, trochoidal, chip::Model::trochoidal)
    ->Arg(0)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(identify, feed, chip::Model::feed)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(identify_from_start)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(identify_straight)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(identify_eccentricity, from_nothing, false)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(identify_eccentricity, from_start, true)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond);

}  // namespace trochoid::benchmarks
