#include <trochoid/base/units.h>
#include <trochoid/force/forces.h>
#include <trochoid/identification/identify.h>

#include <benchmark/benchmark.h>

#include <random>

#include "paper_cut.h"

namespace trochoid::benchmarks {

namespace {

/// Two revolutions of 720 samples with noise, phase 37.5 deg.
identification::Run noisy_run(double noise_N) {
  const force::Setup setup = paper_cut();
  identification::Run run{.cut = setup.cut, .angle = turns(720, 2)};
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

/// Six coefficients, the offset of tooth 2 and the phase, from nothing known.
void identify(benchmark::State& state, chip::Model model) {
  const std::vector<identification::Run> runs = {
      noisy_run(static_cast<double>(state.range(0)))};
  const identification::Options options{.chip_model = model};
  identification::Fit fit;
  for (auto _ : state) {
    fit = identification::identify(paper_cut(model), paper_law(), runs, options);
    benchmark::DoNotOptimize(fit.rms);
  }
  state.counters["K_tc_MPa"] =
      fit.ok && fit.coefficients[0] ? fit.coefficients[0]->value / unit::MPa : 0.0;
}

}  // namespace

BENCHMARK_CAPTURE(identify, trochoidal, chip::Model::trochoidal)
    ->Arg(0)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(identify, feed, chip::Model::feed)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond);

}  // namespace trochoid::benchmarks
