#include <trochoid/base/units.h>
#include <trochoid/correction/residual_map.h>
#include <trochoid/correction/shapes.h>

#include <benchmark/benchmark.h>

#include <vector>

namespace trochoid::benchmarks {

namespace {

/// The residual of five strategies at a hundred speeds, by the rigid cut or simulated.
void residual_map(benchmark::State& state) {
  force::Setup setup;
  setup.cutter = {.profile = geometry::cylinder(8e-3),
                  .pitch = geometry::equal_pitch(2),
                  .lag_diameter = 8e-3};
  setup.cut = {geometry::Slot{}, 1e-3, 50e-6, 1200 * unit::rpm};
  setup.runout.radial_offsets = {13e-6, -13e-6};
  setup.chip.model = chip::Model::radial;
  const force::Power law{.K_t1 = 420e6, .K_r1 = 95e6, .m_t = 0.28, .m_r = 0.42};
  const correction::RigidCut cut(setup, law);
  const auto plant = correction::held_by_actuator(
      structure::from_time_constants(0.99536, 1.1303e-3, 1.1376e-3),
      {.mass = 0.194, .stiffness = 1.7e7, .damping = 77.3});
  const dynamics::ChipMode along{0.0324, 25.5, 8e6, 1.0, 0.0};
  const dynamics::ChipMode across{0.0324, 25.5, 8e6, 0.0, 1.0};
  const correction::MovingCut moving{
      .setup = setup, .law = law, .tool = {along, across}, .plant = plant};
  using correction::Method;
  const auto square = table_motion(cut, correction::Shape::square, {});
  const auto sine = table_motion(cut, correction::Shape::sine, {});
  const std::vector<correction::Strategy> strategies = {{square, Method::plain},
                                                        {square, Method::lead},
                                                        {sine, Method::plain},
                                                        {sine, Method::lead},
                                                        {sine, Method::inverse}};
  std::vector<double> Omega;
  for (int i = 1; i <= 100; ++i) {
    Omega.push_back(100.0 * i * unit::rpm);
  }
  const correction::MapSetting setting{plant, plant, {}, {}};
  for (auto _ : state) {
    const auto map = state.range(0) == 0
                         ? correction::residual_map(cut, strategies, setting, Omega)
                         : correction::residual_map(moving, strategies, setting, Omega);
    benchmark::DoNotOptimize(map.data());
  }
}

BENCHMARK(residual_map)
    ->ArgName("simulated")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace trochoid::benchmarks
