#include <trochoid/structure/plate.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

namespace trochoid::benchmarks {

namespace {

constexpr double height = 30e-3;

structure::Plate wall(double length) {
  return {.length = length,
          .height = height,
          .thickness = 2e-3,
          .youngs_modulus = 69e9,
          .poisson_ratio = 0.33};
}

/// A wall and its influence matrix for 30 heights of the upper 3 mm.
/// Arguments: length over height in tenths, place of the load in percent of the length,
/// tolerance in units of 1e-5.
void plate(benchmark::State& state) {
  const double length = height * static_cast<double>(state.range(0)) / 10;
  const double x = length * static_cast<double>(state.range(1)) / 100;
  const double tolerance = static_cast<double>(state.range(2)) * 1e-5;
  std::vector<double> y;
  for (int i = 0; i < 30; ++i) {
    y.push_back(height - 3e-3 * (29 - i) / 29);
  }
  std::size_t terms = 0;
  double edge = 0.0;
  for (auto _ : state) {
    const structure::PlateSolution solution(wall(length), x, tolerance, 3e-3);
    const auto G = solution.influence(x, y, x, y);
    benchmark::DoNotOptimize(G.data());
    edge = G.back();
    terms = solution.terms();
  }
  const structure::PlateSolution fine(wall(length), x, tolerance / 8);
  state.counters["terms"] = static_cast<double>(terms);
  state.counters["error_of_edge"] =
      1 - edge / fine.influence(x, {&height, 1}, x, {&height, 1}).front();
}

}  // namespace

BENCHMARK(plate)
    ->ArgNames({"a/b*10", "x%", "tol*1e5"})
    ->Args({5, 50, 50})
    ->Args({10, 50, 50})
    ->Args({20, 50, 50})
    ->Args({20, 25, 50})
    ->Args({20, 5, 50})
    ->Args({70, 50, 50})
    ->Args({20, 50, 10})
    ->Unit(benchmark::kMillisecond);

}  // namespace trochoid::benchmarks
