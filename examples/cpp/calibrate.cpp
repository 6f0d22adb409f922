// Cutting coefficients from a wall on a measuring machine, without a dynamometer. The
// readings are made up here: the wall of 800 and 300 MPa, half a micrometre of scatter.
#include <trochoid/base/units.h>
#include <trochoid/surface/calibrate.h>
#include <trochoid/surface/error_map.h>

#include <cstdio>
#include <random>

using namespace trochoid;

int main() {
  surface::Setting wall;
  wall.setup.cutter = geometry::end_mill(12 * unit::mm, 3, 45 * unit::deg);
  wall.setup.cut = {geometry::DownMilling{1 * unit::mm}, 3 * unit::mm, 0.2 * unit::mm,
                    1000 * unit::rpm};
  wall.bodies = [](double) {  // 83 mm out of the holder, 45 mm of them flutes
    return surface::Bodies{.cutter = structure::Cantilever{
                               83 * unit::mm, 45 * unit::mm, 12 * unit::mm,
                               9.6 * unit::mm, 206 * unit::GPa}};
  };
  wall.law = force::LinearEdge{.K_tc = 800e6, .K_rc = 300e6};
  const auto map = surface::error_map(wall, {.samples_per_turn = 120});
  std::vector<surface::Reading> readings;  // yours: travel and height [m], error [m]
  std::mt19937 random;
  std::normal_distribution<double> scatter(0.0, 0.5 * unit::um);
  for (const auto& row : map.rows) {
    for (std::size_t i = 0; i < row.x.size(); i += 10) {
      readings.push_back({.travel = row.x[i], .height = row.height,
                          .error = row.error[i] + scatter(random)});
    }
  }

  wall.law = force::LinearEdge{};  // nothing is known of it
  const surface::Datum none;
  const auto found = surface::calibrate(wall, readings, {&none, 1});
  if (!found.ok) return std::printf("no answer: %s\n", found.message.c_str()), 1;
  const auto print = [](const char* name, const base::Estimate& K) {
    std::printf("%s %5.0f +- %.0f MPa\n", name, K.value / 1e6, (K.high - K.low) / 2e6);
  };
  print("K_tc", found.coefficients.K_tc);
  print("K_rc", found.coefficients.K_rc);
}
