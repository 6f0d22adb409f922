#include "../unit/structure/made_shapes.h"

#include <gtest/gtest.h>
#include <trochoid/structure/identify_modes.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

/// How often 95 % intervals hold the modes that several responses were made from.
namespace trochoid::structure {
namespace {

constexpr std::array names = {"frequency", "damping_ratio", "mass", "stiffness",
                              "angle"};

/// Close modes at 30 and 120 deg.
const made::Plane tilted{{{{1000, 0.03, 0.5, 30}, {1080, 0.025, 0.8, 120}}}};

#ifdef __SANITIZE_ADDRESS__
constexpr int few = 1;
const ModesOptions options{
    .count = 2, .residual_terms = false, .complex_shapes = false};
#else
constexpr int few = 2;
const ModesOptions options{};
#endif

int seeds() {
  const char* asked = std::getenv("TROCHOID_SEEDS");
  return asked != nullptr ? std::atoi(asked) : few;
}

bool holds(const Known& known, double truth) {
  return std::abs(known.value - truth) <= 1.96 * known.se;
}

struct Count {
  std::array<int, names.size()> held{};
  int modes = 0;
  int wrong = 0;  ///< another number of modes, or complex ones
};

Count counted(made::Noise noise, int n) {
  constexpr double deg = std::numbers::pi / 180;
  Count count;
  for (int seed = 1; seed <= n; ++seed) {
    const auto fit =
        identify_shapes(made::all_of(tilted, {"xx", "xy", "yy"},
                                     {.band = {600, 1600, 5},
                                      .noise = noise,
                                      .seed = static_cast<unsigned>(seed)}),
                        options);
    if (!fit.ok || fit.modes.size() != 2 || fit.complex_shapes) {
      ++count.wrong;
      continue;
    }
    for (std::size_t r = 0; r < 2; ++r) {
      const FittedMode& m = fit.modes[r];
      const made::TiltedMode& truth = tilted.modes[r];
      const double omega = truth.frequency * made::Hz;
      const double angle = truth.angle > 90 ? truth.angle - 180 : truth.angle;
      const std::array held = {
          holds(m.omega, omega), holds(m.zeta, truth.zeta), holds(m.mass, truth.mass),
          holds(m.stiffness, truth.mass * omega * omega), holds(m.angle, angle * deg)};
      for (std::size_t k = 0; k < held.size(); ++k) {
        count.held[k] += held[k] ? 1 : 0;
      }
      ++count.modes;
    }
  }
  return count;
}

void expect_held(made::Noise noise) {
  const int n = seeds();
  const Count count = counted(noise, n);
  EXPECT_LE(count.wrong, 0.1 * n);
  // 90 %, less three deviations of a count of so many modes.
  const double least = 0.9 * count.modes - 3 * std::sqrt(0.9 * 0.1 * count.modes);
  for (std::size_t k = 0; k < names.size(); ++k) {
    EXPECT_GE(count.held[k], least) << names[k] << " of " << count.modes;
    testing::Test::RecordProperty(names[k], count.held[k]);
  }
  testing::Test::RecordProperty("modes", count.modes);
  testing::Test::RecordProperty("wrong", count.wrong);
}

TEST(ShapesCoverage, UnderNoiseInProportion) {  // [M-31]
  expect_held({.fraction = 0.02});
}

TEST(ShapesCoverage, UnderAFloor) {  // [M-31]
  expect_held({.floor = 0.01});
}

}  // namespace
}  // namespace trochoid::structure
