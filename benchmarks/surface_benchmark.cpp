#include <trochoid/numerics/parallel.h>
#include <trochoid/surface/envelope.h>
#include <trochoid/surface/feedback.h>
#include <trochoid/surface/find_runout.h>
#include <trochoid/surface/turn.h>

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

namespace trochoid::benchmarks {

namespace {

constexpr double a_p = 3e-3;
constexpr double f_z = 0.2e-3;
constexpr int teeth = 3;
constexpr double feed = teeth * f_z;
constexpr std::array<double, surface::columns> K = {400e6, 200e6, 0.0, 0.0};

/// The cutter and the wall of [wang2015].
surface::Setting thin_wall(double eccentricity) {
  surface::Setting s;
  s.setup.cutter = {.profile = geometry::cylinder(12e-3),
                    .pitch = geometry::equal_pitch(teeth),
                    .helix = std::numbers::pi / 4,
                    .lag_diameter = 12e-3};
  s.setup.cut = {geometry::DownMilling{1e-3}, a_p, f_z, 100.0};
  s.setup.runout = {.eccentricity = eccentricity, .angle = 1.2};
  s.law = force::LinearEdge{};
  s.bodies = [](double x) {
    surface::Bodies bodies;
    bodies.cutter = structure::Cantilever{83e-3, 45e-3, 12e-3, 9.6e-3, 206e9};
    const structure::Plate plate{60e-3, 30e-3, 2e-3, 69e9, 0.33};
    bodies.wall = surface::Wall{
        std::make_shared<structure::PlateSolution>(plate, x, 5e-4, a_p), 30e-3, 60e-3};
    return bodies;
  };
  return s;
}

std::vector<double> spread(int count, double from, double to) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(from + (to - from) * i / (count - 1));
  }
  return values;
}

/// The surface of one turn at 200 places and 50 heights, the wall already solved.
std::vector<double> surface_of_a_turn(const surface::Setting& setting,
                                      const surface::Compliance& compliance) {
  constexpr std::size_t places = 200;
  const std::vector<double> heights = spread(50, 0.05e-3, 2.95e-3);
  const auto rows = compliance.rows(heights);
  const surface::EdgeMoments edges(setting.setup, setting.law, compliance.basis());
  const auto moments =
      surface::with_coefficients(surface::unit_moments(edges, 1e-5), K);
  std::vector<double> errors(heights.size() * places);
  numerics::for_each_index(heights.size(), [&](std::size_t h) {
    const std::size_t n = compliance.basis().size();
    const surface::HeightCut cut{
        surface::Side{},
        6e-3,
        feed,
        0.0,
        surface::edge_places(setting.setup, heights[h]),
        surface::deflection(moments, std::span(rows).subspan(h * n, n), 1.0)};
    for (std::size_t i = 0; i < places; ++i) {
      errors[h * places + i] =
          surface::envelope_error(cut, feed * static_cast<double>(i) / places).error;
    }
  });
  return errors;
}

/// Argument: eccentricity in um.
void envelope_map(benchmark::State& state) {
  const surface::Setting setting =
      thin_wall(1e-6 * static_cast<double>(state.range(0)));
  const surface::Compliance compliance(setting.bodies(30e-3), a_p, 30e-3,
                                       surface::Load::distributed);
  for (auto _ : state) {
    benchmark::DoNotOptimize(surface_of_a_turn(setting, compliance).data());
  }
}

/// 990 readings of a wall with runout and 1 um of noise.
std::vector<surface::Reading> readings() {
  const surface::Setting setting = thin_wall(3e-6);
  const surface::Compliance compliance(setting.bodies(30e-3), a_p, 30e-3,
                                       surface::Load::distributed);
  const auto errors = surface_of_a_turn(setting, compliance);
  const std::vector<double> heights = spread(50, 0.05e-3, 2.95e-3);
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, 1e-6);
  std::vector<surface::Reading> all;
  for (std::size_t h = 5; h < 50; h += 3) {
    for (std::size_t i = 0; i < 66; ++i) {
      const double x = feed * static_cast<double>(3 * i) / 200;
      all.push_back({.x = 30e-3 + x,
                     .travel = x,
                     .height = heights[h],
                     .error = errors[h * 200 + 3 * i] + noise(random)});
    }
  }
  return all;
}

/// Linear, envelope and feedback answers with their errors; argument 1: runout as well.
void calibrate(benchmark::State& state) {
  const surface::Setting setting = thin_wall(0.0);
  const auto measured = readings();
  const std::vector<surface::Datum> datum = {{.offset = true}};
  for (auto _ : state) {
    const auto found =
        surface::fit_models(setting, measured, datum, surface::Feedback::none);
    benchmark::DoNotOptimize(found.fits.data());
    if (state.range(0) == 1) {
      const auto runout = surface::find_runout(setting, measured, datum, found);
      benchmark::DoNotOptimize(runout.predicted.data());
    }
  }
  state.counters["readings"] = static_cast<double>(measured.size());
}

/// The periodic state of a cutter with runout whose deflection changes the chip.
void feedback_with_runout(benchmark::State& state) {
  const surface::Setting setting = thin_wall(3e-6);
  const surface::Compliance compliance(setting.bodies(30e-3), a_p, 30e-3,
                                       surface::Load::distributed);
  const surface::EdgeMoments edges(setting.setup, setting.law, compliance.basis());
  int turns = 0;
  for (auto _ : state) {
    const auto turn = surface::steady_state(edges, K, compliance,
                                            surface::Feedback::regenerative, 1e-5);
    turns = turn.turns;
  }
  state.counters["turns"] = turns;
}

}  // namespace

BENCHMARK(envelope_map)->Arg(0)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(calibrate)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(feedback_with_runout)->Unit(benchmark::kMillisecond);

}  // namespace trochoid::benchmarks
