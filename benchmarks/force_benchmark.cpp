#include <trochoid/base/units.h>
#include <trochoid/force/axial.h>
#include <trochoid/force/cumulative.h>
#include <trochoid/force/forces.h>
#include <trochoid/force/turn_kernel.h>
#include <trochoid/force/turn_polynomial.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "paper_cut.h"
#include "textbook.h"

namespace trochoid::benchmarks {

namespace {

constexpr double tolerance = 1e-6;

/// Largest difference from the quadrature along the edge, over samples and axes, as a part
/// of the largest force.
double error_of(const std::vector<force::Vector3>& forces, const force::Setup& setup,
                std::span<const double> phi) {
  const force::AxialForce exact(setup, paper_law(), 1e-11);
  double error = 0.0;
  double peak = 0.0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const auto F = exact.loads(phi[i], 0.0);
    for (std::size_t q = 0; q < 3; ++q) {
      error = std::max(error, std::abs(forces[i][q] - F[q]));
      peak = std::max(peak, std::abs(F[q]));
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

/// Forces of a turn, set-up included, and their error.
void time_turn(benchmark::State& state, const force::Setup& setup, int samples) {
  const auto phi = turns(samples, 1);
  std::vector<force::Vector3> forces;
  for (auto _ : state) {
    forces = force::forces(setup, paper_law(), phi, tolerance);
    benchmark::DoNotOptimize(forces.data());
  }
  count(state, phi.size(), error_of(forces, setup, phi));
}

void whole_turn(benchmark::State& state, chip::Model model) {
  time_turn(state, paper_cut(model), static_cast<int>(state.range(0)));
}

/// @brief The paper's cutter with other numbers of teeth and depths [mm].
void other_cutters(benchmark::State& state) {
  force::Setup setup = paper_cut();
  setup.cutter.pitch = geometry::equal_pitch(static_cast<int>(state.range(0)));
  setup.cut.a_p = static_cast<double>(state.range(1)) * unit::mm;
  setup.runout.radial_offsets.clear();
  for (int k = 0; k < setup.cutter.teeth(); ++k) {
    setup.runout.radial_offsets.push_back(-(k * 5 % 8) * unit::um);
  }
  time_turn(state, setup, 720);
}

/// What is done once for a turn.
void set_up(benchmark::State& state, chip::Model model) {
  const force::Setup setup = paper_cut(model);
  const auto weights = force::force_weights(force::terms(paper_law()));
  for (auto _ : state) {
    const auto turn = force::turn_polynomial(*force::turn_teeth(setup, 1e-8), weights);
    benchmark::DoNotOptimize(turn.terms.data());
    state.counters["harmonics"] = turn.highest;
    state.counters["segments"] = static_cast<double>(turn.ends.size());
  }
}

/// What is done for every sample.
void samples(benchmark::State& state, chip::Model model) {
  const force::Setup setup = paper_cut(model);
  const auto turn = force::turn_polynomial(
      *force::turn_teeth(setup, 1e-8), force::force_weights(force::terms(paper_law())));
  const auto phi = turns(static_cast<int>(state.range(0)), 1);
  std::vector<force::Vector3> forces(phi.size());
  for (auto _ : state) {
    force::evaluate(turn, phi, {forces.front().data(), 3 * forces.size()});
    benchmark::DoNotOptimize(forces.data());
  }
  count(state, phi.size(), error_of(forces, setup, phi));
}

/// The tables of F-5, which serve the power laws.
void by_tables(benchmark::State& state) {
  const force::Setup setup = paper_cut();
  const auto K = std::get<force::LinearEdge>(paper_law());
  const force::MomentWeights weights = {
      {{0, -K.K_tc, -K.K_rc, 0, 0, -K.K_re, -K.K_te, 0},
       {K.K_tc, 0, 0, -K.K_rc, 0, K.K_te, -K.K_re, 0},
       {0, 0, 0, 0, -K.K_ac, 0, 0, -K.K_ae}}};
  const auto phi = turns(720, 1);
  std::vector<force::Vector3> forces(phi.size());
  for (auto _ : state) {
    force::CumulativeForce(setup, K, tolerance).forces(weights, phi, forces);
    benchmark::DoNotOptimize(forces.data());
  }
  count(state, phi.size(), error_of(forces, setup, phi));
}

/// The paper's slot with four teeth on a helix, off centre; or another cutter.
enum class Tool { eccentric, bull_nose, ball, taper };

force::Setup general_cut(Tool tool) {
  force::Setup setup = paper_cut();
  setup.runout.radial_offsets = {0.0, -8 * unit::um};
  const double D = setup.cutter.profile.D;
  switch (tool) {
    case Tool::eccentric:
      setup.cutter.pitch = geometry::equal_pitch(4);
      setup.runout = {
          .radial_offsets = {0.0, -8 * unit::um, 3 * unit::um, 1 * unit::um},
          .eccentricity = 6 * unit::um,
          .angle = 0.7};
      break;
    case Tool::bull_nose:
      setup.cutter.profile = geometry::bull_nose(D, D / 5);
      break;
    case Tool::ball:
      setup.cutter.profile = geometry::ball(D);
      break;
    case Tool::taper:
      setup.cutter.profile = geometry::taper(D, 3 * unit::deg);
      break;
  }
  return setup;
}

/// Cutters that no polynomial of a turn serves, at depths in mm.
void general_turn(benchmark::State& state, Tool tool) {
  force::Setup setup = general_cut(tool);
  setup.cut.a_p = static_cast<double>(state.range(0)) * unit::mm;
  time_turn(state, setup, 720);
}

/// A power law on them.
void general_power(benchmark::State& state, Tool tool) {
  const force::Setup setup = general_cut(tool);
  const force::Law law =
      force::Power{.K_t1 = 1.2e9, .K_r1 = 0.5e9, .m_t = 0.3, .m_r = 0.4};
  const auto phi = turns(720, 1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(force::forces(setup, law, phi, tolerance));
  }
}

/// The same by adaptive quadrature.
void general_along_the_edge(benchmark::State& state, Tool tool) {
  const force::Setup setup = general_cut(tool);
  const auto phi = turns(90, 1);
  const force::AxialForce axial(setup, paper_law(), tolerance);
  for (auto _ : state) {
    for (const double angle : phi) {
      benchmark::DoNotOptimize(axial.loads(angle, 0.0));
    }
  }
  state.counters["per_sample"] = benchmark::Counter(
      static_cast<double>(phi.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
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
BENCHMARK_CAPTURE(set_up, trochoidal, chip::Model::trochoidal)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(set_up, feed, chip::Model::feed)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(samples, trochoidal, chip::Model::trochoidal)
    ->Arg(720)
    ->Arg(3600)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(samples, feed, chip::Model::feed)
    ->Arg(720)
    ->Arg(3600)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(other_cutters)
    ->ArgNames({"teeth", "a_p"})
    ->Args({2, 2})
    ->Args({2, 60})
    ->Args({4, 2})
    ->Args({8, 2})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(by_tables)->Unit(benchmark::kMicrosecond);
BENCHMARK(matrix_turn)->Unit(benchmark::kMicrosecond);
BENCHMARK(along_the_edge)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(general_turn, eccentric, Tool::eccentric)
    ->Arg(2)
    ->Arg(60)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(general_turn, bull_nose, Tool::bull_nose)
    ->Arg(2)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(general_turn, ball, Tool::ball)
    ->Arg(2)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(general_turn, taper, Tool::taper)
    ->Arg(2)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(general_power, eccentric, Tool::eccentric)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(general_power, bull_nose, Tool::bull_nose)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(general_along_the_edge, eccentric, Tool::eccentric)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(general_along_the_edge, bull_nose, Tool::bull_nose)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(general_along_the_edge, ball, Tool::ball)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(general_along_the_edge, taper, Tool::taper)
    ->Unit(benchmark::kMicrosecond);

}  // namespace trochoid::benchmarks
