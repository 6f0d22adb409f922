#include <trochoid/base/units.h>
#include <trochoid/dynamics/lobes.h>
#include <trochoid/dynamics/oscillator.h>
#include <trochoid/numerics/dense.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace trochoid::benchmarks {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double K_t = 600e6;  // [N/m^2]
constexpr double K_r = 200e6;

dynamics::ChipMode mode(double x, double y) {
  const double omega = 2 * pi * 922;
  return {0.03993, 2 * 0.011 * omega * 0.03993, 0.03993 * omega * omega, x, y};
}

/// The benchmark of the literature: 922 Hz, two teeth, a slot, 10 mm.
force::Setup straight_slot() {
  force::Setup setup;
  setup.cutter = {.profile = geometry::cylinder(10 * unit::mm),
                  .pitch = geometry::equal_pitch(2),
                  .lag_diameter = 10 * unit::mm};
  setup.cut = {.engagement = geometry::Slot{},
               .a_p = 1 * unit::mm,
               .f_z = 0.05 * unit::mm,
               .Omega = 5000 * unit::rpm};
  setup.chip = {chip::Model::none, chip::Lookback::previous};
  return setup;
}

force::Setup slot_with_runout() {
  force::Setup setup = straight_slot();
  setup.cutter.helix = 29 * unit::deg;
  setup.chip = {chip::Model::radial, chip::Lookback::all};
  setup.runout.radial_offsets = {10 * unit::um, -10 * unit::um};
  return setup;
}

dynamics::DirectionalModel model_of(const force::Setup& setup) {
  return {setup, force::LinearEdge{.K_tc = K_t, .K_rc = K_r}, 1e-6, 1e-10};
}

/// A plain semi-discretization of the slot: m steps a tooth, the force of a step from
/// its mean directional factor and the mean of two delayed positions; all eigenvalues.
double semi_discretized(double depth, double Omega, std::size_t m) {
  const dynamics::ChipMode one = mode(1, 0);
  const double step = pi / Omega / static_cast<double>(m);
  const std::size_t size = m + 2;  // place, speed, and m places before
  numerics::Matrix U = numerics::zeros(size, size);
  for (std::size_t k = 0; k < size; ++k) U(k, k) = 1;
  for (std::size_t i = 0; i < m; ++i) {
    const double theta = pi * (static_cast<double>(i) + 0.5) / static_cast<double>(m);
    const double s = std::sin(theta);
    const double h = depth * (K_t * std::cos(theta) + K_r * s) * s;  // [N/m]
    dynamics::ChipMode stiffer = one;
    stiffer.stiffness += h;
    const auto free = dynamics::free_motion(stiffer, step);
    // A constant force f moves the place of rest to f/(k + h).
    const double rest = h / stiffer.stiffness;
    for (std::size_t j = 0; j < size; ++j) {
      const double delayed = 0.5 * rest * (U(m, j) + U(m + 1, j));
      const double place = U(0, j);
      const double speed = U(1, j);
      std::shift_right(&U(2, j), &U(2, j) + m, 1);
      U(0, j) = free[0] * place + free[1] * speed + (1 - free[0]) * delayed;
      U(1, j) = free[2] * (place - delayed) + free[3] * speed;
      U(2, j) = place;
    }
  }
  double largest = 0.0;
  for (const auto& mu : numerics::eigenvalues(U)) {
    largest = std::max(largest, std::abs(mu));
  }
  return largest;
}

constexpr double converged = 1.4064735254;  ///< |mu| at 1 mm and 5000 rpm

void multiplier_of_the_slot(benchmark::State& state) {
  const auto cut = model_of(straight_slot()).at_depth(1 * unit::mm);
  double mu = 0.0;
  for (auto _ : state) {
    mu = std::abs(
        dynamics::multiplier(cut, {{mode(1, 0)}}, 5000 * unit::rpm, 1e-5).value);
    benchmark::DoNotOptimize(mu);
  }
  state.counters["error"] = std::abs(mu - converged);
}

void multiplier_semi_discretized(benchmark::State& state) {
  double mu = 0.0;
  for (auto _ : state) {
    mu = semi_discretized(1 * unit::mm, 5000 * unit::rpm,
                          static_cast<std::size_t>(state.range(0)));
    benchmark::DoNotOptimize(mu);
  }
  state.counters["error"] = std::abs(mu - converged);
}

void multiplier_with_runout(benchmark::State& state) {
  const auto cut = model_of(slot_with_runout()).at_depth(1 * unit::mm);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        dynamics::multiplier(cut, {{mode(1, 0), mode(0, 1)}}, 5000 * unit::rpm, 1e-5));
  }
}

/// 200 speeds x 100 depths and the limit.
void lobes(benchmark::State& state) {
  const bool runout = state.range(0) != 0;
  const auto model = model_of(runout ? slot_with_runout() : straight_slot());
  dynamics::System system{{mode(1, 0)}};
  if (runout) {
    system.modes.push_back(mode(0, 1));
  }
  std::vector<double> Omega;
  std::vector<double> depth;
  for (int i = 0; i < 200; ++i) {
    Omega.push_back((5000 + 20000 * i / 199.0) * unit::rpm);
  }
  for (int k = 1; k <= 100; ++k) {
    depth.push_back(0.04 * k * unit::mm);
  }
  for (auto _ : state) {
    const auto grid = dynamics::lobe_grid(model, system, Omega, depth, {}, {});
    benchmark::DoNotOptimize(dynamics::limit_curve(model, system, grid, 1e-5, {}));
  }
}

}  // namespace

BENCHMARK(multiplier_of_the_slot)->Unit(benchmark::kMicrosecond);
BENCHMARK(multiplier_semi_discretized)
    ->Arg(40)
    ->Arg(80)
    ->Arg(160)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(multiplier_with_runout)->Unit(benchmark::kMicrosecond);
BENCHMARK(lobes)->ArgName("runout")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace trochoid::benchmarks
