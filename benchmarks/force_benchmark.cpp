#include <trochoid/force/axial.h>
#include <trochoid/force/forces.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "paper_cut.h"
#include "textbook.h"

namespace trochoid::benchmarks {

namespace {

constexpr double tolerance = 1e-6;

/// Largest difference over samples and axes, as a part of the largest force.
double error_of(const std::vector<force::Vector3>& forces, const force::Setup& setup,
                std::span<const double> phi) {
  const auto exact = force::forces(setup, paper_law(), phi, 1e-12);
  double error = 0.0;
  double peak = 0.0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    for (std::size_t q = 0; q < 3; ++q) {
      error = std::max(error, std::abs(forces[i][q] - exact[i][q]));
      peak = std::max(peak, std::abs(exact[i][q]));
    }
  }
  return error / peak;
}

void count(benchmark::State& state, std::size_t samples, double error) {
  state.counters["error"] = error;
  state.counters["per_sample"] = benchmark::Counter(
      static_cast<double>(samples),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void textbook(benchmark::State& state) {
  const force::Setup setup = paper_cut();
  const auto phi = turns(720, 1);
  const auto K = std::get<force::LinearEdge>(paper_law());
  std::vector<force::Vector3> forces;
  for (auto _ : state) {
    forces = textbook_forces(setup, K, phi, 100);
    benchmark::DoNotOptimize(forces.data());
  }
  count(state, phi.size(), error_of(forces, setup, phi));
}

void whole_turn(benchmark::State& state, chip::Model model) {
  const force::Setup setup = paper_cut(model);
  const auto phi = turns(static_cast<int>(state.range(0)), 1);
  std::vector<force::Vector3> forces;
  for (auto _ : state) {
    forces = force::forces(setup, paper_law(), phi, tolerance);
    benchmark::DoNotOptimize(forces.data());
  }
  count(state, phi.size(), error_of(forces, setup, phi));
}

void matrix_turn(benchmark::State& state) {
  const force::Setup setup = paper_cut();
  const auto phi = turns(720, 1);
  std::vector<double> C(phi.size() * 18);
  for (auto _ : state) {
    force::ForceMatrix(setup, paper_law(), tolerance).evaluate(phi, C);
    benchmark::DoNotOptimize(C.data());
  }
  state.counters["per_sample"] = benchmark::Counter(
      static_cast<double>(phi.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// The same cut by the quadrature that serves every cutter.
void along_the_edge(benchmark::State& state) {
  const force::Setup setup = paper_cut();
  const auto phi = turns(720, 1);
  const force::AxialForce axial(setup, paper_law(), tolerance);
  std::vector<force::Vector3> forces(phi.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const auto v = axial.loads(phi[i], 0.0);
      forces[i] = {v[0], v[1], v[2]};
    }
    benchmark::DoNotOptimize(forces.data());
  }
  count(state, phi.size(), error_of(forces, setup, phi));
}

}  // namespace

BENCHMARK(textbook)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(whole_turn, trochoidal, chip::Model::trochoidal)
    ->Arg(720)
    ->Arg(3600)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(whole_turn, feed, chip::Model::feed)
    ->Arg(720)
    ->Arg(3600)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(matrix_turn)->Unit(benchmark::kMicrosecond);
BENCHMARK(along_the_edge)->Unit(benchmark::kMicrosecond);

}  // namespace trochoid::benchmarks
